#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/subdiv/controlMesh.h"
#include "core/subdiv/patchTable.h"
#include "core/subdiv/patchValues.h"

namespace cc {

/// A face-varying primvar that is smooth over faces: a limit surface of its own, found by where a
/// point lies on its authored face. Not for primvars that IsFaceVaryingBilinear.
class FaceVaryingChannel {
  public:
    /// A channel without patches.
    FaceVaryingChannel() = default;

    /// @param mesh          must have passed ValidateControlMesh
    /// @param arity         numbers a value, 1 to 4
    /// @param values        finite numbers, one value after the other
    /// @param valueIndices  the value of each face-vertex; equal indices at a vertex are one value
    /// @param error         set to the reason if the topology cannot be used; empty otherwise
    FaceVaryingChannel(const ControlMesh& mesh, size_t pointCount, int arity,
                       const std::vector<float>& values, const std::vector<int>& valueIndices,
                       std::string* error);

    bool IsEmpty() const { return _patches.Count() == 0; }
    /// The value at a point of a visible face; zero if the face has no patches.
    SurfaceValue Evaluate(const FaceParameter& at) const;
    /// Memory held, in bytes.
    size_t Bytes() const;

  private:
    uint32_t _AuthoredFace(size_t i) const;
    uint32_t _PatchAt(size_t i) const;

    PatchTable _patches;
    PatchValues _values;
    /// Patches in the order of their authored faces; empty if they are so already.
    std::vector<uint32_t> _byFace;
};

}  // namespace cc
