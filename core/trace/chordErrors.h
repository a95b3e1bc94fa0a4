#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/subdiv/limitGridPlan.h"
#include "core/subdiv/patchTable.h"

namespace cc {

/// How far the quads of level 0 may be from the limit surface, in object space. Each level quarters
/// that, as second derivatives say: between two triangles with sides h along u and v and a surface
/// lies at most (|S_uu| + 2 |S_uv| + |S_vv|) h^2 / 8. The second differences of B-spline control
/// points bound the derivatives of regular patches; others are measured.
///
/// It is kept a byte a control point: the largest of the patches that have the point at a corner,
/// or at the end of an edge that they have part of.
class ChordErrors {
  public:
    ChordErrors() = default;
    /// @param points  those of the table
    /// @param unit    size of the surface, which errors are rounded up relative to
    ChordErrors(const PatchTable& patches, const LimitGridPlans& plans,
                const std::vector<Vec3f>& points, float unit);

    /// Takes the larger ones of these and others of the same surface, made with the same unit.
    void Raise(const ChordErrors& others);

    float At(uint32_t point) const { return _unit * _Decode(_bytes[point]); }
    float Largest() const { return _unit * _Decode(_largest); }
    size_t Bytes() const { return _bytes.capacity(); }

  private:
    static float _Decode(uint8_t byte);

    std::vector<uint8_t> _bytes;
    float _unit = 0;
    uint8_t _largest = 0;
};

}  // namespace cc
