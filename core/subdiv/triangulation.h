#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/math/vec.h"

namespace cc {

/// Corners of a polygon, counted from 0, that make a triangle wound like the polygon.
using PolygonTriangle = std::array<uint32_t, 3>;

/// Cuts a polygon into triangles by clipping ears, the one with the shortest diagonal first, in the
/// projection along the polygon's normal (Newell's: the sum of the cross products of its edges). A
/// convex quad is cut from corner 0 to corner 2, as renderers commonly do.
///
/// Concave polygons are covered exactly, and so are polygons that meet themselves at points or
/// along bridges to their holes. Repeated corners and corners on a straight line give triangles
/// without area only where no other will do. A polygon that crosses itself, or is too far from flat
/// to have an inside, is covered as well as ears can be found: where there is none, what comes
/// nearest to one is clipped. Takes about O(n log n) for polygons that do not cross themselves.
///
/// @param corners  finite positions
/// Returns n - 2 triangles for any n corners from 3 up, none for fewer; the same ones every time.
std::vector<PolygonTriangle> TriangulatePolygon(const std::vector<Vec3f>& corners);

}  // namespace cc
