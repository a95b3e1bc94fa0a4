#include "core/subdiv/seamRefinement.h"

#include <opensubdiv/sdc/crease.h>

namespace cc {
namespace {

using OpenSubdiv::Far::ConstIndexArray;
using OpenSubdiv::Far::Index;
using OpenSubdiv::Far::TopologyLevel;
using OpenSubdiv::Sdc::Crease;

Index OtherEnd(const TopologyLevel& level, Index edge, Index vertex) {
    const ConstIndexArray ends = level.GetEdgeVertices(edge);
    return ends[0] == vertex ? ends[1] : ends[0];
}

/// Refines what lies around one vertex after the other.
class SeamRefiner {
  public:
    SeamRefiner(const OpenSubdiv::Far::TopologyRefiner& refiner, const Seams& seams)
        : _coarse(refiner.GetLevel(0)),
          _isSmoothTriangles(refiner.GetSchemeOptions().GetTriangleSubdivision() ==
                             OpenSubdiv::Sdc::Options::TRI_SUB_SMOOTH),
          _seams(seams) {}

    SeamRefinement Refine() {
        for (const auto& [vertex, sharpnesses] : _seams) {
            _RefineVertex(vertex, sharpnesses);
        }
        return std::move(_result);
    }

  private:
    void _RefineVertex(Index vertex, const std::vector<float>& sharpnesses) {
        const RingTags tags = _TagsAt(vertex, sharpnesses);
        const RingTags decayed = tags.Decayed();
        const ConstIndexArray edges = _coarse.GetVertexEdges(vertex);
        for (int i = 0; i < edges.size(); ++i) {
            if (Crease::IsSemiSharp(tags.edgeSharpness[i])) {
                _AddEdgeRow(edges[i], tags.EdgeWeight(i, decayed));
                _result.edgeSharpness[_ChildAt(edges[i], vertex)] = decayed.edgeSharpness[i];
            }
        }
        SeamRow row{_coarse.GetVertexChildVertex(vertex), {}, {}};
        const float weight =
            tags.VertexRule() == decayed.VertexRule() ? 1 : tags.FractionalWeight(decayed);
        _AddVertexRule(tags, vertex, weight, &row);
        _AddVertexRule(decayed, vertex, 1 - weight, &row);
        _result.rows.push_back(row);
        for (float sharpness : decayed.seamSharpness) {
            if (sharpness > 0) {
                _result.seams[row.vertex].push_back(sharpness);
            }
        }
    }

    RingTags _TagsAt(Index vertex, const std::vector<float>& sharpnesses) const {
        RingTags tags;
        // Values split here, so the faces have come apart.
        tags.isClosed = false;
        tags.decay = SharpnessDecay::Chaikin;
        tags.vertexSharpness = _coarse.GetVertexSharpness(vertex);
        for (Index edge : _coarse.GetVertexEdges(vertex)) {
            tags.edgeSharpness.push_back(_coarse.GetEdgeSharpness(edge));
            tags.farSharpness.push_back(
                MeanOfOthers(_coarse, _seams, edge, OtherEnd(_coarse, edge, vertex)));
        }
        for (float sharpness : sharpnesses) {
            tags.seamSharpness.push_back(sharpness);
        }
        return tags;
    }

    /// @param weight  of the rule of a sharp edge
    void _AddEdgeRow(Index edge, float weight) {
        SeamRow row{_coarse.GetEdgeChildVertex(edge), {}, {}};
        float faceWeight = 0;
        const ConstIndexArray faces = _coarse.GetEdgeFaces(edge);
        for (Index face : faces) {
            // Triangles that are smoothed weigh more (Stam and Loop 2003, as OpenSubdiv has it).
            const bool isTriangle = _isSmoothTriangles && _coarse.GetFaceVertices(face).size() == 3;
            faceWeight += (isTriangle ? 0.47f : 0.25f) / static_cast<float>(faces.size());
        }
        for (Index face : faces) {
            row.facePoints.emplace_back(_coarse.GetFaceChildVertex(face),
                                        (1 - weight) * faceWeight);
        }
        for (Index end : _coarse.GetEdgeVertices(edge)) {
            row.coarse.emplace_back(end, weight * 0.5f + (1 - weight) * (0.5f - faceWeight));
        }
        _result.rows.push_back(row);
    }

    void _AddVertexRule(const RingTags& tags, Index vertex, float weight, SeamRow* row) const {
        if (tags.VertexRule() == RingTags::Rule::Corner) {
            row->coarse.emplace_back(vertex, weight);
            return;
        }
        int ends[2];
        tags.CreaseEdges(ends);
        row->coarse.emplace_back(vertex, 0.75f * weight);
        for (int end : ends) {
            const Index edge = _coarse.GetVertexEdges(vertex)[end];
            row->coarse.emplace_back(OtherEnd(_coarse, edge, vertex), 0.125f * weight);
        }
    }

    /// The half of an edge at one of its ends.
    Index _ChildAt(Index edge, Index vertex) const {
        return _coarse.GetEdgeChildEdges(edge)[_coarse.GetEdgeVertices(edge)[0] == vertex ? 0 : 1];
    }

    const TopologyLevel _coarse;
    const bool _isSmoothTriangles;
    const Seams& _seams;
    SeamRefinement _result;
};

}  // namespace

float MeanOfOthers(const TopologyLevel& level, const Seams& seams, int edge, int end) {
    float sum = 0;
    int count = 0;
    const auto add = [&](float sharpness) {
        if (Crease::IsSemiSharp(sharpness)) {
            sum += sharpness;
            ++count;
        }
    };
    for (Index other : level.GetVertexEdges(end)) {
        add(other == edge ? 0 : level.GetEdgeSharpness(other));
    }
    const auto beyond = seams.find(end);
    if (beyond != seams.end()) {
        for (float sharpness : beyond->second) {
            add(sharpness);
        }
    }
    return count > 0 ? sum / static_cast<float>(count) : level.GetEdgeSharpness(edge);
}

SeamRefinement RefineSeams(const OpenSubdiv::Far::TopologyRefiner& refiner, const Seams& seams) {
    return SeamRefiner(refiner, seams).Refine();
}

}  // namespace cc
