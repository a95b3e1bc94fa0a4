#include "embreeScene.h"

#include <chrono>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/trace/surface.h"
#include "limitGrids.h"

namespace {

/// Sharpness from which a crease never decays.
constexpr float kInfinitelySharp = 10;

using Clock = std::chrono::steady_clock;

double SecondsSince(Clock::time_point begin) {
    return std::chrono::duration<double>(Clock::now() - begin).count();
}

template <class T>
T* NewBuffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format, size_t count) {
    return static_cast<T*>(rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(T), count));
}

template <class T, class Values>
void CopyToBuffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format,
                  const Values& values) {
    if (!values.empty()) {
        T* to = NewBuffer<T>(geometry, type, format, values.size());
        std::copy(values.begin(), values.end(), to);
    }
}

struct Edge {
    uint32_t from, to;
};

std::vector<float> WithInfinity(std::vector<float> sharpnesses) {
    for (float& sharpness : sharpnesses) {
        if (sharpness >= kInfinitelySharp) {
            sharpness = std::numeric_limits<float>::infinity();
        }
    }
    return sharpnesses;
}

RTCSubdivisionMode ModeOf(const cc::ControlMesh& mesh) {
    if (mesh.scheme != cc::Scheme::CatmullClark) {
        return RTC_SUBDIVISION_MODE_PIN_ALL;
    }
    switch (mesh.boundaryRule) {
        case cc::BoundaryRule::None: return RTC_SUBDIVISION_MODE_NO_BOUNDARY;
        case cc::BoundaryRule::EdgeOnly: return RTC_SUBDIVISION_MODE_SMOOTH_BOUNDARY;
        case cc::BoundaryRule::EdgeAndCorner: break;
    }
    return RTC_SUBDIVISION_MODE_PIN_CORNERS;
}

void SetCreases(RTCGeometry geometry, const cc::ControlMesh& mesh) {
    std::vector<Edge> edges;
    for (size_t i = 0; i + 1 < mesh.creaseIndices.size(); i += 2) {
        edges.push_back({static_cast<uint32_t>(mesh.creaseIndices[i]),
                         static_cast<uint32_t>(mesh.creaseIndices[i + 1])});
    }
    CopyToBuffer<Edge>(geometry, RTC_BUFFER_TYPE_EDGE_CREASE_INDEX, RTC_FORMAT_UINT2, edges);
    CopyToBuffer<float>(geometry, RTC_BUFFER_TYPE_EDGE_CREASE_WEIGHT, RTC_FORMAT_FLOAT,
                        WithInfinity(mesh.creaseSharpnesses));
    CopyToBuffer<uint32_t>(geometry, RTC_BUFFER_TYPE_VERTEX_CREASE_INDEX, RTC_FORMAT_UINT,
                           mesh.cornerIndices);
    CopyToBuffer<float>(geometry, RTC_BUFFER_TYPE_VERTEX_CREASE_WEIGHT, RTC_FORMAT_FLOAT,
                        WithInfinity(mesh.cornerSharpnesses));
}

/// Makes hole faces impossible to hit, as a displacement: all points of the face are moved to
/// its first. The geometry's user data is a vector of bool, one a face.
void CollapseHoles(const RTCDisplacementFunctionNArguments* arguments) {
    const auto& isHole = *static_cast<const std::vector<bool>*>(arguments->geometryUserPtr);
    if (!isHole[arguments->primID]) {
        return;
    }
    for (unsigned i = 0; i < arguments->N; ++i) {
        arguments->P_x[i] = arguments->P_x[0];
        arguments->P_y[i] = arguments->P_y[0];
        arguments->P_z[i] = arguments->P_z[0];
    }
}

/// Embree's own holes do not exist in the topology either: faces around them end in a boundary, and
/// the surface is another than USD's. So they stay in the topology, coarse and collapsed.
void SetHoles(RTCGeometry geometry, const cc::ControlMesh& mesh, float rate,
              std::vector<bool>* isHole) {
    isHole->assign(mesh.faceVertexCounts.size(), false);
    for (const int hole : mesh.holeIndices) {
        (*isHole)[hole] = true;
    }
    auto* levels = NewBuffer<float>(geometry, RTC_BUFFER_TYPE_LEVEL, RTC_FORMAT_FLOAT,
                                    mesh.faceVertexIndices.size());
    for (size_t face = 0; face < isHole->size(); ++face) {
        const int corners = mesh.faceVertexCounts[face];
        levels = std::fill_n(levels, corners, (*isHole)[face] ? 1.0f : rate);
    }
    rtcSetGeometryUserData(geometry, isHole);
    rtcSetGeometryDisplacementFunction(geometry, CollapseHoles);
}

void SetPoints(RTCGeometry geometry, const cc::AffineTransform& objectToWorld,
               const std::vector<cc::Vec3f>& points) {
    auto* to =
        NewBuffer<cc::Vec3f>(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, points.size());
    for (const cc::Vec3f& point : points) {
        *to++ = objectToWorld.Point(point);
    }
}

void SetGrids(RTCGeometry geometry, const LimitGrids& limit) {
    auto* to =
        NewBuffer<RTCGrid>(geometry, RTC_BUFFER_TYPE_GRID, RTC_FORMAT_GRID, limit.grids.size());
    for (const LimitGrids::Grid& grid : limit.grids) {
        const auto side = static_cast<unsigned short>(grid.side);
        *to++ = {grid.firstPoint, static_cast<unsigned>(grid.side), side, side};
    }
}

struct Quad {
    uint32_t corners[4];
};

void SetQuads(RTCGeometry geometry, const LimitGrids& limit) {
    size_t count = 0;
    for (const LimitGrids::Grid& grid : limit.grids) {
        count += static_cast<size_t>(grid.side - 1) * (grid.side - 1);
    }
    auto* to = NewBuffer<Quad>(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT4, count);
    for (const LimitGrids::Grid& grid : limit.grids) {
        for (int v = 0; v + 1 < grid.side; ++v) {
            for (int u = 0; u + 1 < grid.side; ++u) {
                const uint32_t a = grid.firstPoint + v * grid.side + u;
                const uint32_t above = a + grid.side;
                *to++ = {{a, a + 1, above + 1, above}};
            }
        }
    }
}

}  // namespace

EmbreeScene::EmbreeScene(BenchScene source, EmbreeMode mode, int level)
    : _source(std::move(source)), _mode(mode), _level(level) {
    for (BenchMesh& mesh : _source.meshes) {
        if (!ValidateControlMesh(&mesh.topology, mesh.points.size()).IsValid()) {
            mesh = {};
        }
    }
}

EmbreeScene::~EmbreeScene() { _Release(); }

void EmbreeScene::_Release() {
    for (RTCGeometry geometry : _geometries) {
        rtcReleaseGeometry(geometry);
    }
    _geometries.clear();
    _isHole.clear();
    if (_scene) {
        rtcReleaseScene(_scene);
        rtcReleaseDevice(_device);
    }
}

bool EmbreeScene::_CountBytes(void* scene, ssize_t bytes, bool) {
    auto* self = static_cast<EmbreeScene*>(scene);
    const size_t now = self->_bytes += static_cast<size_t>(bytes);
    if (bytes > 0 && now > self->_peakBytes) {
        self->_peakBytes = now;
    }
    return true;
}

EmbreeScene::Seconds EmbreeScene::Build(int threads) {
    _Release();
    _bytes = _peakBytes = 0;
    const std::string config = "threads=" + std::to_string(threads);
    _device = rtcNewDevice(config.c_str());
    if (!_device) {
        throw std::runtime_error("Embree has no device");
    }
    rtcSetDeviceMemoryMonitorFunction(_device, _CountBytes, this);
    const auto begin = Clock::now();
    _scene = rtcNewScene(_device);
    rtcSetSceneBuildQuality(_scene, RTC_BUILD_QUALITY_HIGH);
    Seconds seconds;
    for (const BenchMesh& mesh : _source.meshes) {
        if (_mode == EmbreeMode::Subdivision) {
            _AddSubdivision(mesh);
        } else {
            _AddGrids(mesh, &seconds.tessellation);
        }
    }
    rtcCommitScene(_scene);
    if (rtcGetDeviceError(_device) != RTC_ERROR_NONE) {
        throw std::runtime_error("Embree could not build the scene");
    }
    _TraceFirstRay();
    seconds.commit = SecondsSince(begin) - seconds.tessellation;
    return seconds;
}

EmbreeScene::Seconds EmbreeScene::Edit(float phase) {
    if (_mode != EmbreeMode::Subdivision || !_scene) {
        throw std::runtime_error("only a built subdivision scene can be edited");
    }
    std::vector<std::vector<cc::Vec3f>> points;
    for (const BenchMesh& mesh : _source.meshes) {
        points.push_back(RippledPoints(mesh, phase));
    }
    const auto begin = Clock::now();
    for (size_t i = 0; i < points.size(); ++i) {
        auto* to = static_cast<cc::Vec3f*>(
            rtcGetGeometryBufferData(_geometries[i], RTC_BUFFER_TYPE_VERTEX, 0));
        for (const cc::Vec3f& point : points[i]) {
            *to++ = _source.meshes[i].objectToWorld.Point(point);
        }
        rtcUpdateGeometryBuffer(_geometries[i], RTC_BUFFER_TYPE_VERTEX, 0);
        rtcCommitGeometry(_geometries[i]);
    }
    rtcCommitScene(_scene);
    _TraceFirstRay();
    return {0, SecondsSince(begin)};
}

void EmbreeScene::_AddSubdivision(const BenchMesh& mesh) {
    const cc::ControlMesh& topology = mesh.topology;
    if (topology.scheme == cc::Scheme::Loop) {
        throw std::runtime_error(mesh.name + ": Embree has no Loop scheme");
    }
    RTCGeometry geometry = rtcNewGeometry(_device, RTC_GEOMETRY_TYPE_SUBDIVISION);
    CopyToBuffer<uint32_t>(geometry, RTC_BUFFER_TYPE_FACE, RTC_FORMAT_UINT,
                           topology.faceVertexCounts);
    CopyToBuffer<uint32_t>(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT,
                           topology.faceVertexIndices);
    SetCreases(geometry, topology);
    SetPoints(geometry, mesh.objectToWorld, mesh.points);
    rtcSetGeometrySubdivisionMode(geometry, 0, ModeOf(topology));
    const float rate = static_cast<float>(1 << _level);
    rtcSetGeometryTessellationRate(geometry, rate);
    if (!topology.holeIndices.empty()) {
        _isHole.emplace_back();
        SetHoles(geometry, topology, rate, &_isHole.back());
    }
    _Attach(geometry);
}

void EmbreeScene::_AddGrids(const BenchMesh& mesh, double* tessellation) {
    const auto begin = Clock::now();
    const cc::Surface surface(mesh.topology, mesh.points);
    const LimitGrids limit = EvaluateLimitGrids(surface, mesh.objectToWorld, _level);
    *tessellation += SecondsSince(begin);
    const bool asQuads = _mode == EmbreeMode::Quad;
    RTCGeometry geometry =
        rtcNewGeometry(_device, asQuads ? RTC_GEOMETRY_TYPE_QUAD : RTC_GEOMETRY_TYPE_GRID);
    CopyToBuffer<cc::Vec3f>(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, limit.points);
    if (asQuads) {
        SetQuads(geometry, limit);
    } else {
        SetGrids(geometry, limit);
    }
    _Attach(geometry);
}

void EmbreeScene::_Attach(RTCGeometry geometry) {
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(_scene, geometry);
    _geometries.push_back(geometry);
}

void EmbreeScene::_TraceFirstRay() const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit ray{};
    ray.ray.dir_z = 1;
    ray.ray.tfar = std::numeric_limits<float>::infinity();
    ray.ray.mask = ~0u;
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(_scene, &context, &ray);
}

size_t EmbreeScene::FaceCount() const {
    size_t count = 0;
    for (const BenchMesh& mesh : _source.meshes) {
        count += mesh.topology.faceVertexCounts.size();
    }
    return count;
}

std::string EmbreeScene::Description() const {
    const bool isWide = rtcGetDeviceProperty(_device, RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED);
    const bool isMedium = rtcGetDeviceProperty(_device, RTC_DEVICE_PROPERTY_NATIVE_RAY8_SUPPORTED);
    return std::string("Embree ") + RTC_VERSION_STRING + ", " +
           (isWide     ? "AVX-512"
            : isMedium ? "AVX"
                       : "SSE");
}
