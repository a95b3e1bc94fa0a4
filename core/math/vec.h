#pragma once

#include <cmath>
#include <cstdint>

namespace cc {

/// Two floats: a surface parameter or a position in the image.
struct Vec2f {
    float x = 0, y = 0;
};

/// Three floats: a point, direction, normal or linear RGB colour.
struct Vec3f {
    float x = 0, y = 0, z = 0;

    float operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
    float& operator[](int axis) { return axis == 0 ? x : axis == 1 ? y : z; }

    Vec3f& operator+=(const Vec3f& b) { return *this = {x + b.x, y + b.y, z + b.z}; }
    Vec3f& operator*=(float s) { return *this = {x * s, y * s, z * s}; }
};

inline Vec3f operator+(const Vec3f& a, const Vec3f& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3f operator-(const Vec3f& a, const Vec3f& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3f operator-(const Vec3f& a) { return {-a.x, -a.y, -a.z}; }
inline Vec3f operator*(const Vec3f& a, const Vec3f& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
inline Vec3f operator*(const Vec3f& a, float s) { return {a.x * s, a.y * s, a.z * s}; }
inline Vec3f operator*(float s, const Vec3f& a) { return a * s; }
inline bool operator==(const Vec3f& a, const Vec3f& b) {
    return a.x == b.x && a.y == b.y && a.z == b.z;
}
inline bool operator!=(const Vec3f& a, const Vec3f& b) { return !(a == b); }

inline float Dot(const Vec3f& a, const Vec3f& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3f Cross(const Vec3f& a, const Vec3f& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline float Length(const Vec3f& a) { return std::sqrt(Dot(a, a)); }

/// Returns a scaled to length 1, or the zero vector if its length is zero or not finite.
inline Vec3f Normalize(const Vec3f& a) {
    const float length = Length(a);
    return length > 0 && std::isfinite(length) ? a * (1 / length) : Vec3f{};
}

inline bool IsFinite(const Vec3f& a) {
    return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

}  // namespace cc
