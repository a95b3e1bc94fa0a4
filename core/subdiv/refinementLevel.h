#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <opensubdiv/far/topologyRefiner.h>

#include "core/subdiv/controlMesh.h"
#include "core/subdiv/patchTable.h"
#include "core/subdiv/seamRefinement.h"

namespace cc {

/// Where a quad of some level lies on its authored face (see Patch).
struct FaceOrigin {
    uint32_t face;
    uint32_t corner;
    uint16_t cellU, cellV;
    uint8_t depth;
    bool isSubQuad;
    /// False for faces that are here only because they shape their neighbours.
    bool isVisible;
};

/// A piece of the mesh after some Catmull-Clark steps. Level 0 is the whole cage; each further
/// level holds the faces that still need refinement and their neighbours, one step finer.
class RefinementLevel {
  public:
    /// The cage, without collapsed edges and faces that have no inside (KeptCorners), under its own
    /// scheme if that is Loop, else Catmull-Clark. On failure IsValid is false and error says why.
    RefinementLevel(const ControlMesh& mesh, size_t pointCount, std::string* error);

    /// One Catmull-Clark step: the children of the faces listed, with all that shapes them.
    RefinementLevel(RefinementLevel* parent, const std::vector<int>& faces);

    bool IsValid() const { return _refiner != nullptr; }
    OpenSubdiv::Far::TopologyLevel Topology() const { return _refiner->GetLevel(0); }
    int FaceCount() const { return static_cast<int>(_origins.size()); }
    const FaceOrigin& Origin(int face) const { return _origins[face]; }
    /// The corner that a face shares with its parent, which it is next to two edges of; 0 in the
    /// cage.
    int OuterCorner(int face) const { return _parent ? _outerEdges[face].corner : 0; }
    /// The patch points at the ends of an edge of a face, or of the edge that it is part of in the
    /// first level that has that.
    /// @param edge  counted from the face's first vertex
    EdgePoints EdgeEnds(int face, int edge, PatchTable* table);
    /// The sharpness of a vertex by OpenSubdiv's refinement. Topology makes more vertices sharp
    /// than that, since it takes the level for a cage: those on an edge whose two faces disagree
    /// about its direction, which is no manifold but is refined to a crease.
    float VertexSharpness(int vertex) const { return _vertexSharpness[vertex]; }
    const Seams& SeamsByVertex() const { return _seams; }

    /// The patch point of a vertex, added to the table when it is first asked for.
    uint32_t PatchPoint(int vertex, PatchTable* table);
    /// The patch point at the limit position of a vertex.
    uint32_t LimitPoint(int vertex, PatchTable* table);

  private:
    /// Local vertices and weights; the value type that OpenSubdiv's masks act on.
    struct MaskRow {
        std::vector<int> vertices;
        std::vector<float> weights;
        void Clear();
        void AddWithWeight(const MaskRow& row, float weight);
        /// Adds up the weights of vertices that were added more than once, in ascending order.
        void Merge();
    };

    /// Where a face lies in its parent.
    struct OuterEdges {
        int parentFace, parentCorner;
        int corner;  ///< of the face, at the parent's
    };

    void _NoteCage(const ControlMesh& mesh, size_t pointCount);
    Stencil _ToStencil(const MaskRow& row, RefinementLevel* level, PatchTable* table);

    std::unique_ptr<OpenSubdiv::Far::TopologyRefiner> _refiner;
    RefinementLevel* _parent = nullptr;
    std::vector<FaceOrigin> _origins;
    /// Above the cage.
    std::vector<OuterEdges> _outerEdges;
    /// Of the cage's faces that lost corners: which they kept.
    std::map<int, std::vector<int>> _keptCorners;
    std::vector<float> _vertexSharpness;
    Seams _seams;
    /// Above the cage: how a vertex comes from the parent's.
    std::vector<MaskRow> _rows;
    std::vector<uint32_t> _patchPoints;
    std::vector<MaskRow> _limitRows;
    std::vector<uint32_t> _limitPoints;
};

}  // namespace cc
