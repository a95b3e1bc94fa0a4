#pragma once

#include "core/math/inlineVector.h"
#include "core/math/vec.h"
#include "core/subdiv/patchTable.h"
#include "core/subdiv/ringTags.h"

namespace cc {

/// A ring of triangles (RingTags) with its points, under Loop's scheme (Loop 1987) with creases
/// (Hoppe et al. 1994).
struct TriangleRing : RingTags {
    Vec3f center;
    InlineVector<Vec3f, kInlineEdges> edges;  ///< NeighborCount

    /// True if the surface at the vertex is a quartic box spline.
    bool IsRegular() const { return RingTags::IsRegular(6); }

    /// The six neighbours of a regular vertex, counterclockwise from edge neighbour `face` on.
    /// Those beyond a boundary or crease are extrapolated, so that the box spline has it.
    void RegularNeighbors(int face, Vec3f neighbors[6]) const;

    /// One Loop step: the ring of the refined vertex.
    TriangleRing Subdivide() const;

    /// Where the vertex goes in the limit.
    Vec3f LimitPosition() const;

    /// Tangents of the surface at the settled vertex, of arbitrary length, towards the two edges of
    /// a face; their cross product points along the outward normal. In a corner they are those of
    /// LoopCornerTangents. Returns false if no mask is known: at a dart, where a smooth boundary
    /// has a single face, or where LoopCornerTangents knows none.
    bool LimitTangents(int face, Vec3f* towardsEdge, Vec3f* towardsNextEdge) const;

    /// Moves all points.
    void Translate(const Vec3f& by);

  private:
    Vec3f _EdgePoint(int edge, float sharpness) const;
    Vec3f _VertexPoint(const RingTags& tags) const;
    Vec3f _EdgeSum() const;
    Vec3f _TangentAcrossCrease() const;
    bool _CornerTangents(int face, Vec3f* towardsEdge, Vec3f* towardsNextEdge) const;
};

/// @param values  one value a patch point
TriangleRing GatherTriangleRing(const PatchTable& patches, uint32_t ring, const Vec3f* values);

}  // namespace cc
