#pragma once

#include "core/math/inlineVector.h"
#include "core/math/vec.h"
#include "core/subdiv/ringTags.h"

namespace cc {

/// A ring of quads (RingTags) with its points. Opposite to the vertex in face j, between edge
/// neighbours j and j + 1, is diagonal j.
struct VertexRing : RingTags {
    using Diagonals = InlineVector<Vec3f, kInlineEdges - 1>;

    Vec3f center;
    InlineVector<Vec3f, kInlineEdges> edges;  ///< NeighborCount
    Diagonals diagonals;                      ///< one a face

    /// True if the surface at the vertex is a bicubic B-spline.
    bool IsRegular() const { return RingTags::IsRegular(4); }

    /// One Catmull-Clark step: the ring of the refined vertex.
    VertexRing Subdivide() const;

    /// Where the vertex goes in the limit.
    Vec3f LimitPosition() const;

    /// Tangents of the surface at the settled vertex, of arbitrary length, towards the two edges of
    /// a face; their cross product points along the outward normal. Where the surface has a kink
    /// in the face's side, as in a corner of several faces, they are the face's own edges, as
    /// OpenSubdiv has it. Returns false if no mask is known: at a dart, on a crease
    /// that the ring does not have whole, or where a smooth boundary has a single face.
    bool LimitTangents(int face, Vec3f* towardsEdge, Vec3f* towardsNextEdge) const;

    /// Moves all points.
    void Translate(const Vec3f& by);

  private:
    Vec3f _SmoothTangent(int towardsEdge) const;
    Vec3f _TangentAcrossCrease() const;
    Vec3f _EdgePoint(int edge, float sharpness, const Diagonals& facePoints) const;
    Vec3f _VertexPoint(const RingTags& tags, const Diagonals& facePoints) const;
};

}  // namespace cc
