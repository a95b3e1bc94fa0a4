#pragma once

#include <memory>
#include <vector>

#include <opensubdiv/bfr/refinerSurfaceFactory.h>
#include <opensubdiv/bfr/surface.h>
#include <opensubdiv/far/topologyRefiner.h>

#include "core/subdiv/controlMesh.h"
#include "core/subdiv/patchTable.h"

namespace cc::test {

/// The limit surface as OpenSubdiv's own evaluator has it: what ours is compared with. It shares
/// nothing with our patches but the meaning of the mesh, and computes in doubles.
class LimitOracle {
  public:
    /// How many refinement steps features are followed before an approximation stands in.
    enum class Precision { Fine, Coarse };

    /// Takes collapsed edges and faces without an inside out, as ValidateControlMesh promises.
    LimitOracle(ControlMesh mesh, const std::vector<Vec3f>& points,
                Precision precision = Precision::Fine);

    struct Sample {
        bool exists = false;
        Vec3f position;
        /// Unit normal, zero where the derivatives give none.
        Vec3f normal;
    };
    Sample Evaluate(const FaceParameter& at);

    /// True if the surface covers a face.
    bool HasFace(uint32_t face);

    /// Refines the whole mesh with Far, which knows no shortcut, and returns the limit positions of
    /// the last level's vertices: they lie at whole multiples of 2^-levels. Ends the life of
    /// Evaluate.
    std::vector<Vec3f> RefinedLimits(int levels);

  private:
    bool _SelectFace(uint32_t face);

    /// Of an authored face: which face of the refiner it is, or -1, and the corners it kept.
    struct KeptFace {
        int index = -1;
        std::vector<int> corners;
    };
    std::vector<KeptFace> _faces;
    std::vector<double> _points;
    std::unique_ptr<OpenSubdiv::Far::TopologyRefiner> _refiner;
    using Factory = OpenSubdiv::Bfr::RefinerSurfaceFactory<>;
    std::unique_ptr<Factory> _factory;
    /// The face asked for last: building its surface costs most.
    int _selected = -1;
    OpenSubdiv::Bfr::Surface<double> _surface;
    std::vector<double> _patchPoints;
};

}  // namespace cc::test
