#pragma once

#include <cstdint>

namespace cc {

/// An integer hash that changes all bits (Wellons' lowbias32).
inline uint32_t Hash(uint32_t x) {
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    return x ^ (x >> 16);
}

/// A hash of a pixel's coordinates and a seed.
inline uint32_t HashPixel(int x, int y, int seed) {
    return Hash(static_cast<uint32_t>(x) +
                Hash(static_cast<uint32_t>(y) + Hash(static_cast<uint32_t>(seed))));
}

}  // namespace cc
