#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace cc {

/// The times at which the samples of some pixels see a scene that moves. The time that the shutter
/// is open has as many equal parts as pixels have samples; each pixel sees one time of every part,
/// and neighbours see different ones, evenly spread. The first few samples are spread well, too, by
/// an order which has nothing to do with where in a pixel samples lie.
/// @param count    samples a pixel
/// @param part     which of the pixels, as they are interleaved
/// @param parts    of how many
inline std::vector<float> ShutterTimes(float open, float close, int count, int part, int parts) {
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
        const double at = (static_cast<double>(rank) + (part + 0.5) / parts) / count;
        times[i] = static_cast<float>(open + at * (double(close) - open));
    }
    return times;
}

}  // namespace cc
