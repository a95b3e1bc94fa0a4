#pragma once

#include <cmath>
#include <cstdint>

#include "core/math/hash.h"
#include "core/math/vec.h"

namespace cc {

/// Where in a pixel its samples lie, each coordinate in [0, 1). Sample 0 is the centre. All
/// together are a lattice after Fibonacci: a coordinate steps evenly, the other by the golden
/// ratio. Each pixel mirrors and transposes it at random about the centre, so that neighbours do
/// not alias alike.
class PixelSampler {
  public:
    /// @param count  samples that the pixel gets, 1 or more
    PixelSampler(int x, int y, int seed, int count)
        : _step(1.0 / count), _bits(HashPixel(x, y, seed)) {}

    Vec2f Sample(int index) const {
        constexpr double kGoldenRatio = 0.6180339887498949;
        double x = index * _step;
        double y = std::fmod(index * kGoldenRatio, 1.0);
        x = _bits & 1 ? -x : x;
        y = _bits & 2 ? -y : y;
        return _bits & 4 ? Vec2f{AboutCenter(y), AboutCenter(x)}
                         : Vec2f{AboutCenter(x), AboutCenter(y)};
    }

  private:
    /// 0.5 + d, wrapped to [0, 1) after rounding too.
    static float AboutCenter(double d) {
        const double x = d + 0.5;
        const float wrapped = static_cast<float>(x - std::floor(x));
        return wrapped < 1 ? wrapped : 0;
    }

    double _step;
    uint32_t _bits;
};

}  // namespace cc
