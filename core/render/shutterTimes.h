#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace cc {

/// The times at which a pixel's samples see a scene that moves: the middles of equal parts of the
/// time that the shutter is open. They come in an order in which the first few are spread well, too,
/// which has nothing to do with where in a pixel samples lie.
inline std::vector<float> ShutterTimes(float open, float close, int count) {
    constexpr double kStep = 0.41421356237309505;  // the square root of 2, less 1
    std::vector<double> keys(count);
    for (int i = 0; i < count; ++i) {
        const double x = 0.5 + i * kStep;
        keys[i] = x - std::floor(x);
    }
    std::vector<double> sorted = keys;
    std::sort(sorted.begin(), sorted.end());
    std::vector<float> times(count);
    for (int i = 0; i < count; ++i) {
        const auto rank = std::lower_bound(sorted.begin(), sorted.end(), keys[i]) - sorted.begin();
        const double at = (static_cast<double>(rank) + 0.5) / count;
        times[i] = static_cast<float>(open + at * (double(close) - open));
    }
    return times;
}

}  // namespace cc
