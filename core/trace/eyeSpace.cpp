#include "core/trace/eyeSpace.h"

#include <algorithm>
#include <cmath>

namespace cc {
namespace {

/// The root of a norm of the square of a linear map, which is exact for rotations and scales.
float MeasureStretch(const Vec3f rows[3]) {
    float most = 0;
    for (int i = 0; i < 3; ++i) {
        float sum = 0;
        for (int j = 0; j < 3; ++j) {
            sum += std::fabs(rows[0][i] * rows[0][j] + rows[1][i] * rows[1][j] +
                             rows[2][i] * rows[2][j]);
        }
        most = std::max(most, sum);
    }
    return std::sqrt(most);
}

}  // namespace

EyeSpace::EyeSpace(const Instance& instance, const std::array<double, 3>& eye) {
    const AffineTransform& m = instance.objectToWorld;
    for (int i = 0; i < 3; ++i) {
        _rows[i] = {static_cast<float>(m(i, 0)), static_cast<float>(m(i, 1)),
                    static_cast<float>(m(i, 2))};
        _offset[i] = static_cast<float>(m(i, 3) - eye[i]);
    }
    _stretch = MeasureStretch(_rows);
}

}  // namespace cc
