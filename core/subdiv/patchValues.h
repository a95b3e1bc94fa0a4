#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/math/vec.h"
#include "core/subdiv/patchTable.h"

namespace cc {

/// A primvar at a point of a surface: up to four numbers, the others being zero, and how they
/// change with the parameters of FaceParameter.
struct SurfaceValue {
    float value[4] = {};
    float du[4] = {}, dv[4] = {};
};

/// A vertex primvar of one to four numbers, refined like the points of a patch table.
class PatchValues {
  public:
    /// No values.
    PatchValues() = default;

    /// @param arity       numbers a value, 1 to 4
    /// @param cageValues  those of the cage's points: arity * CagePointCount numbers
    PatchValues(const PatchTable& patches, int arity, const std::vector<float>& cageValues);

    /// The limit at parameters u, v of a patch; patches are those the values were made for.
    SurfaceValue Evaluate(const PatchTable& patches, uint32_t patch, float u, float v) const;

    /// The values that this was made of.
    std::vector<float> CageValues(const PatchTable& patches) const;
    /// Memory held, in bytes.
    size_t Bytes() const;

  private:
    int _arity = 0;
    /// Limits are evaluated three numbers at a time: the fourth is in a plane of its own.
    std::vector<Vec3f> _planes[2];
};

}  // namespace cc
