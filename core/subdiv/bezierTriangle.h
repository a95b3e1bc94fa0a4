#pragma once

#include <array>

#include "core/math/box.h"
#include "core/math/vec.h"
#include "core/subdiv/patchTable.h"

namespace cc {

/// A quartic Bezier triangle. Its corners lie on the surface, at parameters (0,0), (1,0) and (0,1),
/// and its convex hull is much tighter than that of the box spline's 1-ring.
///
/// The 15 points are: three corners; on each edge, from corner i to the next, the points nearest to
/// its first and second corner; the middle points of the edges; the three points inside, each next
/// to a corner.
struct BezierTriangle {
    static constexpr int kPointCount = 15;

    Vec3f points[kPointCount];

    /// From the 12 points of a quartic box spline: the triangle's corners 0, 1 and 2, then the nine
    /// points around it, counterclockwise. Beyond corner i are points 3 + 3i and 4 + 3i, and beyond
    /// the edge from there to the next corner is point 5 + 3i.
    static BezierTriangle FromBoxSpline(const Vec3f spline[12]);

    Vec3f Position(float u, float v) const;
    /// Derivatives of the position by the parameters.
    Vec3f DerivativeU(float u, float v) const;
    Vec3f DerivativeV(float u, float v) const;

    /// Box of the control points after one split into four: it holds the patch.
    Box3f SplitBounds() const;
};

/// A triangle of the parameters of another. Sub-triangles i = 0..2 of a split hold corner i; the
/// fourth lies in the middle, turned by half a turn, and its size is negative.
struct SubTriangle {
    float u = 0, v = 0;  ///< of its first corner
    float size = 1;      ///< the second is at (u + size, v), the third at (u, v + size)

    constexpr SubTriangle Split(int i) const {
        const float half = size / 2;
        return {i == 1 || i == 3 ? u + half : u, i >= 2 ? v + half : v, i == 3 ? -half : half};
    }
};

/// Weights of 15 points in one that is made of them.
using BezierTriangleWeights = std::array<float, BezierTriangle::kPointCount>;

/// How control point i of a sub-triangle comes from those of the whole (de Casteljau).
BezierTriangleWeights SubTriangleWeights(const SubTriangle& part, int i);

/// How the point of the surface at u, v comes from the control points.
BezierTriangleWeights PositionWeights(float u, float v);

/// Gathers the control points of a regular triangle.
/// @param values  one value a patch point
BezierTriangle GatherBezierTriangle(const PatchTable& patches, uint32_t patch, const Vec3f* values);

}  // namespace cc
