#pragma once

#include "core/math/box.h"
#include "core/math/vec.h"
#include "core/subdiv/patchTable.h"

namespace cc {

/// A bicubic patch in Bezier form, rows along u. Its corners lie on the limit surface and its
/// convex hull is much tighter than that of the B-spline's 1-ring.
struct BezierPatch {
    Vec3f points[4][4];

    /// From the 16 points of a uniform bicubic B-spline.
    static BezierPatch FromBSpline(const Vec3f bspline[16]);
    /// From corners (0,0) (1,0) (1,1) (0,1) of a bilinear quad.
    static BezierPatch FromBilinear(const Vec3f corners[4]);

    Vec3f Position(float u, float v) const;
    /// Derivatives of the position by the parameters.
    Vec3f DerivativeU(float u, float v) const;
    Vec3f DerivativeV(float u, float v) const;

    /// Box of the control points after one split in u and v: it holds the patch.
    Box3f SplitBounds() const;
};

/// Gathers the control points of a regular or bilinear patch.
/// @param values  one value a patch point
BezierPatch GatherBezier(const PatchTable& patches, uint32_t patch, const Vec3f* values);

}  // namespace cc
