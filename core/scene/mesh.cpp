#include "core/scene/mesh.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "core/scene/largestCoordinate.h"
#include "core/subdiv/faceVaryingMesh.h"

namespace cc {
namespace {

constexpr char kDisplayColor[] = "displayColor", kNormals[] = "normals";

/// Points that a thread takes at a time.
constexpr size_t kPointGrain = 4096;

std::string CheckPoints(const std::vector<Vec3f>& points) {
    const auto bad = std::find_if_not(points.begin(), points.end(), IsUsable);
    if (bad == points.end()) {
        return {};
    }
    return "point " + std::to_string(bad - points.begin()) +
           (IsFinite(*bad) ? " is too far away" : " is not finite") + "; the mesh is left out";
}

/// Where points are that move. All poses that time lies between have as many, or the first is
/// taken.
std::vector<Vec3f> PointsAt(const Moving<std::vector<Vec3f>>& points, float time) {
    const auto at = points.At(time);
    std::vector<Vec3f> between = at.first;
    if (at.weight == 0 || at.second.size() != at.first.size()) {
        return between;
    }
    const double weight = at.weight;
    tbb::parallel_for(
        tbb::blocked_range<size_t>(0, between.size(), kPointGrain), [&](const auto& part) {
            for (size_t i = part.begin(); i < part.end(); ++i) {
                for (int axis = 0; axis < 3; ++axis) {
                    between[i][axis] = static_cast<float>((1 - weight) * at.first[i][axis] +
                                                          weight * at.second[i][axis]);
                }
            }
        });
    return between;
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

Mesh::Mesh(std::string name) : _name(std::move(name)) {}

void Mesh::SetPrimId(int primId) { _primId = primId; }

void Mesh::SetTopology(ControlMesh topology) {
    _topology = std::move(topology);
    _topologyChanged = true;
}

void Mesh::SetPoints(std::vector<Vec3f> points) {
    _points = std::move(points);
    _pointsChanged = true;
    _pointsAreInSurface = false;
    _motion = {};
}

void Mesh::SetMovingPoints(Moving<std::vector<Vec3f>> points) {
    SetPoints(PointsAt(points, 0));
    _motion = std::move(points);
}

void Mesh::SetPrimvar(const std::string& name, Primvar primvar) {
    if (primvar.IsEmpty()) {
        _primvars.erase(name);
        _NotePrimvarsForShading();
        return;
    }
    PrimvarSlot& slot = _primvars[name];
    if (!slot.isChanged && !slot.field.IsEmpty() &&
        slot.field.IsMadeOf(primvar, _surface->Patches())) {
        return;
    }
    slot.waiting = std::move(primvar);
    slot.isChanged = true;
}

void Mesh::SetTransform(const AffineTransform& objectToWorld) {
    SetMovingTransform(Moving<AffineTransform>(objectToWorld));
}

void Mesh::SetMovingTransform(Moving<AffineTransform> objectToWorld) {
    _placementChanged |= _placement.SetTransform(std::move(objectToWorld));
}

void Mesh::SetInstances(std::vector<AffineTransform> instanceToWorld) {
    SetMovingInstances(Moving<std::vector<AffineTransform>>(std::move(instanceToWorld)));
}

void Mesh::SetMovingInstances(Moving<std::vector<AffineTransform>> instanceToWorld) {
    _placement.SetInstances(std::move(instanceToWorld));
    _placementChanged = true;
    _TakePrimvarsBack(/* ofInstancesOnly */ true);
}

void Mesh::ClearInstances() { _placementChanged |= _placement.ClearInstances(); }

void Mesh::SetVisible(bool visible) { _visible = visible; }

void Mesh::SetCullBackFaces(bool cull) { _cullBackFaces = cull; }

void Mesh::SetRenderTag(std::string tag) { _renderTag = std::move(tag); }

Vec3f Mesh::AuthoredNormal(const MeshPoint& at) const {
    if (!_normals) {
        return {};
    }
    const SurfaceValue normal = Evaluate(*_normals, at);
    return {normal.value[0], normal.value[1], normal.value[2]};
}

Vec3f Mesh::DisplayColor(const MeshPoint& at) const {
    if (!_displayColor) {
        return kDefaultDisplayColor;
    }
    const SurfaceValue color = Evaluate(*_displayColor, at);
    return {color.value[0], color.value[1], color.value[2]};
}

const PrimvarField* Mesh::FindPrimvar(const std::string& name) const {
    const auto found = _primvars.find(name);
    return found == _primvars.end() || found->second.field.IsEmpty() ? nullptr
                                                                     : &found->second.field;
}

Mesh::BuildReport Mesh::_Build() {
    BuildReport report;
    if (_topologyChanged || _pointsChanged) {
        _BuildSurface(&report);
    }
    if (_surface) {
        _BuildPrimvars(&report);
    }
    if (_placementChanged || report.work != SurfaceWork::None) {
        _BuildPlacement(&report);
    }
    _topologyChanged = _pointsChanged = _placementChanged = false;
    return report;
}

void Mesh::_BuildSurface(BuildReport* report) {
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
    if (report->work != SurfaceWork::None) {
        _points = {};
        _pointsAreInSurface = true;
        _isSurfaceUsable = _surface->Patches().Count() > 0;
        _BuildMotion(report);
    }
}

void Mesh::_TakePrimvarsBack(bool ofInstancesOnly) {
    for (auto& [name, slot] : _primvars) {
        const bool isOfInstances = slot.field.IsEmpty()
                                       ? slot.waiting.interpolation == Interpolation::Instance
                                       : slot.field.IsOfInstances();
        if (ofInstancesOnly && !isOfInstances) {
            continue;
        }
        if (!slot.isChanged && !slot.field.IsEmpty()) {
            slot.waiting = slot.field.TakePrimvar(_surface->Patches());
        }
        slot.field = {};
        slot.isChanged = true;
    }
    _NotePrimvarsForShading();
}

void Mesh::_NotePrimvarsForShading() {
    _displayColor = FindPrimvar(kDisplayColor);
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
    report->work = SurfaceWork::Rebuilt;
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
    report->work = SurfaceWork::Moved;
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

void Mesh::_BuildPrimvars(BuildReport* report) {
    for (auto& [name, slot] : _primvars) {
        if (slot.isChanged) {
            _BuildPrimvar(name, &slot, report);
            ++report->primvarsBuilt;
        }
    }
    _NotePrimvarsForShading();
}

void Mesh::_BuildPrimvar(const std::string& name, PrimvarSlot* slot, BuildReport* report) const {
    std::string error = CheckPrimvar(
        name, slot->waiting, {_faces, _surface->Patches().CagePointCount(), _placement.Count()});
    const bool isColor = name == kDisplayColor;
    const bool isNormals = name == kNormals && _tags.scheme == Scheme::None;
    if (error.empty() && (isColor || isNormals) && slot->waiting.arity != 3) {
        error = name + " has " + std::to_string(slot->waiting.arity) + " numbers a value, not 3";
    }
    slot->isChanged = false;
    // Kept if it does not fit, as the next topology may be the one that it belongs to.
    slot->field = {};
    if (!error.empty()) {
        report->lines.push_back(error + (isColor     ? "; the mesh is shown in grey"
                                         : isNormals ? "; facets are shown"
                                                     : "; it is left out"));
        return;
    }
    const size_t zeroes = isNormals ? CountZeroes(slot->waiting) : 0;
    if (zeroes > 0) {
        report->lines.push_back(std::to_string(zeroes) +
                                " normals have no length; facets are shown there");
    }
    FaceVaryingChannel channel = _MakeChannel(name, slot->waiting, report);
    slot->field =
        PrimvarField(std::exchange(slot->waiting, {}), _surface->Patches(), std::move(channel));
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

void Mesh::_BuildPlacement(BuildReport* report) {
    report->topLevelChanged = true;
    const Placement::Obstacles before = _obstacles;
    _obstacles = BuiltSurface() ? _placement.FindObstacles(*_surface) : Placement::Obstacles();
    if (_placementChanged || !(_obstacles == before)) {
        for (std::string& line : _placement.Describe(_obstacles)) {
            report->lines.push_back(std::move(line));
        }
    }
}

size_t Mesh::_Bytes() const {
    size_t bytes = (_surface ? _surface->Bytes() : 0) + _faces.Bytes() +
                   _points.capacity() * sizeof(Vec3f) + BytesOfTags(_tags) + _placement.Bytes();
    for (const std::vector<Vec3f>& pose : _motion.Poses()) {
        bytes += pose.capacity() * sizeof(Vec3f);
    }
    for (const auto& [name, slot] : _primvars) {
        bytes += slot.field.Bytes();
    }
    return bytes;
}

}  // namespace cc
