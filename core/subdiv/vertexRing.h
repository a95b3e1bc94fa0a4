#pragma once

#include "core/math/inlineVector.h"
#include "core/math/vec.h"
#include "core/subdiv/pointRing.h"

namespace cc {

/// A ring of quads, under Catmull-Clark. Opposite to the vertex in face j, between edge
/// neighbours j and j + 1, is diagonal j.
struct VertexRing : PointRing<VertexRing> {
    using Diagonals = InlineVector<Vec3f, kInlineEdges - 1>;

    Diagonals diagonals;  ///< one a face

    /// True if the surface at the vertex is a bicubic B-spline.
    bool IsRegular() const { return RingTags::IsRegular(4); }

    /// One Catmull-Clark step: the ring of the refined vertex.
    VertexRing Subdivide() const;

    /// Moves all points.
    void Translate(const Vec3f& by);

  private:
    friend PointRing;

    const Vec3f* _Diagonals() const { return diagonals.data(); }
    Vec3f _SmoothLimit() const;
    Vec3f _SmoothTangent(int towardsEdge) const;
    Vec3f _TangentAcrossCrease() const;
    Vec3f _EdgePoint(int edge, float sharpness, const Diagonals& facePoints) const;
    Vec3f _VertexPoint(const RingTags& tags, const Diagonals& facePoints) const;
};

}  // namespace cc
