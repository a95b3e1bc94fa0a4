// Random topology, tags and points -> patches -> packets of rays. Whatever a scene says, the core
// must neither crash nor hang nor return what makes no sense.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <vector>

#include "core/scene/scene.h"
#include "core/subdiv/limitPoint.h"
#include "core/trace/tracer.h"
#include "tests/unit/trace/rayAnswer.h"

namespace {

/// Reads an input byte by byte; what lies beyond its end is zero.
class Bytes {
  public:
    Bytes(const uint8_t* data, size_t size) : _data(data), _end(data + size) {}

    bool IsEmpty() const { return _data == _end; }
    int Byte() { return IsEmpty() ? 0 : *_data++; }
    /// Mostly in [0, range), and now and then anything at all.
    int Index(int range) {
        const int b = Byte();
        if (b == 255) {
            return Byte() - 128;
        }
        return range > 0 ? b % range : b;
    }
    /// Mostly a small number, and now and then any float there is.
    float Float() {
        const int b = Byte();
        if (b == 255) {
            uint32_t bits = 0;
            for (int i = 0; i < 4; ++i) {
                bits = bits << 8 | static_cast<uint32_t>(Byte());
            }
            float value;
            std::memcpy(&value, &bits, sizeof(value));
            return value;
        }
        return static_cast<float>(b - 127) / 16;
    }

  private:
    const uint8_t* _data;
    const uint8_t* const _end;
};

cc::Scheme SchemeOf(int flags) {
    switch (flags % 8) {
        case 4:
        case 5: return cc::Scheme::Loop;
        case 6: return cc::Scheme::Bilinear;
        case 7: return cc::Scheme::None;
        default: return cc::Scheme::CatmullClark;
    }
}

/// How many vertices a face has: under the Loop scheme almost always three, as others end there.
int ReadFaceSize(Bytes* bytes, cc::Scheme scheme) {
    if (scheme != cc::Scheme::Loop) {
        return bytes->Index(8);
    }
    const int b = bytes->Byte();
    return b < 250 ? 3 : b - 250;
}

cc::ControlMesh ReadMesh(Bytes* bytes, int pointCount) {
    cc::ControlMesh mesh;
    const int flags = bytes->Byte();
    mesh.scheme = SchemeOf(flags);
    mesh.boundaryRule = static_cast<cc::BoundaryRule>((flags >> 3) % 3);
    mesh.creaseRule = static_cast<cc::CreaseRule>((flags >> 5) & 1);
    mesh.triangleRule = static_cast<cc::TriangleRule>((flags >> 6) & 1);
    mesh.leftHanded = (flags & 128) != 0;
    const int faceCount = bytes->Byte() % 24;
    for (int face = 0; face < faceCount; ++face) {
        const int count = ReadFaceSize(bytes, mesh.scheme);
        mesh.faceVertexCounts.push_back(count);
        for (int i = 0; i < count; ++i) {
            mesh.faceVertexIndices.push_back(bytes->Index(pointCount));
        }
    }
    for (int n = bytes->Byte() % 8; n > 0; --n) {
        const int length = bytes->Index(5);
        mesh.creaseLengths.push_back(length);
        for (int i = 0; i < length; ++i) {
            mesh.creaseIndices.push_back(bytes->Index(pointCount));
        }
        mesh.creaseSharpnesses.push_back(bytes->Float());
    }
    for (int n = bytes->Byte() % 4; n > 0; --n) {
        mesh.cornerIndices.push_back(bytes->Index(pointCount));
        mesh.cornerSharpnesses.push_back(bytes->Float());
    }
    for (int n = bytes->Byte() % 4; n > 0; --n) {
        mesh.holeIndices.push_back(bytes->Index(faceCount));
    }
    return mesh;
}

cc::RayPacket ReadRays(Bytes* bytes) {
    cc::RayPacket rays;
    rays.count = bytes->Byte() % cc::kPacketSize + 1;
    const float x = bytes->Float(), y = bytes->Float(), z = bytes->Float();
    for (int i = 0; i < rays.count; ++i) {
        rays.originX[i] = x;
        rays.originY[i] = y;
        rays.originZ[i] = z;
        rays.directionX[i] = std::sin(0.7f * static_cast<float>(i)) * 0.3f + bytes->Float() - x;
        rays.directionY[i] = std::cos(0.9f * static_cast<float>(i)) * 0.3f - y;
        rays.directionZ[i] = std::sin(1.3f * static_cast<float>(i)) * 0.3f - z;
        rays.tMin[i] = 0;
        rays.tMax[i] = 1e30f;
    }
    return rays;
}

void Require(bool condition) {
    if (!condition) {
        std::abort();
    }
}

/// A hit must be somewhere on a patch.
void RequireHit(const cc::InstanceBvh& instances, const cc::RayPacket& nearest,
                const cc::HitPacket& hits, int i) {
    Require(hits.instance[i] < instances.Instances().size());
    const cc::Surface& surface = cc::SurfaceOf(instances.Instances()[hits.instance[i]]);
    Require(hits.patch[i] < surface.Patches().Count());
    Require(hits.u[i] >= 0 && hits.u[i] <= 1 && hits.v[i] >= 0 && hits.v[i] <= 1);
    Require(!surface.Patches().IsTriangle(hits.patch[i]) || hits.u[i] + hits.v[i] <= 1);
    Require(nearest.tMax[i] >= 0);
    cc::EvaluateLimit(surface.Patches(), hits.patch[i], surface.PatchPoints().data(), hits.u[i],
                      hits.v[i]);
}

/// What a packet of rays hits.
struct Traced {
    std::unique_ptr<cc::Tracer> tracer;
    cc::RayPacket rays;
    cc::HitPacket hits;
};

Traced Trace(const cc::InstanceBvh& instances, const cc::RayPacket& rays, cc::TracerKind kind,
             int level) {
    Traced traced{cc::MakeTracer(kind, level), rays, {}};
    cc::TraceStatistics statistics;
    traced.tracer->Intersect(instances, &traced.rays, &traced.hits, &statistics);
    const uint64_t occluded = traced.tracer->Occluded(instances, rays, &statistics);
    for (int i = 0; i < rays.count; ++i) {
        const bool isHit = traced.hits.instance[i] != cc::kNoHit;
        Require((occluded >> i & 1) == isHit);
        if (isHit) {
            RequireHit(instances, traced.rays, traced.hits, i);
        }
    }
    return traced;
}

bool IsModerate(const cc::Vec3f& p) {
    return std::fabs(p.x) < 100 && std::fabs(p.y) < 100 && std::fabs(p.z) < 100;
}

/// True if tracers may be held to the same hits: where numbers differ by many orders of magnitude,
/// so may what they see, by the rounding of the large ones.
bool IsModerate(const std::vector<cc::Vec3f>& points, const cc::RayPacket& rays) {
    for (int i = 0; i < rays.count; ++i) {
        const cc::Vec3f direction{rays.directionX[i], rays.directionY[i], rays.directionZ[i]};
        if (!IsModerate({rays.originX[i], rays.originY[i], rays.originZ[i]}) ||
            !IsModerate(direction) || cc::Length(direction) < 0.01f) {
            return false;
        }
    }
    return std::all_of(points.begin(), points.end(),
                       [](const cc::Vec3f& p) { return IsModerate(p); });
}

/// True if a ray begins on the surface: whether it hits there is up to rounding.
bool BeginsThere(const cc::test::RayAnswer& answer, float bound) {
    return answer.instance != cc::kNoHit && answer.distance <= bound;
}

/// What one tracer hits another must, but for rays by an edge.
void RequireSame(const cc::InstanceBvh& instances, const cc::RayPacket& rays, const Traced& packet,
                 const Traced& other) {
    const float bound = 1e-5f * instances.Bounds().Diagonal();
    for (int i = 0; i < rays.count; ++i) {
        const auto expected = cc::test::AnswerOf(instances, packet.rays, packet.hits, i);
        auto found = cc::test::AnswerOf(instances, other.rays, other.hits, i);
        found.face = cc::test::kAnyFace;
        Require(BeginsThere(expected, bound) || BeginsThere(found, bound) ||
                cc::test::Agree(expected, found, bound) ||
                cc::test::IsAnswerBeside(instances, *packet.tracer, rays, i, found, bound));
    }
}

/// Traces with packets and with one of the other kinds.
void TraceWithTwo(const cc::InstanceBvh& instances, const cc::RayPacket& rays, int choice,
                  const std::vector<cc::Vec3f>& points) {
    constexpr cc::TracerKind kOthers[] = {cc::TracerKind::Single, cc::TracerKind::Algorithm1,
                                          cc::TracerKind::Tessellated};
    const int level = choice % 4;
    const Traced packet = Trace(instances, rays, cc::TracerKind::Packet, level);
    const Traced other = Trace(instances, rays, kOthers[choice / 4 % 3], level);
    if (IsModerate(points, rays)) {
        RequireSame(instances, rays, packet, other);
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    Bytes bytes(data, size);
    const int pointCount = bytes.Byte() % 32;
    std::vector<cc::Vec3f> points(pointCount);
    for (cc::Vec3f& p : points) {
        p = {bytes.Float(), bytes.Float(), bytes.Float()};
    }
    cc::Scene scene;
    cc::Mesh* mesh = scene.AddMesh("/fuzz");
    mesh->SetTopology(ReadMesh(&bytes, pointCount));
    mesh->SetPoints(points);
    scene.Build({"geometry"});
    const int choice = bytes.Byte();
    TraceWithTwo(scene.Instances(), ReadRays(&bytes), choice, points);

    // An edit: other points for the same topology.
    for (cc::Vec3f& p : points) {
        p.x += bytes.Float();
    }
    mesh->SetPoints(points);
    scene.Build({"geometry"});
    TraceWithTwo(scene.Instances(), ReadRays(&bytes), choice, points);
    return 0;
}
