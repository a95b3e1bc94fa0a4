#include "core/subdiv/oneRing.h"

#include <algorithm>

#include <opensubdiv/sdc/crease.h>

namespace cc {
namespace {

using OpenSubdiv::Far::ConstIndexArray;
using OpenSubdiv::Far::Index;
using OpenSubdiv::Far::TopologyLevel;
using OpenSubdiv::Sdc::Crease;

using VertexRule = OneRings::VertexRule;

bool IsAmongFourQuads(const TopologyLevel& level, Index vertex) {
    const ConstIndexArray faces = level.GetVertexFaces(vertex);
    return faces.size() == 4 && std::all_of(faces.begin(), faces.end(), [&](Index face) {
               return level.GetFaceVertices(face).size() == 4;
           });
}

bool IsSharp(const TopologyLevel& level, Index edge) {
    return level.IsEdgeBoundary(edge) || Crease::IsInfinite(level.GetEdgeSharpness(edge));
}

VertexRule RuleOf(const TopologyLevel& level, Index vertex) {
    if (level.GetVertexFaces(vertex).size() > kMaxRingFaces || level.IsVertexNonManifold(vertex) ||
        Crease::IsSemiSharp(level.GetVertexSharpness(vertex))) {
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
    if (sharpEdges == 0) {
        return IsAmongFourQuads(level, vertex) ? VertexRule::Regular : VertexRule::Smooth;
    }
    return sharpEdges == 2 ? VertexRule::Crease : VertexRule::Irregular;
}

/// One step of a walk around a vertex.
struct FanStep {
    Index face;     ///< that was entered
    int corner;     ///< of the face, that the walk goes around
    Index farEdge;  ///< its other edge at the centre
    Index farEnd;   ///< that edge's other vertex
};

/// Steps across an edge at a vertex into the next face. Returns false if there is no single next
/// face or if it has another number of sides.
bool StepAcross(const TopologyLevel& level, Index vertex, Index face, Index edge, FanStep* step) {
    const ConstIndexArray faces = level.GetEdgeFaces(edge);
    if (faces.size() != 2) {
        return false;
    }
    step->face = faces[0] == face ? faces[1] : faces[0];
    const ConstIndexArray vertices = level.GetFaceVertices(step->face);
    const int sides = level.GetFaceVertices(face).size();
    if (vertices.size() != sides || step->face == face) {
        return false;
    }
    const int corner = vertices.FindIndex(vertex);
    if (corner < 0) {
        return false;
    }
    const ConstIndexArray edges = level.GetFaceEdges(step->face);
    const Index next = edges[corner], previous = edges[(corner + sides - 1) % sides];
    if (next != edge && previous != edge) {
        return false;
    }
    const bool farIsNext = previous == edge;
    step->corner = corner;
    step->farEdge = farIsNext ? next : previous;
    step->farEnd = vertices[(corner + (farIsNext ? 1 : sides - 1)) % sides];
    return true;
}

/// Writes grid points, one corner of the face at a time.
class OneRingGatherer {
  public:
    OneRingGatherer(const TopologyLevel& level, const std::vector<VertexRule>& rules, Index face,
                    OneRing* ring)
        : _level(level),
          _rules(rules),
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
        switch (_rules[_vertices[corner]]) {
            case VertexRule::Regular:
                return _GatherRegularCorner(corner) || _GatherSmoothCorner(corner);
            case VertexRule::Smooth: return _GatherSmoothCorner(corner);
            case VertexRule::Crease:
                return nextOpen != previousOpen && _GatherCreaseCorner(corner, nextOpen);
            case VertexRule::Corner: return nextOpen && previousOpen;
            case VertexRule::Irregular: break;
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

    /// The face opposite at a vertex of four, which OpenSubdiv lists in the order around it, has
    /// all points that the corner lacks. Returns false if the list is in no such order.
    bool _GatherRegularCorner(int corner) {
        const Index vertex = _vertices[corner];
        const ConstIndexArray faces = _level.GetVertexFaces(vertex);
        const int opposite = (faces.FindIndex(_face) + 2) & 3;
        const ConstIndexArray beyond = _level.GetFaceVertices(faces[opposite]);
        const int at = _level.GetVertexFaceLocalIndices(vertex)[opposite];
        const Index next = beyond[(at + 1) & 3], previous = beyond[(at + 3) & 3];
        if (_vertices.FindIndex(next) >= 0 || _vertices.FindIndex(previous) >= 0) {
            return false;
        }
        _At(GridAcross(corner, corner + 3)) = next;
        _At(GridDiagonal(corner)) = beyond[(at + 2) & 3];
        _At(GridAcross(corner, corner)) = previous;
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
            fan.push_back(_level.GetFaceVertices(step.face)[(step.corner + 2) & 3]);
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
        if (_ring->extraordinaryCorner >= 0 || valence < 3) {
            return false;
        }
        _ring->extraordinaryCorner = corner;
        _ring->extraordinaryRing = _fan;
        _At(GridAcross(corner, corner + 3)) = _fan[4];
        _At(GridAcross(corner, corner)) = _fan[2 * valence - 2];
        return true;
    }

    const TopologyLevel& _level;
    const std::vector<VertexRule>& _rules;
    const Index _face;
    const ConstIndexArray _vertices, _edges;
    OneRing* const _ring;
    std::vector<int> _fan;
};

float SharpnessOf(const TopologyLevel& level, Index edge) {
    return IsSharp(level, edge) ? Crease::SHARPNESS_INFINITE : level.GetEdgeSharpness(edge);
}

/// Walks around a vertex between barriers: sharp edges beyond which nothing shapes this side.
class CornerRingGatherer {
  public:
    CornerRingGatherer(const RefinementLevel& refinement, Index vertex, CornerRing* ring)
        : _refinement(refinement),
          _level(refinement.Topology()),
          _vertex(vertex),
          _faceCount(_level.GetVertexFaces(vertex).size()),
          _ring(*ring) {
        for (Index edge : _level.GetVertexEdges(vertex)) {
            _sharpEdgeCount += IsSharp(_level, edge);
        }
    }

    bool Gather(Index face) {
        const int corner = _level.GetFaceVertices(face).FindIndex(_vertex);
        if (corner < 0) {
            return false;
        }
        Place at{face, _level.GetFaceEdges(face)[corner]};
        if (!_GoToStart(&at)) {
            return false;
        }
        _ring = CornerRing();
        _ring.tags.isClosed = !_IsBarrier(at.edge);
        _ring.tags.vertexSharpness = _refinement.VertexSharpness(_vertex);
        _ring.vertices.push_back(_vertex);
        if (!_Collect(at)) {
            return false;
        }
        _CollectOutside();
        const auto seam = _refinement.SeamsByVertex().find(_vertex);
        if (seam != _refinement.SeamsByVertex().end()) {
            _ring.tags.seamSharpness.assign(seam->second.data(),
                                            seam->second.data() + seam->second.size());
        }
        return true;
    }

  private:
    /// A face, and that of its edges at the vertex by which a counterclockwise walk enters it.
    struct Place {
        Index face, edge;
    };

    /// A single sharp edge of two faces is a dart's, and the surface closes around it.
    bool _IsBarrier(Index edge) const {
        return IsSharp(_level, edge) &&
               (_sharpEdgeCount > 1 || _level.GetEdgeFaces(edge).size() != 2);
    }

    /// Goes clockwise to the first barrier, or once around. Returns false if there is no fan.
    bool _GoToStart(Place* at) const {
        const Index first = at->face;
        for (int i = 0; i < _faceCount && !_IsBarrier(at->edge); ++i) {
            FanStep step;
            if (!StepAcross(_level, _vertex, at->face, at->edge, &step)) {
                return false;
            }
            *at = {step.face, step.farEdge};
            if (step.face == first) {
                return true;
            }
        }
        return _IsBarrier(at->edge);
    }

    /// Goes counterclockwise and notes what is passed. Returns false if there is no fan of such
    /// faces.
    bool _Collect(Place at) {
        const Index firstFace = at.face;
        const int sides = _level.GetFaceVertices(firstFace).size();
        for (int i = 0; i < _faceCount; ++i) {
            if (!_AddFace(sides, &at)) {
                return false;
            }
            if (_IsBarrier(at.edge)) {
                _AddEdge(at.edge);
                return !_ring.tags.isClosed;
            }
            FanStep step;
            if (!StepAcross(_level, _vertex, at.face, at.edge, &step)) {
                return false;
            }
            at.face = step.face;
            if (at.face == firstFace) {
                return _ring.tags.isClosed && at.edge == _edges.front();
            }
        }
        return false;
    }

    /// Notes sharp edges that the walk did not meet, and the ends of those that a crease may have.
    void _CollectOutside() {
        const bool isFoldedBack = !_ring.tags.isClosed && _edges.front() == _edges.back();
        const size_t lacking = _ring.tags.isClosed ? 2 : isFoldedBack ? 1 : 0;
        std::vector<int> neighbors;
        std::sort(_edges.begin(), _edges.end());
        for (Index edge : _level.GetVertexEdges(_vertex)) {
            const float sharpness = SharpnessOf(_level, edge);
            if (sharpness > 0 && !std::binary_search(_edges.begin(), _edges.end(), edge)) {
                _ring.tags.outsideSharpness.push_back(sharpness);
                if (Crease::IsInfinite(sharpness)) {
                    neighbors.push_back(_OtherEnd(edge));
                }
            }
        }
        if (neighbors.size() == lacking) {
            _ring.tags.outsideNeighborCount = static_cast<int>(lacking);
            _ring.vertices.insert(_ring.vertices.end(), neighbors.begin(), neighbors.end());
        }
    }

    /// Notes a face and moves on to its edge further counterclockwise.
    bool _AddFace(int sides, Place* at) {
        const ConstIndexArray vertices = _level.GetFaceVertices(at->face);
        const int corner = vertices.FindIndex(_vertex);
        if (sides > 4 || vertices.size() != sides || corner < 0) {
            return false;
        }
        _AddEdge(at->edge);
        if (sides == 4) {
            _ring.vertices.push_back(vertices[(corner + 2) & 3]);
        }
        _ring.faces.push_back(at->face);
        const ConstIndexArray edges = _level.GetFaceEdges(at->face);
        const Index next = edges[corner], previous = edges[(corner + sides - 1) % sides];
        at->edge = at->edge == next ? previous : next;
        return true;
    }

    void _AddEdge(Index edge) {
        _edges.push_back(edge);
        _ring.vertices.push_back(_OtherEnd(edge));
        _ring.tags.edgeSharpness.push_back(SharpnessOf(_level, edge));
        _ring.tags.farSharpness.push_back(_FarSharpness(edge));
    }

    /// RingTags::farSharpness.
    float _FarSharpness(Index edge) const {
        const float sharpness = SharpnessOf(_level, edge);
        return Crease::IsSemiSharp(sharpness)
                   ? MeanOfOthers(_level, _refinement.SeamsByVertex(), edge, _OtherEnd(edge))
                   : sharpness;
    }

    Index _OtherEnd(Index edge) const {
        const ConstIndexArray ends = _level.GetEdgeVertices(edge);
        return ends[0] == _vertex ? ends[1] : ends[0];
    }

    const RefinementLevel& _refinement;
    const TopologyLevel _level;
    const Index _vertex;
    const int _faceCount;
    int _sharpEdgeCount = 0;
    CornerRing& _ring;
    std::vector<Index> _edges;
};

}  // namespace

bool GatherCornerRing(const RefinementLevel& level, int vertex, int face, CornerRing* ring) {
    return CornerRingGatherer(level, vertex, ring).Gather(face);
}

OneRings::OneRings(const TopologyLevel& level) : _level(level) {
    _rules.reserve(level.GetNumVertices());
    for (Index vertex = 0; vertex < level.GetNumVertices(); ++vertex) {
        _rules.push_back(RuleOf(level, vertex));
    }
}

void OneRings::Gather(int face, OneRing* ring) const {
    ring->extraordinaryCorner = -1;
    ring->shape = OneRingGatherer(_level, _rules, face, ring).Gather();
}

}  // namespace cc
