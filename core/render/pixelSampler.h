#pragma once

#include <cmath>
#include <cstdint>

#include "core/math/vec.h"

namespace cc {

/// Where in a pixel its samples lie, each coordinate in [0, 1). Sample 0 is the centre. All
/// together are Roberts' R2 sequence, which spreads evenly however many samples are taken; each
/// pixel mirrors and transposes it at random about the centre, so that neighbours do not alias
/// alike.
class PixelSampler {
  public:
    PixelSampler(int x, int y, int seed)
        : _bits(Hash(static_cast<uint32_t>(x) +
                     Hash(static_cast<uint32_t>(y) + Hash(static_cast<uint32_t>(seed))))) {}

    Vec2f Sample(int index) const {
        // Powers of 1 / 1.3247..., the plastic number.
        double x = std::fmod(index * 0.7548776662466927, 1.0);
        double y = std::fmod(index * 0.5698402909980532, 1.0);
        x = _bits & 1 ? -x : x;
        y = _bits & 2 ? -y : y;
        return _bits & 4 ? Vec2f{AboutCenter(y), AboutCenter(x)}
                         : Vec2f{AboutCenter(x), AboutCenter(y)};
    }

  private:
    /// An integer hash that changes all bits (Wellons' lowbias32).
    static uint32_t Hash(uint32_t x) {
        x ^= x >> 16;
        x *= 0x7feb352du;
        x ^= x >> 15;
        x *= 0x846ca68bu;
        return x ^ (x >> 16);
    }

    /// 0.5 + d, wrapped to [0, 1) after rounding too.
    static float AboutCenter(double d) {
        const double x = d + 0.5;
        const float wrapped = static_cast<float>(x - std::floor(x));
        return wrapped < 1 ? wrapped : 0;
    }

    uint32_t _bits;
};

}  // namespace cc
