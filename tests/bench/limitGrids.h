#pragma once

#include <cstdint>
#include <vector>

#include "core/math/transform.h"
#include "core/trace/surface.h"

/// The limit surface of one mesh, evaluated at the corners of all quads of a level: what a renderer
/// would hand to a ray tracer that knows grids or quads only.
struct LimitGrids {
    /// One grid a patch: its first point, and how many points a side it has.
    struct Grid {
        uint32_t firstPoint;
        int side;
    };
    std::vector<Grid> grids;
    std::vector<cc::Vec3f> points;
};

/// @param level  each base face is split into 2^level x 2^level quads
LimitGrids EvaluateLimitGrids(const cc::Surface& surface, const cc::AffineTransform& objectToWorld,
                              int level);
