#include "core/trace/levelMetric.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace cc {
namespace {

/// What is out of sight may be this much nearer to the eye's plane than what is seen.
constexpr float kOutOfSight = 0.5f;

/// The most that a linear map stretches a length, or a little more: the root of a norm of its
/// square, which is exact for rotations and scales.
float Stretch(const Vec3f rows[3]) {
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

/// The least n >= 0 so that 4^n >= x.
int CeilOfLogarithm4(float x) {
    if (!(x > 1)) {
        return x <= 1 ? 0 : kFinestLevel;
    }
    uint32_t bits;
    std::memcpy(&bits, &x, sizeof(bits));
    const int floorOfLogarithm2 = static_cast<int>(bits >> 23) - 127;
    const int logarithm2 = floorOfLogarithm2 + static_cast<int>((bits & 0x7fffffu) != 0);
    return (logarithm2 + 1) / 2;
}

}  // namespace

InstanceLevels::InstanceLevels(const LevelMetric& metric, const Instance& instance)
    : _surface(*instance.surface),
      _least(std::max(metric.IsUniform() ? metric.Finest() : 0, _surface.Patches().MaxDepth())),
      _finest(std::max(metric.Finest(), _least)),
      _isUniform(metric.IsUniform()) {
    if (_isUniform) {
        return;
    }
    _view = metric.View();
    const AffineTransform& m = instance.objectToWorld;
    for (int i = 0; i < 3; ++i) {
        _rows[i] = {static_cast<float>(m(i, 0)), static_cast<float>(m(i, 1)),
                    static_cast<float>(m(i, 2))};
        _offset[i] = static_cast<float>(m(i, 3) - _view.eye[i]);
    }
    _stretch = Stretch(_rows);
    _scale = _stretch * _view.pixels / metric.PixelError();
    const PatchTable& patches = _surface.Patches();
    if (patches.Count() == 0 || patches.IsCutAlike()) {
        _isUniform = true;
        _least = _WholeLevel();
    } else {
        _least = std::max(_least, _WholeLevel() - kMostDifference);
    }
}

PatchLevels InstanceLevels::Of(uint32_t patch) const {
    if (_isUniform) {
        const auto level = static_cast<uint8_t>(_least);
        return {level, {level, level, level, level}};
    }
    EdgePoints ends[4];
    _surface.Patches().EdgeEnds(patch, ends);
    PatchLevels levels;
    for (int i = 0; i < 4; ++i) {
        const int level = _EdgeLevel(ends[i]);
        levels.edges[i] = static_cast<uint8_t>(level);
        levels.interior = std::max(levels.interior, levels.edges[i]);
    }
    return levels;
}

int InstanceLevels::_EdgeLevel(const EdgePoints& edge) const {
    const ChordErrors& errors = _surface.Errors();
    const float error = std::min(errors.At(edge.a), errors.At(edge.b));
    if (error == 0) {
        return _least;
    }
    const std::vector<Vec3f>& points = _surface.PatchPoints();
    const Vec3f a = _FromEye(points[edge.a]), b = _FromEye(points[edge.b]);
    // The sum rounds alike whichever end is the first; what lies between is no nearer than half the
    // edge.
    const Vec3f middle = 0.5f * (a + b);
    const float half = 0.5f * Length(a - b);
    return _LevelFor(error, _Depth(middle, half));
}

float InstanceLevels::_Depth(const Vec3f& middle, float reach) const {
    if (_view.isOrthographic) {
        return 1;
    }
    return std::max(Dot(_view.forward, middle) - reach,
                    kOutOfSight * _view.leastCosine * (Length(middle) - reach));
}

int InstanceLevels::_LevelFor(float error, float depth) const {
    const float pixelErrors = depth > 0 ? error * _scale / depth : -1;
    const int level = pixelErrors < 0 ? kFinestLevel : CeilOfLogarithm4(pixelErrors);
    return std::min(std::max(level, _least), _finest);
}

int InstanceLevels::_WholeLevel() const {
    const Box3f& bounds = _surface.Bounds();
    return _LevelFor(_surface.Errors().Largest(),
                     _Depth(_FromEye(bounds.Center()), 0.5f * _stretch * bounds.Diagonal()));
}

Vec3f InstanceLevels::_FromEye(const Vec3f& p) const {
    return {Dot(_rows[0], p) + _offset.x, Dot(_rows[1], p) + _offset.y,
            Dot(_rows[2], p) + _offset.z};
}

}  // namespace cc
