#pragma once

#include <array>

namespace cc {

/// The finest limit grid: 2^5 x 2^5 quads.
constexpr int kMaxGridSplits = 5;
constexpr int kMaxGridSide = 1 << kMaxGridSplits;

/// Cubic Bernstein weights at parameters i / 2^splits, by even and odd parts: a curve with control
/// points a, b, c, d is at evenEnds (a + d) + evenInner (b + c) + oddEnds (d - a) + oddInner (c -
/// b). All are fractions of powers of two and exact.
struct CubicWeights {
    alignas(64) float evenEnds[kMaxGridSide];
    alignas(64) float evenInner[kMaxGridSide];
    alignas(64) float oddEnds[kMaxGridSide];
    alignas(64) float oddInner[kMaxGridSide];
};

constexpr CubicWeights MakeCubicWeights(int splits) {
    CubicWeights weights{};
    for (int i = 0; i < 1 << splits; ++i) {
        const float t = static_cast<float>(i) / static_cast<float>(1 << splits), s = 1 - t;
        const float a = s * s * s, b = 3 * s * s * t, c = 3 * s * t * t, d = t * t * t;
        weights.evenEnds[i] = (a + d) / 2;
        weights.evenInner[i] = (b + c) / 2;
        weights.oddEnds[i] = (d - a) / 2;
        weights.oddInner[i] = (c - b) / 2;
    }
    return weights;
}

/// By the number of splits.
inline constexpr std::array<CubicWeights, kMaxGridSplits + 1> kCubicWeights{
    MakeCubicWeights(0), MakeCubicWeights(1), MakeCubicWeights(2),
    MakeCubicWeights(3), MakeCubicWeights(4), MakeCubicWeights(5)};

}  // namespace cc
