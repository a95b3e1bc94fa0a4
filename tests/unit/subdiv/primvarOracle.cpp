#include "tests/unit/subdiv/primvarOracle.h"

#include <algorithm>
#include <numeric>

#include <opensubdiv/far/topologyDescriptor.h>

namespace cc::test {

namespace Bfr = OpenSubdiv::Bfr;
namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;

namespace {

Sdc::Options::FVarLinearInterpolation ToSdc(FaceVaryingRule rule) {
    switch (rule) {
        case FaceVaryingRule::None: return Sdc::Options::FVAR_LINEAR_NONE;
        case FaceVaryingRule::CornersOnly: return Sdc::Options::FVAR_LINEAR_CORNERS_ONLY;
        case FaceVaryingRule::CornersPlus1: return Sdc::Options::FVAR_LINEAR_CORNERS_PLUS1;
        case FaceVaryingRule::CornersPlus2: return Sdc::Options::FVAR_LINEAR_CORNERS_PLUS2;
        case FaceVaryingRule::Boundaries: return Sdc::Options::FVAR_LINEAR_BOUNDARIES;
        case FaceVaryingRule::All: break;
    }
    return Sdc::Options::FVAR_LINEAR_ALL;
}

Sdc::Options OptionsOf(const ControlMesh& mesh) {
    Sdc::Options options;
    options.SetVtxBoundaryInterpolation(
        mesh.boundaryRule == BoundaryRule::None       ? Sdc::Options::VTX_BOUNDARY_NONE
        : mesh.boundaryRule == BoundaryRule::EdgeOnly ? Sdc::Options::VTX_BOUNDARY_EDGE_ONLY
                                                      : Sdc::Options::VTX_BOUNDARY_EDGE_AND_CORNER);
    options.SetFVarLinearInterpolation(ToSdc(mesh.faceVaryingRule));
    options.SetCreasingMethod(mesh.creaseRule == CreaseRule::Chaikin
                                  ? Sdc::Options::CREASE_CHAIKIN
                                  : Sdc::Options::CREASE_UNIFORM);
    options.SetTriangleSubdivision(mesh.triangleRule == TriangleRule::Smooth
                                       ? Sdc::Options::TRI_SUB_SMOOTH
                                       : Sdc::Options::TRI_SUB_CATMARK);
    return options;
}

}  // namespace

PrimvarOracle::PrimvarOracle(const ControlMesh& mesh, size_t pointCount, const Primvar& primvar)
    : _interpolation(primvar.interpolation), _arity(primvar.arity) {
    const bool isFaceVarying = _interpolation == Interpolation::FaceVarying;
    if (isFaceVarying && !primvar.indices.empty()) {
        _values.assign(primvar.values.begin(), primvar.values.end());
        _valueIndices = primvar.indices;
    } else {
        for (size_t i = 0; i < primvar.ElementCount(); ++i) {
            _values.insert(_values.end(), primvar.Element(i), primvar.Element(i) + _arity);
        }
        _valueIndices.resize(isFaceVarying ? primvar.ElementCount() : 0);
        std::iota(_valueIndices.begin(), _valueIndices.end(), 0);
    }
    _MakeRefiner(mesh, pointCount);
    if (_refiner) {
        // Features are followed as deep as Bfr bears.
        Factory::Options precise;
        precise.SetApproxLevelSmooth(10).SetApproxLevelSharp(10);
        _factory = std::make_unique<Factory>(*_refiner, precise);
    }
}

void PrimvarOracle::_MakeRefiner(const ControlMesh& mesh, size_t pointCount) {
    std::vector<int> counts, indices, valueIndices;
    const int* face = mesh.faceVertexIndices.data();
    int first = 0;
    for (int count : mesh.faceVertexCounts) {
        KeptFace kept{-1, KeptCorners(face + first, count)};
        if (!kept.corners.empty()) {
            kept.index = static_cast<int>(counts.size());
            counts.push_back(static_cast<int>(kept.corners.size()));
        }
        for (int corner : kept.corners) {
            indices.push_back(face[first + corner]);
            if (!_valueIndices.empty()) {
                valueIndices.push_back(_valueIndices[first + corner]);
            }
        }
        _faces.push_back(kept);
        first += count;
    }
    Far::TopologyDescriptor d;
    d.numVertices = static_cast<int>(pointCount);
    d.numFaces = static_cast<int>(counts.size());
    d.numVertsPerFace = counts.data();
    d.vertIndicesPerFace = indices.data();
    d.numCreases = static_cast<int>(mesh.creaseSharpnesses.size());
    d.creaseVertexIndexPairs = mesh.creaseIndices.data();
    d.creaseWeights = mesh.creaseSharpnesses.data();
    d.numCorners = static_cast<int>(mesh.cornerIndices.size());
    d.cornerVertexIndices = mesh.cornerIndices.data();
    d.cornerWeights = mesh.cornerSharpnesses.data();
    Far::TopologyDescriptor::FVarChannel channel;
    channel.numValues = static_cast<int>(_values.size()) / _arity;
    channel.valueIndices = valueIndices.data();
    d.numFVarChannels = valueIndices.empty() ? 0 : 1;
    d.fvarChannels = &channel;
    const Sdc::SchemeType scheme = mesh.scheme == Scheme::Bilinear ? Sdc::SCHEME_BILINEAR
                                   : mesh.scheme == Scheme::Loop   ? Sdc::SCHEME_LOOP
                                                                   : Sdc::SCHEME_CATMARK;
    using RefinerFactory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
    _refiner.reset(RefinerFactory::Create(d, RefinerFactory::Options(scheme, OptionsOf(mesh))));
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
    const int index = _faces[face].index;
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

std::unique_ptr<Far::TopologyRefiner> PrimvarOracle::TakeRefiner() {
    _factory.reset();
    return std::move(_refiner);
}

bool PrimvarOracle::Evaluate(const FaceParameter& at, SurfaceValue* value) {
    if (!_SelectFace(at.face)) {
        return false;
    }
    double uv[2] = {at.u, at.v};
    double scale = 1;
    const Bfr::Parameterization parameterization = _surface.GetParameterization();
    if (parameterization.HasSubFaces()) {
        const std::vector<int>& kept = _faces[at.face].corners;
        const auto corner = std::find(kept.begin(), kept.end(), static_cast<int>(at.corner));
        parameterization.ConvertNormalizedSubFaceToCoord(static_cast<int>(corner - kept.begin()),
                                                         uv, uv);
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
