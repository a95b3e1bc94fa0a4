#pragma once

#include <cstdint>

#include "core/trace/levelMetric.h"
#include "core/trace/limitGrid.h"
#include "core/trace/patchSquare.h"

namespace cc {

/// Joins a limit grid to coarser neighbours. Points of the border that a neighbour does not have
/// move onto the nearest that it has: quads along the border become fans of triangles around those
/// (paper, Figure 3, but on the finer side), and no T-junction is left. Both sides then end in the
/// same edges between the same points.
class GridStitch {
  public:
    GridStitch() = default;
    /// @param levels  of the patch, interior - depth <= 5 splits or those of its parts
    /// @param square  the part of the patch that is the grid
    /// @param side    of the grid, in quads
    /// @param isTransposed  the grid's columns run along v
    GridStitch(const PatchLevels& levels, const Square& square, int side, bool isTransposed);

    bool IsNeeded() const { return (_steps[0] | _steps[1] | _steps[2] | _steps[3]) > 1; }

    /// Moves the points. Returns how far the new borders are from the old ones at most.
    float Apply(LimitGrid* grid) const;

    /// Widens a range of quads that a ray may meet before points are moved to those that it may
    /// meet after.
    void Widen(int* firstColumn, int* lastColumn, int* firstRow, int* lastRow) const;

    /// Where in the grid, in quads, a hit is that was found at u and v on a quad's triangle as if
    /// no point had moved.
    /// @param triangle  two for each quad, row by row (GridHit)
    void ToUnmoved(int triangle, float* u, float* v) const;

    /// True if a quad has points that have moved.
    bool IsInFan(int column, int row) const;
    /// The same of a place in the square, from (0,0) to (1,1).
    bool IsInFan(const Vec2f& at) const;

  private:
    enum Border { kLowRow, kHighColumn, kHighRow, kLowColumn };

    static int _Nearest(int i, int step) { return (i + step / 2) / step * step; }
    /// Where a point of the grid has gone.
    void _Move(int* column, int* row) const;
    static void _Extend(int step, int side, int* first, int* last);

    int _side = 0;
    /// Quads between the points that each border keeps.
    int _steps[4] = {1, 1, 1, 1};
};

}  // namespace cc
