#include "core/math/transform.h"

#include <cmath>

namespace cc {

Vec3f AffineTransform::Point(const Vec3f& p) const {
    Vec3f result;
    for (int r = 0; r < 3; ++r) {
        const auto& m = _rows[r];
        result[r] = static_cast<float>(m[0] * p.x + m[1] * p.y + m[2] * p.z + m[3]);
    }
    return result;
}

Vec3f AffineTransform::Direction(const Vec3f& d) const {
    Vec3f result;
    for (int r = 0; r < 3; ++r) {
        const auto& m = _rows[r];
        result[r] = static_cast<float>(m[0] * d.x + m[1] * d.y + m[2] * d.z);
    }
    return result;
}

Vec3f AffineTransform::NormalByInverse(const Vec3f& n) const {
    Vec3f result;
    for (int c = 0; c < 3; ++c) {
        result[c] = static_cast<float>(_rows[0][c] * n.x + _rows[1][c] * n.y + _rows[2][c] * n.z);
    }
    return result;
}

Box3f AffineTransform::Box(const Box3f& b) const {
    Box3f result;
    if (b.IsEmpty()) {
        return result;
    }
    for (int corner = 0; corner < 8; ++corner) {
        result.Extend(Point({corner & 1 ? b.upper.x : b.lower.x, corner & 2 ? b.upper.y : b.lower.y,
                             corner & 4 ? b.upper.z : b.lower.z}));
    }
    for (int axis = 0; axis < 3; ++axis) {
        result.lower[axis] = std::nextafter(result.lower[axis], -INFINITY);
        result.upper[axis] = std::nextafter(result.upper[axis], INFINITY);
    }
    return result;
}

double AffineTransform::Determinant() const {
    const auto& m = _rows;
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
           m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

bool AffineTransform::Invert(AffineTransform* inverse) const {
    const double determinant = Determinant();
    const double scale = 1 / determinant;
    if (!std::isfinite(determinant) || !std::isfinite(scale)) {
        return false;
    }
    std::array<std::array<double, 4>, 3> rows{};
    for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 3; ++c) {
            // Cyclic indices give the cofactor its sign.
            const int r1 = (c + 1) % 3, r2 = (c + 2) % 3, c1 = (r + 1) % 3, c2 = (r + 2) % 3;
            rows[r][c] = (_rows[r1][c1] * _rows[r2][c2] - _rows[r1][c2] * _rows[r2][c1]) * scale;
        }
    }
    for (int r = 0; r < 3; ++r) {
        rows[r][3] =
            -(rows[r][0] * _rows[0][3] + rows[r][1] * _rows[1][3] + rows[r][2] * _rows[2][3]);
        for (double x : rows[r]) {
            if (!std::isfinite(x)) {
                return false;
            }
        }
    }
    *inverse = AffineTransform(rows);
    return true;
}

AffineTransform AffineTransform::Lerp(const AffineTransform& a, const AffineTransform& b,
                                      double weight) {
    std::array<std::array<double, 4>, 3> rows{};
    for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 4; ++c) {
            rows[r][c] = (1 - weight) * a(r, c) + weight * b(r, c);
        }
    }
    return AffineTransform(rows);
}

AffineTransform operator*(const AffineTransform& a, const AffineTransform& b) {
    std::array<std::array<double, 4>, 3> rows{};
    for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 4; ++c) {
            rows[r][c] =
                a(r, 0) * b(0, c) + a(r, 1) * b(1, c) + a(r, 2) * b(2, c) + (c == 3 ? a(r, 3) : 0);
        }
    }
    return AffineTransform(rows);
}

}  // namespace cc
