#include "limitGrids.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "core/subdiv/limitPoint.h"

namespace {

/// Points a side of a patch's grid: patches that refinement made are smaller than a face.
int PointsPerSide(const cc::Patch& patch, int level) {
    return (1 << std::max(level - patch.depth, 0)) + 1;
}

void EvaluateGrid(const cc::Surface& surface, uint32_t patch,
                  const cc::AffineTransform& objectToWorld, int side, cc::Vec3f* points) {
    const float step = 1.0f / static_cast<float>(side - 1);
    for (int v = 0; v < side; ++v) {
        for (int u = 0; u < side; ++u) {
            *points++ = objectToWorld.Point(EvaluateLimitValue(
                surface.Patches(), patch, surface.PatchPoints().data(), u * step, v * step));
        }
    }
}

}  // namespace

LimitGrids EvaluateLimitGrids(const cc::Surface& surface, const cc::AffineTransform& objectToWorld,
                              int level) {
    LimitGrids made;
    size_t pointCount = 0;
    for (uint32_t patch = 0; patch < surface.Patches().Count(); ++patch) {
        const int side = PointsPerSide(surface.Patches().At(patch), level);
        made.grids.push_back({static_cast<uint32_t>(pointCount), side});
        pointCount += static_cast<size_t>(side) * side;
    }
    made.points.resize(pointCount);
    const auto evaluate = [&](const tbb::blocked_range<size_t>& range) {
        for (size_t i = range.begin(); i < range.end(); ++i) {
            const LimitGrids::Grid& grid = made.grids[i];
            EvaluateGrid(surface, static_cast<uint32_t>(i), objectToWorld, grid.side,
                         &made.points[grid.firstPoint]);
        }
    };
    tbb::parallel_for(tbb::blocked_range<size_t>(0, made.grids.size()), evaluate);
    return made;
}
