#include "core/bvh/lookAheadBounds.h"

#include <cmath>
#include <vector>

#include "core/subdiv/bezierPatch.h"
#include "core/subdiv/bezierTriangle.h"
#include "core/subdiv/extraordinaryPatch.h"
#include "core/subdiv/irregularPatch.h"
#include "core/subdiv/irregularTriangle.h"

namespace cc {
namespace {

/// Room for the rounding of the tracer's own arithmetic, which takes another way to the surface.
constexpr float kRelativeMargin = 4e-7f;

/// Steps around an extraordinary vertex before its 1-ring's hull is taken.
constexpr int kExtraordinarySteps = 3;

/// The same for irregular patches, whose parts multiply along creases.
constexpr int kIrregularSteps = 2;

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
    for (const Vec3f& p : extraordinary.ControlPoints()) {
        box.Extend(p);
    }
    return box;
}

Box3f IrregularBounds(const IrregularPatch& patch, int steps) {
    Vec3f bspline[16];
    if (patch.ToBSpline(bspline)) {
        return BezierPatch::FromBSpline(bspline).SplitBounds();
    }
    if (steps == 0) {
        return patch.HullBox();
    }
    IrregularPatch quarters[4];
    patch.Subdivide(quarters);
    Box3f box;
    for (const IrregularPatch& quarter : quarters) {
        box.Extend(IrregularBounds(quarter, steps - 1));
    }
    return box;
}

Box3f IrregularBounds(const IrregularTriangle& patch, int steps) {
    Vec3f spline[12];
    if (patch.ToBoxSpline(spline)) {
        return BezierTriangle::FromBoxSpline(spline).SplitBounds();
    }
    if (steps == 0) {
        return patch.HullBox();
    }
    IrregularTriangle parts[4];
    patch.Subdivide(parts);
    Box3f box;
    for (const IrregularTriangle& part : parts) {
        box.Extend(IrregularBounds(part, steps - 1));
    }
    return box;
}

Box3f SurfaceBounds(const PatchTable& patches, uint32_t patch, const Vec3f* points) {
    switch (patches.At(patch).kind) {
        case PatchKind::Regular:
        case PatchKind::Bilinear: return GatherBezier(patches, patch, points).SplitBounds();
        case PatchKind::Extraordinary: return ExtraordinaryBounds(patches, patch, points);
        case PatchKind::Irregular:
            return IrregularBounds(GatherIrregular(patches, patch, points), kIrregularSteps);
        case PatchKind::RegularTriangle:
            return GatherBezierTriangle(patches, patch, points).SplitBounds();
        case PatchKind::IrregularTriangle:
            return IrregularBounds(GatherIrregularTriangle(patches, patch, points),
                                   kIrregularSteps);
        case PatchKind::FlatTriangle: {
            Box3f box;
            for (int i = 0; i < 3; ++i) {
                box.Extend(points[patches.Indices(patch)[i]]);
            }
            return box;
        }
    }
    return {};
}

}  // namespace

Box3f LookAheadBounds(const PatchTable& patches, uint32_t patch, const Vec3f* points) {
    Box3f box = SurfaceBounds(patches, patch, points);
    for (int axis = 0; axis < 3; ++axis) {
        const float margin = kRelativeMargin * (std::fabs(box.lower[axis]) +
                                                std::fabs(box.upper[axis]) + box.Diagonal());
        box.lower[axis] -= margin;
        box.upper[axis] += margin;
    }
    return box;
}

}  // namespace cc
