#pragma once

#include "core/subdiv/bezierPatch.h"

namespace cc {

/// A bicubic Bezier patch laid out for SIMD: four rows of four columns, with the x, y and z of a
/// row side by side in blocks of four lanes (the fourth block is padding). One vector operation
/// then acts on all coordinates of a row, at any vector width up to sixteen lanes.
struct alignas(64) BezierRows {
    float rows[4][16];

    explicit BezierRows(const BezierPatch& patch) {
        for (int r = 0; r < 4; ++r) {
            for (int c = 0; c < 4; ++c) {
                rows[r][c] = patch.points[r][c].x;
                rows[r][4 + c] = patch.points[r][c].y;
                rows[r][8 + c] = patch.points[r][c].z;
                rows[r][12 + c] = 0;
            }
        }
    }
    BezierRows() = default;

    /// A corner of the patch: a point of the limit surface.
    Vec3f Corner(int row, int column) const {
        const float* r = &rows[3 * row][3 * column];
        return {r[0], r[4], r[8]};
    }
};

}  // namespace cc
