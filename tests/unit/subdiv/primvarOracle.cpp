#include "tests/unit/subdiv/primvarOracle.h"

#include <numeric>

#include "tests/unit/subdiv/limitOracle.h"

namespace cc::test {

namespace Bfr = OpenSubdiv::Bfr;

namespace {

/// Face-varying values as they are indexed, else each element's.
std::vector<double> ValuesOf(const Primvar& primvar) {
    if (primvar.interpolation == Interpolation::FaceVarying) {
        return {primvar.values.begin(), primvar.values.end()};
    }
    std::vector<double> values;
    for (size_t i = 0; i < primvar.ElementCount(); ++i) {
        values.insert(values.end(), primvar.Element(i), primvar.Element(i) + primvar.arity);
    }
    return values;
}

ValueTopology TopologyOf(const Primvar& primvar) {
    ValueTopology topology;
    if (primvar.interpolation == Interpolation::FaceVarying) {
        topology = {static_cast<int>(primvar.ValueCount()), primvar.indices};
        if (primvar.indices.empty()) {
            topology.indices.resize(primvar.ValueCount());
            std::iota(topology.indices.begin(), topology.indices.end(), 0);
        }
    }
    return topology;
}

}  // namespace

PrimvarOracle::PrimvarOracle(const ControlMesh& mesh, size_t pointCount, const Primvar& primvar)
    : _interpolation(primvar.interpolation),
      _arity(primvar.arity),
      _topology(mesh, pointCount, TopologyOf(primvar)),
      _values(ValuesOf(primvar)) {
    if (_topology.Refiner() != nullptr) {
        // Features are followed as deep as Bfr bears.
        Factory::Options precise;
        precise.SetApproxLevelSmooth(kOracleLevels).SetApproxLevelSharp(kOracleLevels);
        _factory = std::make_unique<Factory>(*_topology.Refiner(), precise);
    }
}

bool PrimvarOracle::_InitSurface(int face) {
    switch (_interpolation) {
        case Interpolation::Varying: return _factory->InitVaryingSurface(face, &_surface);
        case Interpolation::FaceVarying:
            return _factory->InitFaceVaryingSurface(face, &_surface, 0);
        default: return _factory->InitVertexSurface(face, &_surface);
    }
}

bool PrimvarOracle::_SelectFace(uint32_t face) {
    const int index = _topology.Face(face);
    if (index < 0 || !_factory) {
        return false;
    }
    if (_selected != index) {
        _selected = _InitSurface(index) ? index : -1;
        if (_selected >= 0) {
            _patchPoints.resize(_arity * static_cast<size_t>(_surface.GetNumPatchPoints()));
            _surface.PreparePatchPoints(_values.data(), _arity, _patchPoints.data(), _arity);
        }
    }
    return _selected == index;
}

bool PrimvarOracle::Evaluate(const FaceParameter& at, SurfaceValue* value) {
    if (!_SelectFace(at.face)) {
        return false;
    }
    double uv[2] = {at.u, at.v};
    double scale = 1;
    const Bfr::Parameterization parameterization = _surface.GetParameterization();
    if (parameterization.HasSubFaces()) {
        parameterization.ConvertNormalizedSubFaceToCoord(_topology.Corner(at.face, at.corner), uv,
                                                         uv);
        scale = 0.5;  // a sub-face covers half a unit each way
    }
    double p[4], du[4], dv[4];
    _surface.Evaluate(uv, _patchPoints.data(), _arity, p, du, dv);
    *value = {};
    for (int i = 0; i < _arity; ++i) {
        value->value[i] = static_cast<float>(p[i]);
        value->du[i] = static_cast<float>(scale * du[i]);
        value->dv[i] = static_cast<float>(scale * dv[i]);
    }
    return true;
}

}  // namespace cc::test
