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

/// Leaves points at rest whose poses have not all as many of them, and adds a line that says so.
void KeepIfPosesAgree(MovingPoints* points, std::vector<std::string>* lines);

/// Memory held by points that move, in bytes.
size_t BytesOf(const MovingPoints& points);

}  // namespace cc
