#include "core/scene/mesh.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <string_view>
#include <utility>

#include "core/scene/largestCoordinate.h"
#include "core/subdiv/faceVaryingMesh.h"

namespace cc {
namespace {

constexpr char kNormals[] = "normals";

std::string CheckPoints(const std::vector<Vec3f>& points) {
    const auto bad = std::find_if_not(points.begin(), points.end(), IsUsable);
    if (bad == points.end()) {
        return {};
    }
    return "point " + std::to_string(bad - points.begin()) +
           (IsFinite(*bad) ? " is too far away" : " is not finite") + "; the mesh is left out";
}

/// Tells points apart from others, but for one chance in 2^64.
size_t HashOf(const std::vector<Vec3f>& points) {
    return std::hash<std::string_view>()(
        {reinterpret_cast<const char*>(points.data()), points.size() * sizeof(Vec3f)});
}

size_t CountUsedPoints(const ControlMesh& topology) {
    const auto& indices = topology.faceVertexIndices;
    const auto last = std::max_element(indices.begin(), indices.end());
    return last == indices.end() ? 0 : static_cast<size_t>(*last) + 1;
}

template <typename T>
size_t BytesOf(const std::vector<T>& values) {
    return values.capacity() * sizeof(T);
}

size_t BytesOfTags(const ControlMesh& mesh) {
    return BytesOf(mesh.holeIndices) + BytesOf(mesh.creaseIndices) + BytesOf(mesh.creaseLengths) +
           BytesOf(mesh.creaseSharpnesses) + BytesOf(mesh.cornerIndices) +
           BytesOf(mesh.cornerSharpnesses);
}

size_t CountZeroes(const Primvar& normals) {
    size_t count = 0;
    for (size_t i = 0; i + 2 < normals.values.size(); i += 3) {
        const float* n = &normals.values[i];
        count += Normalize({n[0], n[1], n[2]}) == Vec3f{};
    }
    return count;
}

}  // namespace

Mesh::Mesh(std::string name) : Shape(std::move(name)) {}

Mesh::~Mesh() = default;

void Mesh::SetTopology(ControlMesh topology) {
    _topology = std::move(topology);
    _topologyChanged = true;
}

void Mesh::SetPoints(std::vector<Vec3f> points) {
    const bool areInUse = _pointsAreInSurface && !_motion.IsMoving();
    if (!areInUse || HashOf(points) != _pointsHash) {
        _TakePoints(std::move(points));
    }
}

void Mesh::SetMovingPoints(MovingPoints points) {
    if (!points.IsMoving()) {
        SetPoints(std::move(points.Poses().front()));
        return;
    }
    _TakePoints(PointsAt(points, 0));
    _motion = std::move(points);
}

void Mesh::_TakePoints(std::vector<Vec3f> points) {
    _pointsHash = HashOf(points);
    _points = std::move(points);
    _pointsChanged = true;
    _pointsAreInSurface = false;
    _motion = {};
}

void Mesh::SetCulled(CulledSide side) { _culled = side; }

Vec3f Mesh::AuthoredNormal(const ShapePoint& at) const {
    if (!_normals) {
        return {};
    }
    const SurfaceValue normal = Evaluate(*_normals, at);
    return {normal.value[0], normal.value[1], normal.value[2]};
}

void Mesh::_BuildGeometry(BuildReport* report) {
    if (!_topologyChanged && !_pointsChanged) {
        return;
    }
    report->topLevelChanged = true;
    _isSurfaceUsable = false;
    if (_topologyChanged || !_surface) {
        if (_pointsAreInSurface) {
            _Pose(0);
            const std::vector<Vec3f>& points = _surface->PatchPoints();
            _points.assign(points.begin(), points.begin() + _surface->Patches().CagePointCount());
            _pointsAreInSurface = false;
        }
        _TakePrimvarsBack(/* ofInstancesOnly */ false);
        _surface.reset();
        _RebuildSurface(report);
    } else {
        _MoveSurface(report);
    }
    if (report->work != GeometryWork::None) {
        _points = {};
        _pointsAreInSurface = true;
        _isSurfaceUsable = _surface->Patches().Count() > 0;
        _BuildMotion(report);
    }
    _topologyChanged = _pointsChanged = false;
}

void Mesh::_NotePrimvarsForShading() {
    Shape::_NotePrimvarsForShading();
    _normals = _tags.scheme == Scheme::None ? FindPrimvar(kNormals) : nullptr;
}

void Mesh::_RebuildSurface(BuildReport* report) {
    if (_topology.faceVertexCounts.empty() && _topology.faceVertexIndices.empty()) {
        return;  // empty, and nothing wrong with that
    }
    if (_points.empty()) {
        report->lines.push_back("has no points; the mesh is left out");
        return;
    }
    ControlMeshReport validation = ValidateControlMesh(&_topology, _points.size());
    report->lines = std::move(validation.warnings);
    if (!validation.IsValid()) {
        report->lines.push_back(validation.error + "; the mesh is left out");
        return;
    }
    const std::string pointError = CheckPoints(_points);
    if (!pointError.empty()) {
        report->lines.push_back(pointError);
        return;
    }
    auto surface = std::make_unique<Surface>(_topology, _points);
    if (!surface->Error().empty()) {
        report->lines.push_back(surface->Error() + "; the mesh is left out");
        return;
    }
    _surface = std::move(surface);
    _usedPointCount = CountUsedPoints(_topology);
    _faces = FaceVertices(_topology.faceVertexCounts, std::move(_topology.faceVertexIndices));
    _tags = std::exchange(_topology, {});
    _tags.faceVertexCounts = {};
    report->work = GeometryWork::Rebuilt;
}

void Mesh::_MoveSurface(BuildReport* report) {
    if (_points.size() < _usedPointCount) {
        report->lines.push_back("has " + std::to_string(_points.size()) +
                                " points and faces that use " + std::to_string(_usedPointCount) +
                                "; the mesh is left out");
        return;
    }
    const std::string pointError = CheckPoints(_points);
    if (!pointError.empty()) {
        report->lines.push_back(pointError);
        return;
    }
    // Points that no face uses may come and go.
    _points.resize(_surface->Patches().CagePointCount());
    _surface->SetPoints(_points);
    report->work = GeometryWork::Moved;
}

void Mesh::_BuildMotion(BuildReport* report) {
    if (!_motion.IsMoving()) {
        return;
    }
    for (size_t i = 0; i < _motion.Poses().size(); ++i) {
        std::vector<Vec3f>& pose = _motion.Poses()[i];
        const std::string error = _CheckPose(pose);
        if (!error.empty()) {
            report->lines.push_back("pose " + std::to_string(i) + " of its motion " + error +
                                    "; it is shown at rest");
            _motion = {};
            return;
        }
        pose.resize(_surface->Patches().CagePointCount());
    }
    _surface->SetPoses(_motion.Poses());
}

std::string Mesh::_CheckPose(const std::vector<Vec3f>& pose) const {
    if (pose.size() < _usedPointCount) {
        return "has " + std::to_string(pose.size()) + " points, and faces use " +
               std::to_string(_usedPointCount);
    }
    const bool isUsable = std::all_of(pose.begin(), pose.end(), IsUsable);
    return isUsable ? "" : "has points that are not finite or too far away";
}

void Mesh::_Pose(float time) {
    if (_motion.IsMoving()) {
        _surface->Pose(PointsAt(_motion, time));
    }
}

PrimvarSizes Mesh::_Sizes() const {
    const size_t points = _surface->Patches().CagePointCount();
    return {_faces.FaceCount(), points, points, _faces.Count(), _PlaceCount()};
}

bool Mesh::_IsNormals(const std::string& name) const {
    return name == kNormals && _tags.scheme == Scheme::None;
}

std::string Mesh::_CheckPrimvar(const std::string& name, const Primvar& primvar) const {
    if (!_IsNormals(name) || primvar.arity == 3) {
        return Shape::_CheckPrimvar(name, primvar);
    }
    return name + " has " + std::to_string(primvar.arity) + " numbers a value, not 3";
}

std::string Mesh::_Without(const std::string& name) const {
    return _IsNormals(name) ? "facets are shown" : Shape::_Without(name);
}

PrimvarField Mesh::_MakeField(const std::string& name, Primvar primvar, BuildReport* report) const {
    const size_t zeroes = _IsNormals(name) ? CountZeroes(primvar) : 0;
    if (zeroes > 0) {
        report->lines.push_back(std::to_string(zeroes) +
                                " normals have no length; facets are shown there");
    }
    FaceVaryingChannel channel = _MakeChannel(name, primvar, report);
    return PrimvarField(std::move(primvar), _surface->Patches(), std::move(channel));
}

FaceVaryingChannel Mesh::_MakeChannel(const std::string& name, const Primvar& primvar,
                                      BuildReport* report) const {
    if (primvar.interpolation != Interpolation::FaceVarying) {
        return {};
    }
    ControlMesh mesh = _tags;
    _faces.CopyTo(&mesh.faceVertexCounts, &mesh.faceVertexIndices);
    if (IsFaceVaryingBilinear(mesh, !primvar.indices.empty())) {
        return {};
    }
    std::vector<int> indices = primvar.indices;
    if (indices.empty()) {
        indices.resize(primvar.ValueCount());
        std::iota(indices.begin(), indices.end(), 0);
    }
    std::string warning;
    FaceVaryingChannel channel(mesh, _surface->Patches().CagePointCount(), primvar.arity,
                               primvar.values, indices, &warning);
    if (!warning.empty()) {
        report->lines.push_back(name + ": " + warning);
    }
    return channel;
}

size_t Mesh::_OwnBytes() const {
    return _faces.Bytes() + BytesOf(_points) + BytesOf(_motion) + BytesOfTags(_tags);
}

}  // namespace cc
