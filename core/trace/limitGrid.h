#pragma once

#include <algorithm>

#include "core/math/vec.h"
#include "core/subdiv/cubicWeights.h"

namespace cc {

/// Points of the limit surface of a patch, or of a part of one, in a square grid. It lives while
/// one batch of rays meets the patch.
struct LimitGrid {
    /// Grids with fewer columns and rows of quads are filled up with quads without area.
    static constexpr int kLeastColumns = 4, kLeastRows = 2;
    static constexpr int kStride = kMaxGridSide + 4;

    int side;  ///< quads along each side: 1, 2, 4, 8, 16 or 32
    /// Coordinates of the points [row along v][column along u].
    alignas(64) float points[3][kMaxGridSide + 1][kStride];

    Vec3f At(int row, int column) const {
        return {points[0][row][column], points[1][row][column], points[2][row][column]};
    }

    /// Repeats the last point of a row of a small grid.
    void FillRow(int row) {
        for (int axis = 0; axis < 3; ++axis) {
            for (int column = side + 1; column <= kLeastColumns; ++column) {
                points[axis][row][column] = points[axis][row][side];
            }
        }
    }
    /// Repeats the last row and column of a small grid.
    void Fill() {
        for (int row = 0; row <= side && side < kLeastColumns; ++row) {
            FillRow(row);
        }
        for (int axis = 0; axis < 3 && side < kLeastRows; ++axis) {
            std::copy(points[axis][side], points[axis][side] + kLeastColumns + 1,
                      points[axis][kLeastRows]);
        }
    }
};

}  // namespace cc
