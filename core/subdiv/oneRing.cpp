#include "core/subdiv/oneRing.h"

#include <opensubdiv/sdc/crease.h>

namespace cc {
namespace {

using OpenSubdiv::Far::ConstIndexArray;
using OpenSubdiv::Far::Index;
using OpenSubdiv::Far::TopologyLevel;
using OpenSubdiv::Sdc::Crease;

/// The rule that a vertex follows in the limit, as far as B-splines have it.
enum class VertexRule { Smooth, Crease, Corner, Irregular };

bool IsSharp(const TopologyLevel& level, Index edge) {
    return level.IsEdgeBoundary(edge) || Crease::IsInfinite(level.GetEdgeSharpness(edge));
}

VertexRule RuleOf(const TopologyLevel& level, Index vertex) {
    if (level.IsVertexNonManifold(vertex) || Crease::IsSemiSharp(level.GetVertexSharpness(vertex))) {
        return VertexRule::Irregular;
    }
    int sharpEdges = 0;
    for (Index edge : level.GetVertexEdges(vertex)) {
        if (IsSharp(level, edge)) {
            ++sharpEdges;
        } else if (level.GetEdgeSharpness(edge) > 0) {
            return VertexRule::Irregular;
        }
    }
    if (Crease::IsInfinite(level.GetVertexSharpness(vertex)) || sharpEdges > 2) {
        return VertexRule::Corner;
    }
    return sharpEdges == 0   ? VertexRule::Smooth
           : sharpEdges == 2 ? VertexRule::Crease
                             : VertexRule::Irregular;
}

/// One step of a walk around a vertex.
struct FanStep {
    Index face;      ///< the quad that was entered
    Index diagonal;  ///< its vertex opposite the centre
    Index farEdge;   ///< its other edge at the centre
    Index farEnd;    ///< that edge's other vertex
};

/// Steps across an edge at a vertex into the next face. Returns false if there is no single next
/// face or if it is not a quad.
bool StepAcross(const TopologyLevel& level, Index vertex, Index face, Index edge, FanStep* step) {
    const ConstIndexArray faces = level.GetEdgeFaces(edge);
    if (faces.size() != 2) {
        return false;
    }
    step->face = faces[0] == face ? faces[1] : faces[0];
    const ConstIndexArray vertices = level.GetFaceVertices(step->face);
    if (vertices.size() != 4 || step->face == face) {
        return false;
    }
    const int corner = vertices.FindIndex(vertex);
    if (corner < 0) {
        return false;
    }
    const ConstIndexArray edges = level.GetFaceEdges(step->face);
    const Index next = edges[corner], previous = edges[(corner + 3) & 3];
    if (next != edge && previous != edge) {
        return false;
    }
    const bool farIsNext = previous == edge;
    step->farEdge = farIsNext ? next : previous;
    step->farEnd = vertices[(corner + (farIsNext ? 1 : 3)) & 3];
    step->diagonal = vertices[(corner + 2) & 3];
    return true;
}

/// Writes grid points, one corner of the face at a time.
class OneRingGatherer {
  public:
    OneRingGatherer(const TopologyLevel& level, Index face, OneRing* ring)
        : _level(level),
          _face(face),
          _vertices(level.GetFaceVertices(face)),
          _edges(level.GetFaceEdges(face)),
          _ring(ring) {}

    FaceShape Gather() {
        if (_vertices.size() != 4) {
            return FaceShape::Irregular;
        }
        for (auto& row : _ring->grid) {
            for (int& point : row) {
                point = OneRing::kExtrapolated;
            }
        }
        for (int corner = 0; corner < 4; ++corner) {
            _At(GridCorner(corner)) = _vertices[corner];
            _ring->isOpen[corner] = IsSharp(_level, _edges[corner]);
        }
        for (int corner = 0; corner < 4; ++corner) {
            if (!_GatherCorner(corner)) {
                return FaceShape::Irregular;
            }
        }
        return _ring->extraordinaryCorner < 0 ? FaceShape::Regular : FaceShape::Extraordinary;
    }

  private:
    int& _At(GridPosition p) { return _ring->grid[p.row][p.column]; }

    bool _GatherCorner(int corner) {
        const bool nextOpen = _ring->isOpen[corner], previousOpen = _ring->isOpen[(corner + 3) & 3];
        switch (RuleOf(_level, _vertices[corner])) {
            case VertexRule::Smooth:
                return _GatherSmoothCorner(corner);
            case VertexRule::Crease:
                return nextOpen != previousOpen && _GatherCreaseCorner(corner, nextOpen);
            case VertexRule::Corner:
                return nextOpen && previousOpen;
            case VertexRule::Irregular:
                break;
        }
        return false;
    }

    /// A crease is regular where the face's side of it has two faces.
    bool _GatherCreaseCorner(int corner, bool nextOpen) {
        const int edge = nextOpen ? (corner + 3) & 3 : corner;
        FanStep step;
        if (!StepAcross(_level, _vertices[corner], _face, _edges[edge], &step) ||
            !IsSharp(_level, step.farEdge)) {
            return false;
        }
        _At(GridAcross(corner, edge)) = step.farEnd;
        return true;
    }

    bool _GatherSmoothCorner(int corner) {
        const Index vertex = _vertices[corner];
        const int previous = (corner + 3) & 3;
        std::vector<int>& fan = _fan;
        fan.assign({_vertices[(corner + 1) & 3], _vertices[(corner + 2) & 3], _vertices[previous]});
        Index face = _face, edge = _edges[previous];
        const int valence = _level.GetVertexFaces(vertex).size();
        for (int i = 1; i < valence; ++i) {
            FanStep step;
            if (!StepAcross(_level, vertex, face, edge, &step)) {
                return false;
            }
            fan.push_back(step.diagonal);
            fan.push_back(step.farEnd);
            face = step.face;
            edge = step.farEdge;
        }
        if (edge != _edges[corner]) {
            return false;
        }
        fan.pop_back();  // the walk ends at the edge neighbour it began with
        if (valence != 4) {
            return _SetExtraordinary(corner, valence);
        }
        _At(GridAcross(corner, previous)) = fan[4];
        _At(GridDiagonal(corner)) = fan[5];
        _At(GridAcross(corner, corner)) = fan[6];
        return true;
    }

    bool _SetExtraordinary(int corner, int valence) {
        // Larger rings cost more to trace than the quads of an isolated vertex.
        constexpr int kMaxValence = 256;
        if (_ring->extraordinaryCorner >= 0 || valence < 3 || valence > kMaxValence) {
            return false;
        }
        _ring->extraordinaryCorner = corner;
        _ring->extraordinaryRing = _fan;
        _At(GridAcross(corner, corner + 3)) = _fan[4];
        _At(GridAcross(corner, corner)) = _fan[2 * valence - 2];
        return true;
    }

    const TopologyLevel& _level;
    const Index _face;
    const ConstIndexArray _vertices, _edges;
    OneRing* const _ring;
    std::vector<int> _fan;
};

}  // namespace

void GatherOneRing(const TopologyLevel& level, int face, OneRing* ring) {
    ring->extraordinaryCorner = -1;
    ring->shape = OneRingGatherer(level, face, ring).Gather();
}

}  // namespace cc
