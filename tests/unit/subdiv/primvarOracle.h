#pragma once

#include <memory>
#include <vector>

#include <opensubdiv/bfr/refinerSurfaceFactory.h>
#include <opensubdiv/bfr/surface.h>

#include "core/scene/primvar.h"
#include "core/subdiv/controlMesh.h"
#include "core/subdiv/patchTable.h"
#include "core/subdiv/patchValues.h"
#include "tests/unit/subdiv/oracleTopology.h"

namespace cc::test {

/// Primvars of every interpolation as OpenSubdiv's own evaluator has them, in doubles.
class PrimvarOracle {
  public:
    /// @param mesh  Catmull-Clark, Loop or bilinear, validated
    PrimvarOracle(const ControlMesh& mesh, size_t pointCount, const Primvar& primvar);

    /// Returns false where OpenSubdiv has no surface.
    bool Evaluate(const FaceParameter& at, SurfaceValue* value);

  private:
    using Factory = OpenSubdiv::Bfr::RefinerSurfaceFactory<>;

    bool _SelectFace(uint32_t face);
    bool _InitSurface(int face);

    const Interpolation _interpolation;
    const int _arity;
    OracleTopology _topology;
    const std::vector<double> _values;
    std::unique_ptr<Factory> _factory;
    int _selected = -1;
    OpenSubdiv::Bfr::Surface<double> _surface;
    std::vector<double> _patchPoints;
};

}  // namespace cc::test
