#pragma once

#include <memory>
#include <vector>

#include <opensubdiv/far/topologyRefiner.h>

#include "core/subdiv/controlMesh.h"

namespace cc::test {

/// Face-varying values as a mesh's topology knows them.
struct ValueTopology {
    int valueCount = 0;
    /// The value of each authored face-vertex; none if there are no such values.
    std::vector<int> indices;
};

/// A mesh as OpenSubdiv is given it: without collapsed edges and faces that have no inside, as
/// ValidateControlMesh promises.
class OracleTopology {
  public:
    /// @param mesh    Catmull-Clark, Loop or bilinear
    /// @param values  the refiner's channel 0
    OracleTopology(ControlMesh mesh, size_t pointCount, const ValueTopology& values = {});

    /// Null if OpenSubdiv refuses the mesh.
    OpenSubdiv::Far::TopologyRefiner* Refiner() const { return _refiner.get(); }
    /// Which face of the refiner an authored face is, or -1.
    int Face(uint32_t face) const { return _faces[face].index; }
    /// Which corner of the refiner's face a corner of the authored one is.
    int Corner(uint32_t face, uint32_t corner) const;

  private:
    struct KeptFace {
        int index = -1;
        std::vector<int> corners;
    };
    std::vector<KeptFace> _faces;
    std::unique_ptr<OpenSubdiv::Far::TopologyRefiner> _refiner;
};

}  // namespace cc::test
