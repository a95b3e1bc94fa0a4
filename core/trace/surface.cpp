#include "core/trace/surface.h"

#include <tbb/parallel_for.h>

#include "core/bvh/lookAheadBounds.h"
#include "core/subdiv/patchBuilder.h"

namespace cc {

Surface::Surface(const ControlMesh& mesh, const std::vector<Vec3f>& points) {
    _patches = BuildPatchTable(mesh, points.size(), &_error);
    _plans = LimitGridPlans(_patches);
    SetPoints(points);
}

void Surface::SetPoints(const std::vector<Vec3f>& points) {
    CutPolygons(points, &_patches);
    _patchPoints = _patches.PatchPoints(points);
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
