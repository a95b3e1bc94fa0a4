#pragma once

#include "core/math/inlineVector.h"
#include "core/math/vec.h"
#include "core/subdiv/patchTable.h"
#include "core/subdiv/pointRing.h"

namespace cc {

/// A ring of triangles, under Loop's scheme (Loop 1987) with creases
/// (Hoppe et al. 1994).
struct TriangleRing : PointRing<TriangleRing> {
    /// True if the surface at the vertex is a quartic box spline.
    bool IsRegular() const { return RingTags::IsRegular(6); }

    /// The six neighbours of a regular vertex, counterclockwise from edge neighbour `face` on.
    /// Those beyond a boundary or crease are extrapolated, so that the box spline has it.
    void RegularNeighbors(int face, Vec3f neighbors[6]) const;

    /// One Loop step: the ring of the refined vertex.
    TriangleRing Subdivide() const;

    /// Moves all points.
    void Translate(const Vec3f& by);

  private:
    friend PointRing;

    static const Vec3f* _Diagonals() { return nullptr; }
    Vec3f _EdgePoint(int edge, float sharpness) const;
    Vec3f _VertexPoint(const RingTags& tags) const;
    Vec3f _EdgeSum() const;
    Vec3f _SmoothLimit() const;
    Vec3f _SmoothTangent(int towardsEdge) const;
    Vec3f _TangentAcrossCrease() const;
};

/// @param values  one value a patch point
TriangleRing GatherTriangleRing(const PatchTable& patches, uint32_t ring, const Vec3f* values);

}  // namespace cc
