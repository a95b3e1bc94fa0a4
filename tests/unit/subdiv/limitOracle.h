#pragma once

#include <memory>
#include <vector>

#include <opensubdiv/bfr/refinerSurfaceFactory.h>
#include <opensubdiv/far/topologyRefiner.h>

#include "core/subdiv/controlMesh.h"
#include "core/subdiv/patchTable.h"

namespace cc::test {

/// The limit surface as OpenSubdiv's own evaluator has it: what ours is compared with. It shares
/// nothing with our patches but the meaning of the mesh.
class LimitOracle {
  public:
    LimitOracle(ControlMesh mesh, std::vector<Vec3f> points);

    struct Sample {
        bool exists = false;
        Vec3f position, normal;
    };
    Sample Evaluate(const FaceParameter& at) const;

  private:
    std::vector<Vec3f> _points;
    std::unique_ptr<OpenSubdiv::Far::TopologyRefiner> _refiner;
    using Factory = OpenSubdiv::Bfr::RefinerSurfaceFactory<>;
    std::unique_ptr<Factory> _factory;
};

}  // namespace cc::test
