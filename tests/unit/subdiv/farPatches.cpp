#include "tests/unit/subdiv/farPatches.h"

#include <opensubdiv/far/patchTableFactory.h>

namespace cc::test {

namespace Far = OpenSubdiv::Far;

FarPatches::FarPatches(const ControlMesh& mesh, size_t pointCount, int levels,
                       const ValueTopology& values)
    : _topology(mesh, pointCount, values), _regularFaceSize(mesh.scheme == Scheme::Loop ? 3 : 4) {
    Far::TopologyRefiner* const refiner = _topology.Refiner();
    if (refiner == nullptr) {
        return;
    }
    Far::PatchTableFactory::Options options(levels);
    options.SetPatchPrecision<double>();
    options.SetFVarPatchPrecision<double>();
    options.useInfSharpPatch = true;
    options.generateLegacySharpCornerPatches = false;
    options.generateFVarTables = !values.indices.empty();
    options.generateFVarLegacyLinearPatches = false;
    refiner->RefineAdaptive(options.GetRefineAdaptiveOptions());
    _ptex = std::make_unique<Far::PtexIndices>(*refiner);
    _table.reset(Far::PatchTableFactory::Create(*refiner, options));
    _map = std::make_unique<Far::PatchMap>(*_table);
}

const FarPatches::Handle* FarPatches::Find(const FaceParameter& at) const {
    const int face = _topology.Face(at.face);
    if (!_map || face < 0) {
        return nullptr;
    }
    const int corner = IsWhole(face) ? 0 : _topology.Corner(at.face, at.corner);
    return _map->FindPatch(_ptex->GetFaceId(face) + corner, at.u, at.v);
}

bool FarPatches::IsWhole(int face) const {
    return _topology.Refiner()->GetLevel(0).GetFaceVertices(face).size() == _regularFaceSize;
}

}  // namespace cc::test
