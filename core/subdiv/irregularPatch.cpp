#include "core/subdiv/irregularPatch.h"

#include "core/subdiv/gridPosition.h"

namespace cc {
namespace {

VertexRing GatherRing(const PatchTable& patches, uint32_t index, const Vec3f* values) {
    const PatchRing& stored = patches.Ring(index);
    const uint32_t* points = patches.RingIndices(stored);
    VertexRing ring;
    static_cast<RingTags&>(ring) = patches.TagsOf(stored);
    ring.center = values[*points++];
    for (uint32_t face = 0; face < stored.faceCount; ++face) {
        ring.edges.push_back(values[*points++]);
        ring.diagonals.push_back(values[*points++]);
    }
    if (!stored.isClosed) {
        ring.edges.push_back(values[*points++]);
    }
    for (int i = 0; i < stored.outsideNeighborCount; ++i) {
        ring.edges.push_back(values[*points++]);
    }
    return ring;
}

int Next(int corner) { return (corner + 1) & 3; }
int Opposite(int corner) { return (corner + 2) & 3; }
int Previous(int corner) { return (corner + 3) & 3; }

/// The refined rings of the corners, and what the quarters share.
struct RefinedQuad {
    VertexRing corners[4];
    const int* faces;
    Vec3f face;
    Vec3f edges[4];  ///< edge i runs from corner i to the next
    bool isOpen[4];

    /// The ring of the face point. Its first face is the quarter of a corner.
    VertexRing FaceRing(int corner) const {
        VertexRing ring;
        ring.decay = corners[0].decay;
        ring.center = face;
        for (int k = 0; k < 4; ++k) {
            ring.edges.push_back(edges[(corner + 3 + k) & 3]);
            ring.diagonals.push_back(corners[(corner + k) & 3].center);
        }
        ring.edgeSharpness.assign(4, 0);
        ring.farSharpness.assign(4, 0);
        return ring;
    }

    /// The ring of an edge point. Its first face is the quarter of the edge's second corner.
    VertexRing EdgeRing(int edge) const {
        const int a = edge, b = Next(edge);
        const VertexRing& ringA = corners[a];
        const VertexRing& ringB = corners[b];
        const int edgeA = faces[a], edgeB = ringB.Wrap(faces[b] + 1);
        VertexRing ring;
        ring.decay = ringA.decay;
        ring.center = edges[edge];
        ring.edges = {ringB.center, face, ringA.center};
        ring.diagonals = {edges[b], edges[Previous(a)]};
        ring.edgeSharpness = {ringB.edgeSharpness[edgeB], 0, ringA.edgeSharpness[edgeA]};
        ring.farSharpness = {ringB.OtherSharpness(edgeB), 0, ringA.OtherSharpness(edgeA)};
        if (isOpen[edge]) {
            ring.isClosed = false;
            return ring;
        }
        // Beyond the edge, from corner A's side and from corner B's.
        ring.diagonals.push_back(ringA.edges[ringA.Wrap(faces[a] - 1)]);
        ring.edges.push_back(ringA.diagonals[ringA.Wrap(faces[a] - 1)]);
        ring.diagonals.push_back(ringB.edges[ringB.Wrap(faces[b] + 2)]);
        ring.edgeSharpness.push_back(0);
        ring.farSharpness.push_back(0);
        return ring;
    }
};

}  // namespace

/// An edge that stays sharp for ever, or a boundary: nothing beyond it shapes the quad.
bool IrregularPatch::_IsOpenEdge(int edge) const {
    return rings[edge].edgeSharpness[faces[edge]] >= kInfiniteSharpness;
}

IrregularPatch GatherIrregular(const PatchTable& patches, uint32_t patch, const Vec3f* values) {
    const uint32_t* corners = patches.Indices(patch);
    IrregularPatch result;
    for (int corner = 0; corner < 4; ++corner) {
        result.rings[corner] = GatherRing(patches, corners[2 * corner], values);
        result.faces[corner] = static_cast<int>(corners[2 * corner + 1]);
    }
    return result;
}

void IrregularPatch::Subdivide(IrregularPatch quarters[4]) const {
    RefinedQuad refined;
    refined.faces = faces;
    for (int corner = 0; corner < 4; ++corner) {
        refined.corners[corner] = rings[corner].Subdivide();
    }
    refined.face = refined.corners[0].diagonals[faces[0]];
    for (int edge = 0; edge < 4; ++edge) {
        refined.edges[edge] = refined.corners[edge].edges[faces[edge]];
        refined.isOpen[edge] = _IsOpenEdge(edge);
    }
    VertexRing edgeRings[4];
    for (int edge = 0; edge < 4; ++edge) {
        edgeRings[edge] = refined.EdgeRing(edge);
    }
    for (int corner = 0; corner < 4; ++corner) {
        IrregularPatch& quarter = quarters[corner];
        quarter.rings[corner] = refined.corners[corner];
        quarter.faces[corner] = faces[corner];
        // The edge to the next corner: the quarter is its ring's second face.
        quarter.rings[Next(corner)] = edgeRings[corner];
        quarter.faces[Next(corner)] = 1;
        quarter.rings[Opposite(corner)] = refined.FaceRing(corner);
        quarter.faces[Opposite(corner)] = 0;
        quarter.rings[Previous(corner)] = edgeRings[Previous(corner)];
        quarter.faces[Previous(corner)] = 0;
    }
}

bool IrregularPatch::ToBSpline(Vec3f points[16]) const {
    for (const VertexRing& ring : rings) {
        if (!ring.IsRegular()) {
            return false;
        }
    }
    Vec3f grid[4][4];
    _GatherGrid(grid);
    for (int i = 0; i < 16; ++i) {
        points[i] = grid[i / 4][i % 4];
    }
    return true;
}

int IrregularPatch::ToExtraordinary(ExtraordinaryPatch::Points* points) const {
    int extraordinary = -1;
    for (int corner = 0; corner < 4; ++corner) {
        if (!rings[corner].IsRegular()) {
            if (extraordinary >= 0 || !rings[corner].IsSmooth()) {
                return -1;
            }
            extraordinary = corner;
        }
    }
    if (extraordinary < 0) {
        return -1;
    }
    Vec3f grid[4][4];
    _GatherGrid(grid);
    const VertexRing& ring = rings[extraordinary];
    *points = {ring.center};
    for (int i = 0; i < ring.FaceCount(); ++i) {
        points->push_back(ring.edges[ring.Wrap(faces[extraordinary] + i)]);
        points->push_back(ring.diagonals[ring.Wrap(faces[extraordinary] + i)]);
    }
    const int c1 = Next(extraordinary), c2 = Opposite(extraordinary), c3 = Previous(extraordinary);
    for (const GridPosition& at :
         {GridDiagonal(c1), GridAcross(c1, c1), GridAcross(c2, c1), GridDiagonal(c2),
          GridAcross(c2, c2), GridAcross(c3, c2), GridDiagonal(c3)}) {
        points->push_back(grid[at.row][at.column]);
    }
    return extraordinary;
}

/// Fills the 4x4 grid around the quad (OneRing). The diagonal beyond an extraordinary vertex means
/// nothing.
void IrregularPatch::_GatherGrid(Vec3f grid[4][4]) const {
    const auto at = [grid](GridPosition p) -> Vec3f& { return grid[p.row][p.column]; };
    bool isOpen[4];
    for (int corner = 0; corner < 4; ++corner) {
        at(GridCorner(corner)) = rings[corner].center;
        isOpen[corner] = _IsOpenEdge(corner);
    }
    for (int corner = 0; corner < 4; ++corner) {
        const VertexRing& ring = rings[corner];
        const int face = faces[corner];
        if (ring.isClosed) {
            at(GridAcross(corner, corner + 3)) = ring.edges[ring.Wrap(face + 2)];
            at(GridDiagonal(corner)) = ring.diagonals[ring.Wrap(face + 2)];
            at(GridAcross(corner, corner)) = ring.edges[ring.Wrap(face - 1)];
        } else if (ring.FaceCount() == 2) {
            at(face == 0 ? GridAcross(corner, corner + 3) : GridAcross(corner, corner)) =
                face == 0 ? ring.edges[2] : ring.edges[0];
        }
    }
    // Beyond open edges the grid is extrapolated (paper, Figure 2d).
    for (int edge = 0; edge < 4; ++edge) {
        if (isOpen[edge]) {
            const int a = edge, b = Next(edge);
            at(GridAcross(a, edge)) = rings[a].center * 2 - rings[Previous(a)].center;
            at(GridAcross(b, edge)) = rings[b].center * 2 - rings[Next(b)].center;
        }
    }
    for (int corner = 0; corner < 4; ++corner) {
        const int previous = Previous(corner);
        if (isOpen[corner]) {
            at(GridDiagonal(corner)) =
                at(GridAcross(corner, previous)) * 2 - at(GridAcross(previous, previous));
        } else if (isOpen[previous]) {
            at(GridDiagonal(corner)) =
                at(GridAcross(corner, corner)) * 2 - at(GridAcross(corner + 1, corner));
        }
    }
}

Box3f IrregularPatch::HullBox() const {
    Box3f box;
    for (const VertexRing& ring : rings) {
        box.Extend(ring.center);
        for (const Vec3f& p : ring.edges) {
            box.Extend(p);
        }
        for (const Vec3f& p : ring.diagonals) {
            box.Extend(p);
        }
    }
    return box;
}

void IrregularPatch::LimitCorners(Vec3f corners[4]) const {
    for (int corner = 0; corner < 4; ++corner) {
        corners[corner] = rings[corner].LimitPosition();
    }
}

void IrregularPatch::Translate(const Vec3f& by) {
    for (VertexRing& ring : rings) {
        ring.Translate(by);
    }
}

}  // namespace cc
