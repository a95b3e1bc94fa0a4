#include "core/trace/surface.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "core/bvh/lookAheadBounds.h"
#include "core/subdiv/limitPoint.h"
#include "core/subdiv/patchBuilder.h"
#include "core/trace/instanceLevels.h"
#include "core/trace/surfaceSide.h"

namespace cc {

namespace {

/// Rounds coordinates to a lattice that is finer than the largest of them by 40 bits: sums of them
/// with small whole weights, in doubles, are then exact and do not depend on their order.
void SnapToLattice(std::vector<Vec3f>* points) {
    float largest = 0;
    for (const Vec3f& p : *points) {
        largest = std::max({largest, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
    }
    if (largest < 1e-20f) {
        return;  // so small that the lattice would be no normal numbers
    }
    const double step = std::ldexp(1.0, std::ilogb(largest) - 40);
    const double inverse = 1 / step;
    const auto snap = [&](float x) {
        return static_cast<float>(std::nearbyint(x * inverse) * step);
    };
    tbb::parallel_for(size_t(0), points->size(), [&](size_t i) {
        Vec3f& p = (*points)[i];
        p = {snap(p.x), snap(p.y), snap(p.z)};
    });
}

/// Room for the rounding of points between poses.
constexpr float kPoseMargin = 2e-7f;

/// Extends boxes by others, and both by the rounding of what is between them.
void ExtendBoxes(const std::vector<Box3f>& others, std::vector<Box3f>* boxes) {
    for (size_t i = 0; i < boxes->size(); ++i) {
        Box3f& box = (*boxes)[i];
        box.Extend(others[i]);
        for (int axis = 0; axis < 3; ++axis) {
            const float margin =
                kPoseMargin * (std::fabs(box.lower[axis]) + std::fabs(box.upper[axis]));
            box.lower[axis] -= margin;
            box.upper[axis] += margin;
        }
    }
}

}  // namespace

Surface::Surface(const ControlMesh& mesh, const std::vector<Vec3f>& points)
    : Geometry(GeometryKind::Surface) {
    _patches = BuildPatchTable(mesh, points.size(), &_error);
    _plans = LimitGridPlans(_patches);
    SetPoints(points);
}

void Surface::SetPoints(const std::vector<Vec3f>& points) {
    DropTessellation();
    CutPolygons(points, &_patches);
    _patchPoints = _patches.PatchPoints(points);
    SnapToLattice(&_patchPoints);
    _bvh.Move(LookAheadBounds(_patches, _plans, _patchPoints.data()));
    _errors = ChordErrors(_patches, _plans, _patchPoints, Bounds().Diagonal());
}

void Surface::SetPoses(const std::vector<std::vector<Vec3f>>& poses) {
    DropTessellation();
    std::vector<std::vector<Vec3f>> patchPoints;
    std::vector<Box3f> boxes;
    for (const std::vector<Vec3f>& pose : poses) {
        patchPoints.push_back(_patches.PatchPoints(pose));
        SnapToLattice(&patchPoints.back());
        std::vector<Box3f> ofPose = LookAheadBounds(_patches, _plans, patchPoints.back().data());
        if (boxes.empty()) {
            boxes = std::move(ofPose);
        } else {
            ExtendBoxes(ofPose, &boxes);
        }
    }
    _bvh.Move(boxes);
    _errors = {};
    for (const std::vector<Vec3f>& points : patchPoints) {
        ChordErrors errors(_patches, _plans, points, Bounds().Diagonal());
        errors.Raise(_errors);
        _errors = std::move(errors);
    }
}

void Surface::Pose(const std::vector<Vec3f>& points) {
    DropTessellation();
    _patchPoints = _patches.PatchPoints(points);
    SnapToLattice(&_patchPoints);
}

GeometryPoint Surface::PointAt(const GeometryHit& hit, const Instance& instance,
                               const LevelMetric& levels) const {
    const LimitPoint limit =
        EvaluateLimit(_patches, hit.primitive, _patchPoints.data(), hit.u, hit.v);
    const LimitPoint onFace = ByFaceParameter(_patches, hit.primitive, limit);
    const PatchLevels traced = InstanceLevels(levels, instance).Of(hit.primitive);
    return {limit.position, limit.normal, onFace.du, onFace.dv,
            IsInnerSide(*this, hit, limit, traced)};
}

const Tessellation& Surface::TessellationAt(int level) const {
    const int wanted = Tessellation::LevelOf(_patches, level);
    const Tessellation* found = _tessellation.load(std::memory_order_acquire);
    if (found && found->Level() == wanted) {
        return *found;
    }
    const std::lock_guard<std::mutex> lock(_tessellationMutex);
    if (!_ownedTessellation || _ownedTessellation->Level() != wanted) {
        // Isolated: a thread that waits for its own part of this work must not take up another task
        // that comes here and finds the mutex taken, by itself.
        tbb::this_task_arena::isolate([&] {
            _ownedTessellation = std::make_unique<Tessellation>(_patches, _patchPoints, level);
        });
        _tessellation.store(_ownedTessellation.get(), std::memory_order_release);
    }
    return *_ownedTessellation;
}

void Surface::DropTessellation() {
    _tessellation = nullptr;
    _ownedTessellation.reset();
}

size_t Surface::Bytes() const {
    return _patches.Bytes() + _patchPoints.capacity() * sizeof(Vec3f) + _bvh.Bytes() +
           _plans.Bytes() + _errors.Bytes() + TessellationBytes();
}

size_t Surface::TessellationBytes() const {
    return _ownedTessellation ? _ownedTessellation->Bytes() : 0;
}

}  // namespace cc
