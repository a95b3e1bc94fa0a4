#include "core/trace/distanceLevels.h"

#include <algorithm>
#include <cmath>

namespace cc {

DistanceLevels::DistanceLevels(const DistanceMetric& metric, const Instance& instance)
    : _surface(SurfaceOf(instance)),
      _space(instance, metric.eye),
      _reach(metric.reach),
      _coarse(std::max(metric.finest - 2, _surface.Patches().MaxDepth())),
      _fine(std::max(metric.finest, _coarse)) {}

int DistanceLevels::Whole() const {
    const Box3f& bounds = _surface.Bounds();
    return _LevelAt(Length(_space.FromObject(bounds.Center())) -
                    0.5f * _space.Stretch() * bounds.Diagonal());
}

PatchLevels DistanceLevels::Of(uint32_t patch) const {
    const std::vector<Vec3f>& points = _surface.PatchPoints();
    EdgePoints ends[4];
    _surface.Patches().EdgeEnds(patch, ends);
    PatchLevels levels;
    Vec3f sum;
    for (int i = 0; i < 4; ++i) {
        const Vec3f a = _space.FromObject(points[ends[i].a]),
                    b = _space.FromObject(points[ends[i].b]);
        // Both sides round alike. The middles of patches that are no longer than their edges lie
        // within an edge's length.
        const float distance = 0.5f * Length(a + b) - Length(a - b);
        levels.edges[i] = static_cast<uint8_t>(_LevelAt(distance));
        sum += a + b;
    }
    levels.interior = static_cast<uint8_t>(_LevelAt(0.125f * Length(sum)));
    return levels;
}

int DistanceLevels::_LevelAt(float distance) const {
    // Thresholds in place of a logarithm: exact, and the same on every machine.
    int level = _fine;
    while (level > _coarse && distance * std::exp2(static_cast<float>(level)) > _reach) {
        --level;
    }
    return level;
}

}  // namespace cc
