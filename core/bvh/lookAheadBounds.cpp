#include "core/bvh/lookAheadBounds.h"

#include <cmath>

#include "core/math/float4.h"
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

/// Room for the rounding of SplitBoundsOf, against the extent of its points.
constexpr float kBSplineMargin = 1e-6f;

/// Four points of a B-spline curve to the seven Bezier points of the halves of its segment.
inline void SplitBSplineCurve(const Float4& a, const Float4& b, const Float4& c, const Float4& d,
                              Float4 out[7]) {
    const Float4 ab = (a + b) * 0.5f, bc = (b + c) * 0.5f, cd = (c + d) * 0.5f;
    const Float4 nearB = (ab + bc) * 0.25f + b * 0.5f, nearC = (bc + cd) * 0.25f + c * 0.5f;
    const float third = 1 / 3.0f, sixth = 1 / 6.0f;
    out[0] = ((ab + bc) + nearB * 4) * sixth;
    out[1] = (nearB * 2 + bc) * third;
    out[2] = (nearB + bc * 2) * third;
    out[3] = ((nearB + nearC) + bc * 4) * sixth;
    out[4] = (nearC + bc * 2) * third;
    out[5] = (nearC * 2 + bc) * third;
    out[6] = ((bc + cd) + nearC * 4) * sixth;
}

/// Box of the Bezier points of a bicubic B-spline's four quarters: BezierPatch::SplitBounds, for
/// many patches. Points are taken relative to one of them, so that little is rounded.
/// @param pointOf  returns a point's position, by its number
template <class PointOf>
Box3f SplitBoundsOf(const PointOf& pointOf) {
    const Float4 origin = ToFloat4(pointOf(5));
    Float4 extent{}, rows[7][4];
    for (int column = 0; column < 4; ++column) {
        Float4 p[4], curve[7];
        for (int row = 0; row < 4; ++row) {
            p[row] = ToFloat4(pointOf(4 * row + column)) - origin;
            extent = Max(extent, Max(p[row], -p[row]));
        }
        SplitBSplineCurve(p[0], p[1], p[2], p[3], curve);
        for (int row = 0; row < 7; ++row) {
            rows[row][column] = curve[row];
        }
    }
    BoxFloat4 box;
    for (const Float4* row : rows) {
        Float4 curve[7];
        SplitBSplineCurve(row[0], row[1], row[2], row[3], curve);
        for (const Float4& p : curve) {
            box.Extend(p);
        }
    }
    box.lower += origin - extent * kBSplineMargin;
    box.upper += origin + extent * kBSplineMargin;
    return box.ToBox3f();
}

Box3f BSplineBounds(const Vec3f points[16]) {
    return SplitBoundsOf([points](int i) { return points[i]; });
}

Box3f RegularBounds(const uint32_t* indices, const Vec3f* points) {
    return SplitBoundsOf([=](int i) { return points[indices[i]]; });
}

Box3f ExtraordinaryBounds(const PatchTable& patches, uint32_t patch, const Vec3f* points) {
    const uint32_t* indices = patches.Indices(patch);
    ExtraordinaryPatch::Points ring;
    ring.resize(static_cast<size_t>(patches.IndexCount(patch)));
    for (size_t i = 0; i < ring.size(); ++i) {
        ring[i] = points[indices[i]];
    }
    ExtraordinaryPatch extraordinary(ring.data(), patches.At(patch).valence);
    Box3f box;
    for (int step = 0; step < kExtraordinarySteps; ++step) {
        ExtraordinaryPatch::RegularQuarters quarters;
        extraordinary.Subdivide(&quarters);
        for (const auto& quarter : quarters.points) {
            box.Extend(BSplineBounds(quarter));
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
        return BSplineBounds(bspline);
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
        case PatchKind::Regular: return RegularBounds(patches.Indices(patch), points);
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
