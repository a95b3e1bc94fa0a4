#pragma once

#include <array>
#include <vector>

#include "core/scene/primvar.h"
#include "core/subdiv/patchValues.h"
#include "tests/unit/subdiv/farPatches.h"

namespace cc::test {

/// A face-varying primvar by Far's refinement of the whole mesh, in doubles. Where Bfr contradicts
/// it, this is what OpenSubdiv says: the values that subdivision converges to.
class FaceVaryingOracle {
  public:
    /// @param mesh     validated
    /// @param primvar  indexed
    FaceVaryingOracle(const ControlMesh& mesh, size_t pointCount, const Primvar& primvar);

    /// Returns false where OpenSubdiv has no surface.
    bool Evaluate(const FaceParameter& at, SurfaceValue* value) const;

  private:
    /// What Far's masks act on.
    struct MaskValue {
        std::array<double, 4> d{};
        void Clear() { d.fill(0); }
        void AddWithWeight(const MaskValue& other, double weight) {
            for (size_t i = 0; i < d.size(); ++i) {
                d[i] += weight * other.d[i];
            }
        }
    };

    FarPatches _patches;
    /// Of all levels, then of the points that patches add.
    std::vector<MaskValue> _values;
};

}  // namespace cc::test
