#pragma once

#include "core/subdiv/bezierTriangle.h"

namespace cc {

/// Weights of a Bezier triangle's control points, source by source, in 16 points at once (the last
/// one repeats the first where there are 15).
struct BezierCombination {
    alignas(64) float weights[BezierTriangle::kPointCount][16];
};

/// A triangle between points of a lattice.
struct LatticeTriangle {
    int vertices[3];
    /// Of its first corner, in steps; the second is `turn` columns away, the third as many rows.
    float column, row, turn;
};

/// Splits that a lattice of 15 points stands for.
constexpr int kLatticeSplits = 2;

/// The vertices of the triangles that splits make: 3, 6 or 15, row by row.
struct LatticeTable {
    BezierCombination weights;
    LatticeTriangle triangles[1 << (2 * kLatticeSplits)];
};

/// What splitting and evaluating a quartic Bezier triangle take, made once.
struct BezierTables {
    BezierCombination splits[4];  ///< the control points of the parts of SubTriangle::Split
    LatticeTable lattice[kLatticeSplits + 1];

    static const BezierTables& Get();
};

}  // namespace cc
