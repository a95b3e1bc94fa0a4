#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/math/vec.h"
#include "core/subdiv/controlMesh.h"
#include "core/subdiv/patchTable.h"

namespace cc {

/// A face-varying primvar that is smooth over faces: a limit surface of its own, found by where a
/// point lies on its authored face. Not for primvars that IsFaceVaryingBilinear.
class FaceVaryingChannel {
  public:
    /// A channel without patches.
    FaceVaryingChannel() = default;

    /// @param mesh          must have passed ValidateControlMesh
    /// @param values        finite values
    /// @param valueIndices  the value of each face-vertex; equal indices at a vertex are one value
    /// @param warning       set to what is approximate or wrong; empty if all is well
    FaceVaryingChannel(const ControlMesh& mesh, size_t pointCount, const std::vector<Vec3f>& values,
                       const std::vector<int>& valueIndices, std::string* warning);

    bool IsEmpty() const { return _patches.Count() == 0; }
    /// The value at a point of a visible face; zero if the face has no patches.
    Vec3f Evaluate(const FaceParameter& at) const;
    /// Memory held, in bytes.
    size_t Bytes() const;

  private:
    uint32_t _AuthoredFace(size_t i) const;
    uint32_t _PatchAt(size_t i) const;

    PatchTable _patches;
    std::vector<Vec3f> _points;
    /// Patches in the order of their authored faces; empty if they are so already.
    std::vector<uint32_t> _byFace;
};

}  // namespace cc
