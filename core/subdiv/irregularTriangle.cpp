#include "core/subdiv/irregularTriangle.h"

namespace cc {
namespace {

int Next(int corner) { return (corner + 1) % 3; }
int Previous(int corner) { return (corner + 2) % 3; }

/// The ring of the vertex in the middle of an edge, from the refined rings of the triangle's
/// corners. Its faces are the part at the edge's second corner, the middle part, and the part at
/// its first corner; beyond them lies the other side of the edge.
TriangleRing MiddleRing(const TriangleRing corners[3], const int faces[3], int edge, bool isOpen) {
    const int a = edge, b = Next(edge), c = Previous(edge);
    const TriangleRing &ringA = corners[a], &ringB = corners[b];
    TriangleRing ring;
    ring.decay = ringA.decay;
    ring.center = ringA.edges[faces[a]];
    ring.edges = {ringB.center, ringB.edges[faces[b]], corners[c].edges[faces[c]], ringA.center};
    const int edgeA = faces[a], edgeB = ringB.Wrap(faces[b] + 1);
    ring.edgeSharpness = {ringB.edgeSharpness[edgeB], 0, 0, ringA.edgeSharpness[edgeA]};
    ring.farSharpness = {ringB.OtherSharpness(edgeB), 0, 0, ringA.OtherSharpness(edgeA)};
    ring.isClosed = !isOpen;
    if (!isOpen) {
        ring.edges.push_back(ringA.edges[ringA.Wrap(faces[a] - 1)]);
        ring.edges.push_back(ringB.edges[ringB.Wrap(faces[b] + 2)]);
        for (int i = 0; i < 2; ++i) {
            ring.edgeSharpness.push_back(0);
            ring.farSharpness.push_back(0);
        }
    }
    return ring;
}

}  // namespace

void IrregularTriangle::Subdivide(IrregularTriangle parts[4]) const {
    TriangleRing corners[3], middles[3];
    for (int i = 0; i < 3; ++i) {
        corners[i] = rings[i].Subdivide();
    }
    for (int edge = 0; edge < 3; ++edge) {
        // Nothing beyond a boundary, or an edge that stays sharp for ever, shapes the triangle.
        const bool isOpen = rings[edge].edgeSharpness[faces[edge]] >= kInfiniteSharpness;
        middles[edge] = MiddleRing(corners, faces, edge, isOpen);
    }
    for (int i = 0; i < 3; ++i) {
        parts[i].rings[i] = corners[i];
        parts[i].faces[i] = faces[i];
        parts[i].rings[Next(i)] = middles[i];
        parts[i].faces[Next(i)] = 2;
        parts[i].rings[Previous(i)] = middles[Previous(i)];
        parts[i].faces[Previous(i)] = 0;
        // Opposite to corner i is the middle of the edge after it.
        parts[3].rings[i] = middles[Next(i)];
        parts[3].faces[i] = 1;
    }
}

bool IrregularTriangle::ToBoxSpline(Vec3f points[12]) const {
    for (const TriangleRing& ring : rings) {
        if (!ring.IsRegular()) {
            return false;
        }
    }
    for (int i = 0; i < 3; ++i) {
        Vec3f neighbors[6];
        rings[i].RegularNeighbors(faces[i], neighbors);
        points[i] = rings[i].center;
        for (int k = 0; k < 3; ++k) {
            points[3 + 3 * i + k] = neighbors[3 + k];
        }
    }
    return true;
}

Box3f IrregularTriangle::HullBox() const {
    Box3f box;
    for (const TriangleRing& ring : rings) {
        box.Extend(ring.center);
        for (const Vec3f& p : ring.edges) {
            box.Extend(p);
        }
    }
    return box;
}

void IrregularTriangle::LimitCorners(Vec3f corners[3]) const {
    for (int i = 0; i < 3; ++i) {
        corners[i] = rings[i].LimitPosition();
    }
}

void IrregularTriangle::Translate(const Vec3f& by) {
    for (TriangleRing& ring : rings) {
        ring.Translate(by);
    }
}

IrregularTriangle GatherIrregularTriangle(const PatchTable& patches, uint32_t patch,
                                          const Vec3f* values) {
    const uint32_t* corners = patches.Indices(patch);
    IrregularTriangle result;
    for (int i = 0; i < 3; ++i) {
        result.rings[i] = GatherTriangleRing(patches, corners[2 * i], values);
        result.faces[i] = static_cast<int>(corners[2 * i + 1]);
    }
    return result;
}

}  // namespace cc
