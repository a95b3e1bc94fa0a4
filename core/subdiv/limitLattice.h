#pragma once

#include "core/math/vec.h"
#include "core/subdiv/bezierTriangle.h"
#include "core/subdiv/irregularTriangle.h"

namespace cc {

/// Where the points of a triangle's limit lattice go: rows along u, the first of side + 1 points
/// and each further one shorter by one.
struct LimitLattice {
    Vec3f* points;
    int side;  ///< triangles along each side, a power of two

    Vec3f& At(int column, int row) const {
        return points[row * (side + 1) - row * (row - 1) / 2 + column];
    }
};

/// Evaluates a triangle at all points of a lattice, subdividing it until its parts are box splines.
void EvaluateLimitLattice(const BezierTriangle& patch, const LimitLattice& lattice);
void EvaluateLimitLattice(const IrregularTriangle& patch, const LimitLattice& lattice);

}  // namespace cc
