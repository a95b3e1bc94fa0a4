#include "core/trace/gridFrame.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cc {
namespace {

/// Sine of the least angle between the grid's sides that makes a plane.
constexpr float kLeastSine = 1e-4f;

float SumOfMagnitudes(const Vec3f& v) { return std::fabs(v.x) + std::fabs(v.y) + std::fabs(v.z); }

}  // namespace

GridFrame::GridFrame(const Vec3f corners[4], int side) : side(side) {
    const Vec3f u = 0.5f * ((corners[1] - corners[0]) + (corners[2] - corners[3]));
    const Vec3f v = 0.5f * ((corners[3] - corners[0]) + (corners[2] - corners[1]));
    base = 0.25f * ((corners[0] + corners[1]) + (corners[2] + corners[3])) - 0.5f * (u + v);
    extent = SumOfMagnitudes(base) + SumOfMagnitudes(u) + SumOfMagnitudes(v);
    const Vec3f normal = Cross(u, v);
    const float square = Dot(normal, normal);
    if (square > kLeastSine * kLeastSine * Dot(u, u) * Dot(v, v)) {
        const float scale = static_cast<float>(side) / square;
        axes[0] = scale * Cross(v, normal);
        axes[1] = scale * Cross(normal, u);
        axes[2] = (1 / std::sqrt(square)) * normal;
    }
    for (int k = 0; k < 3; ++k) {
        margin[k] = kFrameMargin * SumOfMagnitudes(axes[k]);
    }
}

GridBend::Range GridBend::Values(int side) const {
    const float most = 0.25f * static_cast<float>(side * side), twisted = std::fabs(twist);
    return {-most * (std::max(columns, 0.0f) + std::max(rows, 0.0f) + twisted),
            most * (std::max(-columns, 0.0f) + std::max(-rows, 0.0f) + twisted)};
}

float GridBend::Sagitta() const {
    return 0.25f * (std::fabs(columns) + std::fabs(rows) + std::fabs(twist));
}

void GridFrame::SetDeviation(int k, const GridBend& quadratic, float least, float greatest) {
    const GridBend::Range bent = quadratic.Values(side);
    const float wide = bent.greatest - bent.least;
    const float slack = margin[k] * extent + kFrameMargin * wide + quadratic.Sagitta();
    const float end = k < 2 ? static_cast<float>(side) : 0;
    bend[k] = quadratic;
    lower[k] = least - slack;
    upper[k] = greatest + slack;
    boxLower[k] = lower[k] + bent.least;
    boxUpper[k] = upper[k] + bent.greatest + end;
    _quadsOfBends += wide * (k < 2 ? 1 : std::sqrt(Length(axes[0]) * Length(axes[1])));
    // Without a plane, or with points that are not numbers, every ray may meet every quad.
    if (!(margin[k] > 0 && std::isfinite(boxLower[k]) && std::isfinite(boxUpper[k]))) {
        axes[k] = {};
        bend[k] = {};
        margin[k] = 0;
        lower[k] = boxLower[k] = -std::numeric_limits<float>::max();
        upper[k] = boxUpper[k] = std::numeric_limits<float>::max();
    }
}

void GridFrame::Widen(float distance) {
    for (int k = 0; k < 3; ++k) {
        const float by = distance / kFrameMargin * margin[k];
        lower[k] -= by;
        upper[k] += by;
        boxLower[k] -= by;
        boxUpper[k] += by;
    }
}

}  // namespace cc
