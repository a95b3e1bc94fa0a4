#include "core/trace/pixelErrorLevels.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace cc {
namespace {

/// What is out of sight may be this much nearer to the eye's plane than what is seen.
constexpr float kOutOfSight = 0.5f;

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

PixelErrorLevels::PixelErrorLevels(const PixelErrorMetric& metric, const Instance& instance)
    : _surface(SurfaceOf(instance)),
      _view(metric.view),
      _space(instance, metric.view.eye),
      _scale(_space.Stretch() * metric.view.pixels / metric.pixelError),
      _least(_surface.Patches().MaxDepth()),
      _finest(std::max(metric.finest, _least)) {
    // Edges are placed by control points, which may be nearer to the eye than any of the surface.
    _finest = Whole();
    _least = std::max(_least, _finest - kMostDifference);
}

int PixelErrorLevels::Whole() const {
    const Box3f& bounds = _surface.Bounds();
    const float reach = 0.5f * _space.Stretch() * bounds.Diagonal();
    return _LevelFor(_surface.Errors().Largest(),
                     _Depth(_space.FromObject(bounds.Center()), reach));
}

PatchLevels PixelErrorLevels::Of(uint32_t patch) const {
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

int PixelErrorLevels::_EdgeLevel(const EdgePoints& edge) const {
    const ChordErrors& errors = _surface.Errors();
    const float error = std::min(errors.At(edge.a), errors.At(edge.b));
    if (error == 0) {
        return _least;
    }
    const std::vector<Vec3f>& points = _surface.PatchPoints();
    const Vec3f a = _space.FromObject(points[edge.a]), b = _space.FromObject(points[edge.b]);
    // The sum rounds alike whichever end is the first; what lies between is no nearer than half the
    // edge.
    const Vec3f middle = 0.5f * (a + b);
    const float half = 0.5f * Length(a - b);
    return _LevelFor(error, _Depth(middle, half));
}

float PixelErrorLevels::_Depth(const Vec3f& middle, float reach) const {
    if (_view.isOrthographic) {
        return 1;
    }
    return std::max(Dot(_view.forward, middle) - reach,
                    kOutOfSight * _view.leastCosine * (Length(middle) - reach));
}

int PixelErrorLevels::_LevelFor(float error, float depth) const {
    const float pixelErrors = depth > 0 ? error * _scale / depth : -1;
    const int level = pixelErrors < 0 ? kFinestLevel : CeilOfLogarithm4(pixelErrors);
    return std::min(std::max(level, _least), _finest);
}

}  // namespace cc
