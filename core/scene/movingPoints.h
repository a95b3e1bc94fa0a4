#pragma once

#include <string>
#include <vector>

#include "core/math/vec.h"
#include "core/scene/moving.h"

namespace cc {

/// Points of a shape, all or none of which move.
using MovingPoints = Moving<std::vector<Vec3f>>;

/// Where they are at a time. Between two poses that have not as many, those of the first.
std::vector<Vec3f> PointsAt(const MovingPoints& points, float time);

/// What is wrong if not all poses have as many points; else empty.
std::string CheckPoses(const MovingPoints& points);

/// Memory held by points that move, in bytes.
size_t BytesOf(const MovingPoints& points);

}  // namespace cc
