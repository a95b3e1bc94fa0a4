#pragma once

#include <memory>
#include <vector>

#include <opensubdiv/bfr/refinerSurfaceFactory.h>
#include <opensubdiv/bfr/surface.h>
#include <opensubdiv/far/topologyRefiner.h>

#include "core/scene/primvar.h"
#include "core/subdiv/controlMesh.h"
#include "core/subdiv/patchTable.h"
#include "core/subdiv/patchValues.h"

namespace cc::test {

/// Primvars of every interpolation as OpenSubdiv's own evaluator has them, in doubles.
class PrimvarOracle {
  public:
    /// Takes collapsed edges and faces without an inside out, as ValidateControlMesh promises.
    /// @param mesh  Catmull-Clark, Loop or bilinear, validated
    PrimvarOracle(const ControlMesh& mesh, size_t pointCount, const Primvar& primvar);

    /// Returns false where OpenSubdiv has no surface.
    bool Evaluate(const FaceParameter& at, SurfaceValue* value);

    /// The refiner that it was made with, whose channel 0 has the face-varying values; ends the
    /// life of Evaluate.
    std::unique_ptr<OpenSubdiv::Far::TopologyRefiner> TakeRefiner();

  private:
    using Factory = OpenSubdiv::Bfr::RefinerSurfaceFactory<>;

    void _MakeRefiner(const ControlMesh& mesh, size_t pointCount);
    bool _SelectFace(uint32_t face);
    bool _InitSurface(int face);

    /// Of an authored face: which face of the refiner it is, or -1, and the corners it kept.
    struct KeptFace {
        int index = -1;
        std::vector<int> corners;
    };
    const Interpolation _interpolation;
    const int _arity;
    std::vector<KeptFace> _faces;
    std::vector<double> _values;
    std::vector<int> _valueIndices;
    std::unique_ptr<OpenSubdiv::Far::TopologyRefiner> _refiner;
    std::unique_ptr<Factory> _factory;
    int _selected = -1;
    OpenSubdiv::Bfr::Surface<double> _surface;
    std::vector<double> _patchPoints;
};

}  // namespace cc::test
