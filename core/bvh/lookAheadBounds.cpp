#include "core/bvh/lookAheadBounds.h"

#include <cmath>
#include <vector>

#include "core/subdiv/bezierPatch.h"
#include "core/subdiv/extraordinaryPatch.h"

namespace cc {
namespace {

/// Room for the rounding of the tracer's own arithmetic, which takes another way to the surface.
constexpr float kRelativeMargin = 4e-7f;

/// Steps around an extraordinary vertex before its 1-ring's hull is taken.
constexpr int kExtraordinarySteps = 3;

Box3f ExtraordinaryBounds(const PatchTable& patches, uint32_t patch, const Vec3f* points) {
    const uint32_t* indices = patches.Indices(patch);
    std::vector<Vec3f> ring(patches.IndexCount(patch));
    for (size_t i = 0; i < ring.size(); ++i) {
        ring[i] = points[indices[i]];
    }
    ExtraordinaryPatch extraordinary(ring.data(), patches.At(patch).valence);
    Box3f box;
    for (int step = 0; step < kExtraordinarySteps; ++step) {
        ExtraordinaryPatch::RegularQuarters quarters;
        extraordinary.Subdivide(&quarters);
        for (const auto& quarter : quarters.points) {
            box.Extend(BezierPatch::FromBSpline(quarter).SplitBounds());
        }
    }
    for (const Vec3f& p : extraordinary.Points()) {
        box.Extend(p);
    }
    return box;
}

}  // namespace

Box3f LookAheadBounds(const PatchTable& patches, uint32_t patch, const Vec3f* points) {
    Box3f box = patches.At(patch).kind == PatchKind::Extraordinary
                    ? ExtraordinaryBounds(patches, patch, points)
                    : GatherBezier(patches, patch, points).SplitBounds();
    for (int axis = 0; axis < 3; ++axis) {
        const float margin = kRelativeMargin * (std::fabs(box.lower[axis]) +
                                                std::fabs(box.upper[axis]) + box.Diagonal());
        box.lower[axis] -= margin;
        box.upper[axis] += margin;
    }
    return box;
}

}  // namespace cc
