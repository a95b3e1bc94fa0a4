#pragma once

#include "core/math/inlineVector.h"
#include "core/math/vec.h"

namespace cc {

/// Sharpness from which on an edge or vertex stays sharp for ever.
constexpr float kInfiniteSharpness = 10;

/// How the sharpness of edges decays at a vertex in one subdivision step.
enum class SharpnessDecay { Uniform, Chaikin };

/// The part of a vertex's 1-ring that shapes one side of it: faces in counterclockwise order
/// around the vertex, all quads, and the tags of their edges. Where two or more edges of the vertex
/// are infinitely sharp or on a boundary, the ring is open and runs from one such edge to the next,
/// because nothing beyond them matters; else it is closed.
///
/// Face j lies between edge neighbours j and j + 1, opposite to which is diagonal j.
struct VertexRing {
    /// Faces up to which a ring needs no allocation.
    static constexpr size_t kInlineFaces = 7;
    using Diagonals = InlineVector<Vec3f, kInlineFaces>;
    using Sharpnesses = InlineVector<float, kInlineFaces + 1>;

    Vec3f center;
    InlineVector<Vec3f, kInlineFaces + 1> edges;  ///< one a face if closed, one more if open
    Diagonals diagonals;                          ///< one a face
    Sharpnesses edgeSharpness;
    /// Sharpness of the vertex's edges that are not in an open ring, where it is above 0.
    InlineVector<float, 2> outsideSharpness;
    float vertexSharpness = 0;
    bool isClosed = true;
    SharpnessDecay decay = SharpnessDecay::Uniform;

    int FaceCount() const { return static_cast<int>(diagonals.size()); }
    /// Index of an edge neighbour, wrapped around in a closed ring.
    int Wrap(int edge) const { return isClosed ? (edge + 2 * FaceCount()) % FaceCount() : edge; }

    /// True if every tag has settled: what is sharp is so for ever.
    bool IsSettled() const;
    /// True if the vertex is in the interior and no tag shapes it.
    bool IsSmooth() const;
    /// True if the surface at the vertex is a bicubic B-spline: an interior vertex of valence 4,
    /// two faces along a boundary or crease, or one face in a corner.
    bool IsRegular() const;

    /// One Catmull-Clark step (DeRose et al. 1998 for the sharpness): the ring of the refined
    /// vertex.
    VertexRing Subdivide() const;

    /// Where the vertex goes in the limit.
    Vec3f LimitPosition() const;

    /// Tangents of the surface at the settled vertex, of arbitrary length, towards the two edges of
    /// a face; their cross product points along the outward normal. Where the surface has a kink
    /// in the face's side, as in a corner of several faces, they are the face's own edges, as
    /// OpenSubdiv has it. Returns false if no mask is known: at a dart, or where a smooth boundary
    /// has a single face.
    bool LimitTangents(int face, Vec3f* towardsEdge, Vec3f* towardsNextEdge) const;

    /// Moves all points.
    void Translate(const Vec3f& by);

  private:
    enum class Rule { Smooth, Crease, Corner };

    Rule _VertexRule() const;
    bool _IsDart() const;
    Vec3f _SmoothTangent(int towardsEdge) const;
    Vec3f _TangentAcrossCrease() const;
    Vec3f _EdgePoint(int edge, const Diagonals& facePoints) const;
    Vec3f _VertexPoint(Rule rule, const Sharpnesses& sharpness, const Diagonals& facePoints) const;
    /// The two neighbours along the sharp edges, of which there must be two.
    void _CreaseNeighbors(const Sharpnesses& sharpness, Vec3f neighbors[2]) const;
    void _DecaySharpness(VertexRing* child) const;
    float _FractionalWeight(const VertexRing& child) const;
};

}  // namespace cc
