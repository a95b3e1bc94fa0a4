#pragma once

#include "core/math/box.h"
#include "core/math/vec.h"

namespace cc {

/// Four floats that are added, multiplied and compared at once: x, y and z of a point, and one more
/// that no result depends on.
using Float4 = float __attribute__((vector_size(16)));
using Int4 = int __attribute__((vector_size(16)));

inline Float4 ToFloat4(const Vec3f& v) { return Float4{v.x, v.y, v.z, 0}; }
inline Vec3f ToVec3f(const Float4& v) { return {v[0], v[1], v[2]}; }

inline Float4 Min(const Float4& a, const Float4& b) { return a < b ? a : b; }
inline Float4 Max(const Float4& a, const Float4& b) { return a > b ? a : b; }

/// A box as Box3f, in two Float4. A new box is empty.
struct BoxFloat4 {
    Float4 lower = ToFloat4(Box3f().lower), upper = ToFloat4(Box3f().upper);

    void Extend(const Float4& p) {
        lower = Min(lower, p);
        upper = Max(upper, p);
    }
    void Extend(const BoxFloat4& b) {
        lower = Min(lower, b.lower);
        upper = Max(upper, b.upper);
    }
    Box3f ToBox3f() const {
        Box3f box;
        box.lower = ToVec3f(lower);
        box.upper = ToVec3f(upper);
        return box;
    }
    float HalfArea() const { return ToBox3f().HalfArea(); }
};

}  // namespace cc
