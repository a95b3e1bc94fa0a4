#include "core/trace/surface.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

#include "core/bvh/lookAheadBounds.h"
#include "core/subdiv/patchBuilder.h"

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
    for (Vec3f& p : *points) {
        p = {snap(p.x), snap(p.y), snap(p.z)};
    }
}

}  // namespace

Surface::Surface(const ControlMesh& mesh, const std::vector<Vec3f>& points) {
    _patches = BuildPatchTable(mesh, points.size(), &_error);
    _plans = LimitGridPlans(_patches);
    SetPoints(points);
}

void Surface::SetPoints(const std::vector<Vec3f>& points) {
    CutPolygons(points, &_patches);
    _patchPoints = _patches.PatchPoints(points);
    SnapToLattice(&_patchPoints);
    std::vector<Box3f> boxes(_patches.Count());
    tbb::parallel_for(size_t(0), boxes.size(), [&](size_t i) {
        boxes[i] = LookAheadBounds(_patches, static_cast<uint32_t>(i), _patchPoints.data());
    });
    _bvh = Bvh(boxes);
}

size_t Surface::Bytes() const {
    return _patches.Bytes() + _patchPoints.capacity() * sizeof(Vec3f) + _bvh.Bytes() +
           _plans.Bytes();
}

}  // namespace cc
