#pragma once

#include <memory>

#include <opensubdiv/far/patchMap.h>
#include <opensubdiv/far/patchTable.h>
#include <opensubdiv/far/ptexIndices.h>

#include "core/subdiv/patchTable.h"
#include "tests/unit/subdiv/oracleTopology.h"

namespace cc::test {

/// A mesh refined adaptively by Far into patches, which are found by where a point lies on its
/// authored face.
class FarPatches {
  public:
    using Handle = OpenSubdiv::Far::PatchTable::PatchHandle;

    /// @param levels  how deep features are followed
    FarPatches(const ControlMesh& mesh, size_t pointCount, int levels,
               const ValueTopology& values = {});

    /// False if OpenSubdiv refuses the mesh.
    bool IsValid() const { return _table != nullptr; }
    const OracleTopology& Topology() const { return _topology; }
    const OpenSubdiv::Far::PatchTable& Table() const { return *_table; }

    /// Null where OpenSubdiv has no surface.
    const Handle* Find(const FaceParameter& at) const;
    /// True if parameters are of the whole face of the refiner and not of its sub-quads.
    bool IsWhole(int face) const;

  private:
    OracleTopology _topology;
    int _regularFaceSize;
    std::unique_ptr<OpenSubdiv::Far::PtexIndices> _ptex;
    std::unique_ptr<OpenSubdiv::Far::PatchTable> _table;
    std::unique_ptr<OpenSubdiv::Far::PatchMap> _map;
};

}  // namespace cc::test
