#pragma once

namespace cc {

/// A point of the 4x4 grid around a quad, whose corners are at (1,1) (1,2) (2,2) (2,1). Edge i runs
/// from corner i to the next. Corners and edges are counted modulo four.
struct GridPosition {
    int row, column;
};

inline GridPosition GridCorner(int corner) {
    constexpr GridPosition kCorners[4] = {{1, 1}, {1, 2}, {2, 2}, {2, 1}};
    return kCorners[corner & 3];
}
/// The grid point beyond an edge, next to one of the edge's corners.
inline GridPosition GridAcross(int corner, int edge) {
    constexpr GridPosition kOutwards[4] = {{-1, 0}, {0, 1}, {1, 0}, {0, -1}};
    const GridPosition p = GridCorner(corner), d = kOutwards[edge & 3];
    return {p.row + d.row, p.column + d.column};
}
/// The grid point diagonally beyond a corner.
inline GridPosition GridDiagonal(int corner) {
    constexpr GridPosition kDiagonals[4] = {{0, 0}, {0, 3}, {3, 3}, {3, 0}};
    return kDiagonals[corner & 3];
}

}  // namespace cc
