#pragma once

#include <random>
#include <vector>

#include "core/trace/instanceLevels.h"
#include "core/trace/surface.h"

namespace cc::test {

/// How often a surface, cut into quads as the levels say and stitched where they differ, winds
/// around a point: the solid angles of its triangles, as parts of the sphere. From a point where
/// this is not zero, every way out leads through the surface.
double WindingNumber(const Surface& surface, const InstanceLevels& levels, const Vec3f& point);

/// True if a surface winds around a point, and around those that rounding may take for it.
/// @param rounding  how far away those are
bool IsEnclosed(const Surface& surface, const InstanceLevels& levels, const Vec3f& point,
                float rounding);

/// Points well inside a closed surface, as many as were found, at most `most`.
std::vector<Vec3f> EnclosedPoints(const Surface& surface, const InstanceLevels& levels, size_t most,
                                  std::mt19937* random);

}  // namespace cc::test
