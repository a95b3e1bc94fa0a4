#pragma once

#include <cmath>
#include <cstdint>

#include "core/math/hash.h"
#include "core/math/vec.h"

namespace cc {

/// Where on a lens the rays of a pixel's samples start, as points of the unit disk. They step by
/// irrational numbers other than those of PixelSampler, so that place in the pixel and place on
/// the lens have nothing to do with each other; each pixel begins elsewhere.
class LensSampler {
  public:
    LensSampler(int x, int y, int seed)
        : _begin{Unit(Hash(HashPixel(x, y, seed) ^ kFirst)),
                 Unit(Hash(HashPixel(x, y, seed) ^ kSecond))} {}

    /// @param index  0 or more
    Vec2f Sample(int index) const {
        // 1/p and 1/p^2, where p^3 = p + 1: the golden ratio's kin in two dimensions (Roberts).
        constexpr double kStepX = 0.7548776662466927, kStepY = 0.5698402909980532;
        return ConcentricDisk(Wrap(_begin[0] + index * kStepX), Wrap(_begin[1] + index * kStepY));
    }

  private:
    static constexpr uint32_t kFirst = 0x9e3779b9u, kSecond = 0x7f4a7c15u;

    static double Unit(uint32_t bits) { return bits * 0x1p-32; }
    static double Wrap(double x) { return x - std::floor(x); }

    /// Takes a square to a disk of the same densities, squares about the centre to circles (Shirley
    /// and Chiu).
    static Vec2f ConcentricDisk(double u, double v) {
        constexpr double kQuarter = 0.7853981633974483;  // pi / 4
        const double x = 2 * u - 1, y = 2 * v - 1;
        if (x == 0 && y == 0) {
            return {0, 0};
        }
        const bool isFlat = std::fabs(x) > std::fabs(y);
        const double radius = isFlat ? x : y;
        const double angle = isFlat ? kQuarter * (y / x) : 2 * kQuarter - kQuarter * (x / y);
        return {static_cast<float>(radius * std::cos(angle)),
                static_cast<float>(radius * std::sin(angle))};
    }

    double _begin[2];
};

}  // namespace cc
