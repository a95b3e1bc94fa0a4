#pragma once

#include <array>

#include "core/math/box.h"
#include "core/math/vec.h"

namespace cc {

/// An affine map in double precision: rows of a 3x4 matrix applied to column vectors.
/// The last column is the translation.
class AffineTransform {
  public:
    /// The identity.
    AffineTransform() = default;

    /// @param rows  three rows of four numbers
    explicit AffineTransform(const std::array<std::array<double, 4>, 3>& rows) : _rows(rows) {}

    double operator()(int row, int column) const { return _rows[row][column]; }

    Vec3f Point(const Vec3f& p) const;
    Vec3f Direction(const Vec3f& d) const;

    /// Transforms a normal, given the *inverse* of the map that moves the surface: the transposed
    /// linear part is applied. The result is not normalized.
    Vec3f NormalByInverse(const Vec3f& n) const;

    /// The box of the eight transformed corners, rounded outwards.
    Box3f Box(const Box3f& b) const;

    /// Determinant of the linear part: negative for a mirror, zero when there is no inverse.
    double Determinant() const;

    /// Returns false, and leaves inverse alone, if the map is singular or not finite.
    bool Invert(AffineTransform* inverse) const;

    /// The map whose numbers are between those of two: a at weight 0, b at 1.
    static AffineTransform Lerp(const AffineTransform& a, const AffineTransform& b, double weight);

    bool operator==(const AffineTransform& b) const { return _rows == b._rows; }
    bool operator!=(const AffineTransform& b) const { return !(*this == b); }

    friend AffineTransform operator*(const AffineTransform& a, const AffineTransform& b);

  private:
    std::array<std::array<double, 4>, 3> _rows{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
};

}  // namespace cc
