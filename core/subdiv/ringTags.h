#pragma once

#include "core/math/inlineVector.h"

namespace cc {

/// Sharpness from which on an edge or vertex stays sharp for ever.
constexpr float kInfiniteSharpness = 10;

/// How the sharpness of edges decays at a vertex in one subdivision step.
enum class SharpnessDecay { Uniform, Chaikin };

/// The sharpness of a vertex and of its edges, which picks the rules of subdivision in every scheme
/// (DeRose et al. 1998).
///
/// A ring is the part of a vertex's 1-ring that shapes one side of it: faces in counterclockwise
/// order around the vertex, and their edges at it. Where two or more edges of the vertex are
/// infinitely sharp or on a boundary, the ring is open and runs from one such edge to the next,
/// because nothing beyond them matters; else it is closed. Face j lies between edges j and j + 1.
struct RingTags {
    /// Edges up to which a ring needs no allocation.
    static constexpr size_t kInlineEdges = 8;
    using Sharpnesses = InlineVector<float, kInlineEdges>;

    Sharpnesses edgeSharpness;  ///< one a face if closed, one more if open
    /// Sharpness of the vertex's edges that are not in an open ring, where it is above 0.
    InlineVector<float, 2> outsideSharpness;
    /// Under Chaikin's rule, one an edge: the mean sharpness of the other semi-sharp edges at its
    /// far end, or its own if there are none. The uniform rule does not read it.
    Sharpnesses farSharpness;
    /// Under Chaikin's rule, of face-varying values: sharpness of the vertex's semi-sharp edges on
    /// and beyond the seam where the values split. They take part in the mean that edges decay by,
    /// but in nothing else.
    InlineVector<float, 2> seamSharpness;
    /// Where the vertex may lie on a crease that the ring does not have whole, the number of that
    /// crease's edges outside. Their far ends follow the ring's own edge neighbours. One if an open
    /// ring begins and ends with the same edge, which has three or more faces; two if a closed ring
    /// only touches the crease.
    int outsideNeighborCount = 0;
    float vertexSharpness = 0;
    bool isClosed = true;
    SharpnessDecay decay = SharpnessDecay::Uniform;

    enum class Rule { Smooth, Crease, Corner };

    int FaceCount() const { return static_cast<int>(edgeSharpness.size()) - (isClosed ? 0 : 1); }
    /// Index of an edge, wrapped around in a closed ring.
    int Wrap(int edge) const { return isClosed ? (edge + 2 * FaceCount()) % FaceCount() : edge; }
    /// Edge neighbours of the ring, with those outside.
    int NeighborCount() const {
        return static_cast<int>(edgeSharpness.size()) + outsideNeighborCount;
    }
    /// The rule that the vertex follows in the next step.
    Rule VertexRule() const;
    /// True if every tag has settled: what is sharp is so for ever.
    bool IsSettled() const;
    /// True if the vertex is in the interior and no tag shapes it.
    bool IsSmooth() const;
    /// True at the end of a crease: a vertex that is smooth itself, with one sharp edge.
    bool IsDart() const;
    /// True if the vertex lies on a crease that the ring does not have whole.
    bool IsOnOutsideCrease() const {
        return outsideNeighborCount > 0 && VertexRule() == Rule::Crease;
    }
    /// True if the surface at the vertex is the scheme's spline: a smooth vertex of so many faces,
    /// half of them along a boundary or crease, or one face in a corner.
    bool IsRegular(int smoothFaceCount) const;

    /// The tags after a subdivision step.
    RingTags Decayed() const;
    /// How much an edge point follows the rule of a sharp edge: 1 if wholly, 0 if it is smooth. As
    /// in OpenSubdiv it is up to 4/3 where one half of the edge loses its sharpness by Chaikin's
    /// rule at once.
    float EdgeWeight(int edge, const RingTags& decayed) const;
    /// The mean sharpness of the semi-sharp edges but one, or that one's if there are no others.
    float OtherSharpness(int edge) const;
    /// How much of this ring's rule is left in a step that changes it: the mean of the sharpnesses
    /// below 1 that vanish.
    float FractionalWeight(const RingTags& decayed) const;

    /// The sharpness of the half of an edge that is further away, after a step.
    float FarDecayed(int edge) const;
    /// The two edge neighbours along the crease of a vertex that follows its rule.
    void CreaseEdges(int edges[2]) const;
};

}  // namespace cc
