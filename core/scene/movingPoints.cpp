#include "core/scene/movingPoints.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace cc {
namespace {

/// Points that a thread takes at a time.
constexpr size_t kPointGrain = 4096;

}  // namespace

std::vector<Vec3f> PointsAt(const MovingPoints& points, float time) {
    const auto at = points.At(time);
    std::vector<Vec3f> between = at.first;
    if (at.weight == 0 || at.second.size() != at.first.size()) {
        return between;
    }
    const double weight = at.weight;
    tbb::parallel_for(
        tbb::blocked_range<size_t>(0, between.size(), kPointGrain), [&](const auto& part) {
            for (size_t i = part.begin(); i < part.end(); ++i) {
                for (int axis = 0; axis < 3; ++axis) {
                    between[i][axis] = static_cast<float>((1 - weight) * at.first[i][axis] +
                                                          weight * at.second[i][axis]);
                }
            }
        });
    return between;
}

void KeepIfPosesAgree(MovingPoints* points, std::vector<std::string>* lines) {
    const size_t expected = points->Poses().front().size();
    for (size_t i = 1; i < points->Poses().size(); ++i) {
        const size_t count = points->Poses()[i].size();
        if (count != expected) {
            lines->push_back("pose " + std::to_string(i) + " of its motion has " +
                             std::to_string(count) + " points, and the first " +
                             std::to_string(expected) + "; it is shown at rest");
            *points = {};
            return;
        }
    }
}

size_t BytesOf(const MovingPoints& points) {
    size_t bytes = 0;
    for (const std::vector<Vec3f>& pose : points.Poses()) {
        bytes += pose.capacity() * sizeof(Vec3f);
    }
    return bytes;
}

}  // namespace cc
