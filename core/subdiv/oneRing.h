#pragma once

#include <cstdint>
#include <vector>

#include <opensubdiv/far/topologyLevel.h>

#include "core/subdiv/gridPosition.h"
#include "core/subdiv/refinementLevel.h"
#include "core/subdiv/ringTags.h"

namespace cc {

/// What the neighbourhood of a face looks like, and so how its surface can be had.
enum class FaceShape {
    /// A bicubic B-spline over the 1-ring, some of it extrapolated.
    Regular,
    /// One smooth interior corner of valence other than 4, the rest regular.
    Extraordinary,
    /// Anything else: several extraordinary vertices, sharpness that still decays, a corner, dart
    /// or crease that no B-spline has, or not a quad among quads.
    Irregular,
};

/// The 1-ring of a quad in a 4x4 grid: the face's corners are grid points (1,1) (1,2) (2,2) (2,1)
/// in rows and columns; row 0 lies beyond the edge between corners 0 and 1.
///
/// Where an edge of the face is a boundary or infinitely sharp, the surface ends there for this
/// face and the points beyond are extrapolated (paper, Figure 2d).
struct OneRing {
    static constexpr int kExtrapolated = -1;

    FaceShape shape = FaceShape::Irregular;
    /// Vertices of the level, or kExtrapolated.
    int grid[4][4];
    /// True for edges of the face beyond which points are extrapolated.
    bool isOpen[4];
    /// For FaceShape::Extraordinary: which corner, and the ring around it counterclockwise from
    /// the face's own edge: edge neighbour, face diagonal, edge neighbour, ...
    int extraordinaryCorner = -1;
    std::vector<int> extraordinaryRing;
};

/// Gathers the 1-rings of a level's faces, having looked at each vertex once. Works on any topology
/// that OpenSubdiv accepts.
class OneRings {
  public:
    /// The rule that a vertex follows in the limit, as far as B-splines have it.
    enum class VertexRule : uint8_t {
        Regular,  ///< smooth, among four quads
        Smooth,
        Crease,
        Corner,
        Irregular,
    };

    explicit OneRings(const OpenSubdiv::Far::TopologyLevel& level);

    void Gather(int face, OneRing* ring) const;

  private:
    OpenSubdiv::Far::TopologyLevel _level;
    std::vector<VertexRule> _rules;  ///< one a vertex
};

/// Faces of a vertex up to which quads are patches with its ring. Each of those reads the whole
/// ring, for every ray that comes near, so that n of them cost n^2.
constexpr int kMaxRingFaces = 256;

/// A ring (RingTags) as vertices of the level. All its faces have as many sides, three or four.
struct CornerRing {
    /// The vertex, then its edge neighbours; between those, among quads, the face diagonals; at the
    /// end the neighbours outside.
    std::vector<int> vertices;
    std::vector<int> faces;  ///< in the order of the walk around the vertex
    RingTags tags;
};

/// Gathers the side of a vertex that a face is on. Returns false if a face there has another number
/// of sides than this one, or if the faces do not form a fan.
bool GatherCornerRing(const RefinementLevel& level, int vertex, int face, CornerRing* ring);

}  // namespace cc
