#include "tests/unit/subdiv/faceVaryingOracle.h"

#include <opensubdiv/far/primvarRefiner.h>

#include "tests/unit/subdiv/limitOracle.h"

namespace cc::test {

namespace Far = OpenSubdiv::Far;

FaceVaryingOracle::FaceVaryingOracle(const ControlMesh& mesh, size_t pointCount,
                                     const Primvar& primvar)
    : _patches(mesh, pointCount, kOracleLevels,
               {static_cast<int>(primvar.ValueCount()), primvar.indices}) {
    if (!_patches.IsValid()) {
        return;
    }
    const Far::TopologyRefiner& refiner = *_patches.Topology().Refiner();
    const int refinedCount = refiner.GetNumFVarValuesTotal(0);
    _values.resize(refinedCount + _patches.Table().GetNumLocalPointsFaceVarying(0));
    for (size_t i = 0; i < primvar.ValueCount(); ++i) {
        for (int k = 0; k < primvar.arity; ++k) {
            _values[i].d[k] = primvar.values[i * primvar.arity + k];
        }
    }
    const Far::PrimvarRefinerReal<double> primvars(refiner);
    MaskValue* coarse = _values.data();
    for (int level = 1; level <= refiner.GetMaxLevel(); ++level) {
        MaskValue* fine = coarse + refiner.GetLevel(level - 1).GetNumFVarValues(0);
        primvars.InterpolateFaceVarying(level, coarse, fine, 0);
        coarse = fine;
    }
    if (_patches.Table().GetNumLocalPointsFaceVarying(0) > 0) {
        _patches.Table().GetLocalPointFaceVaryingStencilTable<double>(0)->UpdateValues(
            _values.data(), _values.data() + refinedCount);
    }
}

bool FaceVaryingOracle::Evaluate(const FaceParameter& at, SurfaceValue* value) const {
    const FarPatches::Handle* const patch = _patches.Find(at);
    if (patch == nullptr) {
        return false;
    }
    double weights[20], weightsU[20], weightsV[20];
    _patches.Table().EvaluateBasisFaceVarying(
        *patch, static_cast<double>(at.u), static_cast<double>(at.v), weights, weightsU, weightsV);
    MaskValue sum, du, dv;
    const Far::ConstIndexArray points = _patches.Table().GetPatchFVarValues(*patch, 0);
    for (int i = 0; i < points.size(); ++i) {
        sum.AddWithWeight(_values[points[i]], weights[i]);
        du.AddWithWeight(_values[points[i]], weightsU[i]);
        dv.AddWithWeight(_values[points[i]], weightsV[i]);
    }
    for (size_t i = 0; i < sum.d.size(); ++i) {
        value->value[i] = static_cast<float>(sum.d[i]);
        value->du[i] = static_cast<float>(du.d[i]);
        value->dv[i] = static_cast<float>(dv.d[i]);
    }
    return true;
}

}  // namespace cc::test
