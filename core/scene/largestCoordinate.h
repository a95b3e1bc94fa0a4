#pragma once

#include <cmath>

#include "core/math/vec.h"

namespace cc {

/// Larger coordinates overflow when they are squared and summed up.
constexpr float kLargestCoordinate = 1e18f;

/// True if a point can be traced.
inline bool IsUsable(const Vec3f& p) {
    // False for NaN too.
    return std::fabs(p.x) <= kLargestCoordinate && std::fabs(p.y) <= kLargestCoordinate &&
           std::fabs(p.z) <= kLargestCoordinate;
}

}  // namespace cc
