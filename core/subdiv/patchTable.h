#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/math/vec.h"
#include "core/subdiv/ringTags.h"
#include "core/subdiv/triangulation.h"

namespace cc {

/// How the control points of a patch define its surface.
enum class PatchKind : uint8_t {
    /// 16 points: a bicubic B-spline, the 1-ring of a regular quad (paper, Figure 2b). Rows run
    /// along u; the face's corners are points 5, 6, 10 and 9.
    Regular,
    /// 4 points: a bilinear quad, corners in the order (0,0) (1,0) (1,1) (0,1).
    Bilinear,
    /// 2n + 8 points: a quad with one extraordinary vertex of valence n at (0,0) (Figure 2c), in
    /// the order of ExtraordinaryPatch.
    Extraordinary,
    /// Four rings, one a corner, each with the quad's place in it: creases, corners, boundaries and
    /// valences as they come (IrregularPatch).
    Irregular,
    /// 12 points: a quartic box spline, the 1-ring of a regular triangle of the Loop scheme, in the
    /// order of BezierTriangle::FromBoxSpline.
    RegularTriangle,
    /// Three rings, one a corner, each with the triangle's place in it (IrregularTriangle).
    IrregularTriangle,
    /// 3 points: a flat triangle of a polygon, of scheme none. Beside them, the table knows which
    /// corners of the polygon they are.
    FlatTriangle,
};

/// Sides of the 16 points of a regular patch: beyond v = 0 and 1, and u = 0 and 1.
enum PatchSide : uint8_t { kLowRow = 1, kHighRow = 2, kLowColumn = 4, kHighColumn = 8 };

/// One quad of the surface with its 1-ring, one triangle under the Loop scheme, or one of those
/// that a polygon is cut into.
struct Patch {
    uint32_t firstIndex;      ///< into PatchTable's index array
    uint32_t face;            ///< the authored face
    uint32_t corner;          ///< of an n-gon: which of its n sub-quads or n - 2 triangles; else 0
    uint16_t cellU, cellV;    ///< which of the 2^cellDepth x 2^cellDepth cells of the (sub-)quad
    uint16_t valence;         ///< largest at its corners: 4 if it is regular, 6 as a triangle
    uint8_t depth : 2;        ///< refinement steps between the cage and this quad
    uint8_t outerCorner : 2;  ///< of a refined quad: the corner that it shares with its parent
    /// A bit for each side of a regular patch, by PatchSide, whose outer points are 2a - b, a being
    /// the points of its edge and b those behind.
    uint8_t extrapolatedSides : 4;
    PatchKind kind : 4;
    uint8_t rotation : 2;   ///< corner of the cell that (0,0) of the patch lies at
    uint8_t isSubQuad : 1;  ///< the authored face is not a quad: cells count from its sub-quads
};
static_assert(sizeof(Patch) == 20, "with 16 indices, the 84 bytes of docs/performance.md");

/// A vertex with the faces and tags that shape one side of it (RingTags), shared by the irregular
/// patches around the vertex. Its points are the vertex, then its edge neighbours, and among quads
/// the face diagonals between those, then the neighbours outside; its sharpnesses are those of the
/// edges, then outsideCount others, then under Chaikin's rule those at the edges' far ends and
/// seamCount beyond seams.
struct PatchRing {
    uint32_t firstIndex;
    uint32_t firstSharpness;
    uint16_t faceCount;
    uint16_t outsideCount;
    uint16_t seamCount;
    bool isClosed;
    uint8_t outsideNeighborCount;
    float vertexSharpness;
};

/// Where a point of a patch lies on its authored face. On a quad, (0,0) is the first corner and u
/// runs towards the second. On an n-gon, (u, v) covers the sub-quad of one corner: (0,0) is that
/// corner, u runs towards the middle of the edge to the next one, (1,1) is the face's centre. On a
/// triangle of the Loop scheme, (0,0) is the first corner, (1,0) the second and (0,1) the third; so
/// it is on each triangle of a polygon of scheme none, where `corner` counts the triangles.
struct FaceParameter {
    uint32_t face;
    uint32_t corner;
    float u, v;
    bool isTriangle = false;
};

/// Patch points at the ends of an edge.
struct EdgePoints {
    uint32_t a, b;
};

/// A value made from others: the sum of weight times value.
struct Stencil {
    std::vector<uint32_t> indices;
    std::vector<float> weights;
};

/// All patches of a mesh. They share points: the points of the cage come first, then those that
/// refinement and extrapolation add, each a weighted sum of points before it. Positions and vertex
/// primvars are refined alike.
class PatchTable {
  public:
    size_t Count() const { return _patches.size(); }
    const Patch& At(uint32_t patch) const { return _patches[patch]; }
    const uint32_t* Indices(uint32_t patch) const { return &_indices[_patches[patch].firstIndex]; }
    /// Number of indices of a patch: of its points, or for an irregular one pairs of a ring and a
    /// face of it, one a corner.
    int IndexCount(uint32_t patch) const;
    /// Asks for a patch's indices, which are to be read soon. Always inline: GCC takes a function
    /// that does nothing else for one without effect, and drops its calls.
    __attribute__((always_inline)) void Prefetch(uint32_t patch) const {
        const uint32_t* indices = Indices(patch);
        __builtin_prefetch(indices);
        __builtin_prefetch(indices + 15);
    }
    uint32_t AuthoredFace(uint32_t patch) const { return _patches[patch].face; }
    /// True if a patch is a triangle: its parameters have u + v <= 1, and its corners are at (0,0),
    /// (1,0) and (0,1). Other patches are quads over the unit square.
    bool IsTriangle(uint32_t patch) const {
        return _patches[patch].kind >= PatchKind::RegularTriangle;
    }
    /// Which corners of its authored face the corners of a triangle are.
    PolygonTriangle TriangleCorners(uint32_t patch) const;
    /// The control points at the corners of a patch that is a quad.
    void Corners(uint32_t patch, uint32_t corners[4]) const;
    /// The points at the ends of each edge of a quad, edge 0 from corner 0 to 1: of the whole edge
    /// if refinement has left the patch half of one. Patches that share an edge, or parts of it,
    /// find the same two points, maybe the other way round.
    void EdgeEnds(uint32_t patch, EdgePoints edges[4]) const;
    /// True if all patches must be cut into equally many pieces, for want of edges that both sides
    /// know by the same points: triangles, and quads between limit points.
    bool IsCutAlike() const { return _hasLimitQuads || (!_patches.empty() && IsTriangle(0)); }
    /// Refinement steps of the patch that took most of them.
    int MaxDepth() const { return _maxDepth; }
    /// True if the cage's faces run clockwise: normals are flipped.
    bool IsLeftHanded() const { return _leftHanded; }

    const PatchRing& Ring(uint32_t ring) const { return _rings[ring]; }
    const uint32_t* RingIndices(const PatchRing& ring) const { return &_indices[ring.firstIndex]; }
    /// Which vertex, edges and sharpnesses a ring has, without its points.
    RingTags TagsOf(const PatchRing& ring) const;
    SharpnessDecay Decay() const { return _decay; }

    size_t CagePointCount() const { return _cagePointCount; }
    size_t PointCount() const { return _cagePointCount + _stencilEnds.size(); }

    /// The values of all patch points, given those of the cage's (CagePointCount of them).
    std::vector<Vec3f> PatchPoints(const std::vector<Vec3f>& cageValues) const;

    /// Where on its authored face a patch has its parameters u, v in 0..1.
    FaceParameter ToFace(uint32_t patch, float u, float v) const;

    /// Memory held, in bytes.
    size_t Bytes() const;

    // For builders:

    PatchTable() = default;
    PatchTable(size_t cagePointCount, bool leftHanded, SharpnessDecay decay)
        : _cagePointCount(cagePointCount), _decay(decay), _leftHanded(leftHanded) {}
    /// Adds a point made of earlier ones; returns its index.
    uint32_t AddPoint(const Stencil& stencil);
    /// Adds the point 2a - b: what most points are that lie beyond a boundary.
    uint32_t AddExtrapolatedPoint(uint32_t a, uint32_t b);
    /// Adds a patch; its firstIndex is set to where its indices go.
    void AddPatch(Patch patch, const uint32_t* indices, int count);
    /// Says that there are quads between limit points (RefinementLevel::LimitPoint).
    void NoteLimitQuads() { _hasLimitQuads = true; }
    /// Says which edges the last patch has parts of, a refined quad: the edge that begins at its
    /// outer corner, and the one that ends there.
    void AddOuterEdges(const EdgePoints& next, const EdgePoints& previous);
    /// Adds the triangles of a polygon, given the points of its corners.
    void AddPolygon(uint32_t face, const std::vector<uint32_t>& points,
                    const std::vector<PolygonTriangle>& triangles);
    /// Cuts a polygon anew, as many triangles as before, given its first patch.
    void RecutPolygon(uint32_t firstPatch, const std::vector<uint32_t>& points,
                      const std::vector<PolygonTriangle>& triangles);
    /// Adds a ring; returns its index.
    uint32_t AddRing(PatchRing ring, const std::vector<uint32_t>& indices,
                     const std::vector<float>& sharpnesses);
    /// Gives back memory that was reserved for growth.
    void Finish();

  private:
    static constexpr uint32_t kExtrapolated = 0x80000000u;

    uint8_t _ExtrapolatedSides(const uint32_t* indices) const;
    bool _IsExtrapolated(uint32_t index) const {
        return index >= _cagePointCount &&
               (_stencilEnds[index - _cagePointCount] & kExtrapolated) != 0;
    }
    bool _IsExtrapolatedFrom(uint32_t index, uint32_t a, uint32_t b) const;

    void _SetTriangle(uint32_t* indices, const std::vector<uint32_t>& points,
                      const PolygonTriangle& triangle);

    std::vector<Patch> _patches;
    std::vector<uint32_t> _indices;
    std::vector<PatchRing> _rings;
    std::vector<float> _sharpnesses;
    size_t _cagePointCount = 0;
    /// Of each point that was added: where its indices end, and kExtrapolated if they are two
    /// points without weights.
    std::vector<uint32_t> _stencilEnds;
    std::vector<uint32_t> _stencilIndices;
    std::vector<float> _stencilWeights;
    int _maxDepth = 0;
    bool _hasLimitQuads = false;
    SharpnessDecay _decay = SharpnessDecay::Uniform;
    bool _leftHanded = false;
};

}  // namespace cc
