#pragma once

#include "core/math/vec.h"
#include "core/subdiv/bezierPatch.h"
#include "core/subdiv/extraordinaryPatch.h"
#include "core/subdiv/irregularPatch.h"

namespace cc {

/// Where the points of a patch's limit grid go: (side + 1)^2 of them in rows along u, that may be
/// part of a larger array.
struct LimitSquare {
    Vec3f* points;
    int stride;  ///< from a row to the next
    int side;    ///< quads along each side, a power of two

    Vec3f& At(int column, int row) const { return points[row * stride + column]; }
    LimitSquare Quarter(int corner) const {
        const int half = side / 2;
        const int row = corner >= 2 ? half : 0, column = corner == 1 || corner == 2 ? half : 0;
        return {&At(column, row), stride, half};
    }
};

/// Evaluates a patch at all points of a grid, subdividing it until its parts are B-splines.
void EvaluateLimitGrid(const BezierPatch& patch, const LimitSquare& square);
void EvaluateLimitGrid(const IrregularPatch& patch, const LimitSquare& square);
void EvaluateLimitGrid(const ExtraordinaryPatch& patch, const LimitSquare& square);

}  // namespace cc
