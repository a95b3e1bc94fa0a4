#pragma once

#include <algorithm>
#include <limits>

#include "core/math/vec.h"

namespace cc {

/// Axis-aligned box. A new box is empty: lower above upper.
struct Box3f {
    Vec3f lower{kFar, kFar, kFar};
    Vec3f upper{-kFar, -kFar, -kFar};

    bool IsEmpty() const { return lower.x > upper.x || lower.y > upper.y || lower.z > upper.z; }
    Vec3f Center() const { return (lower + upper) * 0.5f; }
    Vec3f Size() const { return IsEmpty() ? Vec3f{} : upper - lower; }
    float Diagonal() const { return Length(Size()); }

    /// Half of the surface area: what the surface area heuristic compares.
    float HalfArea() const {
        const Vec3f s = Size();
        return s.x * s.y + s.y * s.z + s.z * s.x;
    }

    void Extend(const Vec3f& p) {
        lower = {std::min(lower.x, p.x), std::min(lower.y, p.y), std::min(lower.z, p.z)};
        upper = {std::max(upper.x, p.x), std::max(upper.y, p.y), std::max(upper.z, p.z)};
    }
    void Extend(const Box3f& b) {
        lower = {std::min(lower.x, b.lower.x), std::min(lower.y, b.lower.y),
                 std::min(lower.z, b.lower.z)};
        upper = {std::max(upper.x, b.upper.x), std::max(upper.y, b.upper.y),
                 std::max(upper.z, b.upper.z)};
    }

  private:
    static constexpr float kFar = std::numeric_limits<float>::infinity();
};

}  // namespace cc
