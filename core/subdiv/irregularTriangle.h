#pragma once

#include "core/math/box.h"
#include "core/math/vec.h"
#include "core/subdiv/patchTable.h"
#include "core/subdiv/triangleRing.h"

namespace cc {

/// A triangle with the rings of its three corners: all that shapes it under Loop's scheme, whatever
/// valences, creases, corners and boundaries are there. Corners are at parameters (0,0) (1,0)
/// (0,1).
struct IrregularTriangle {
    TriangleRing rings[3];
    /// Which face of each ring the triangle is: its next corner is that ring's edge neighbour of
    /// the same number, its previous corner the one after.
    int faces[3];

    /// One Loop step, into the parts that SubTriangle::Split says.
    void Subdivide(IrregularTriangle parts[4]) const;

    /// If the surface is a quartic box spline, writes its points (BezierTriangle::FromBoxSpline).
    bool ToBoxSpline(Vec3f points[12]) const;

    /// Box of all points that shape the triangle: it holds the surface.
    Box3f HullBox() const;

    /// Limit positions of the corners.
    void LimitCorners(Vec3f corners[3]) const;

    /// Moves all points.
    void Translate(const Vec3f& by);
};

/// @param values  one value a patch point
IrregularTriangle GatherIrregularTriangle(const PatchTable& patches, uint32_t patch,
                                          const Vec3f* values);

}  // namespace cc
