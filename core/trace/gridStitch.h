#pragma once

#include <cstdint>

#include "core/trace/levelMetric.h"
#include "core/trace/limitGrid.h"
#include "core/trace/patchSquare.h"

namespace cc {

/// Joins a limit grid to neighbours of other levels. It is as fine as the finest of the inside and
/// the edges; where it needs not be, points move onto the nearest that are kept. Of coarser edges
/// that is those that the neighbour has; of a coarser inside, those of its own level, and what lies
/// between these and a finer edge becomes fans of triangles (paper, Figure 3). No T-junction is
/// left: both sides of an edge end in the same lines between the same points.
class GridStitch {
  public:
    GridStitch() = default;
    /// @param levels  of the patch, finest - depth <= 5 splits or those of its parts
    /// @param square  the part of the patch that is the grid
    /// @param side    of the grid, in quads
    /// @param isTransposed  the grid's columns run along v
    GridStitch(const PatchLevels& levels, const Square& square, int side, bool isTransposed);

    bool IsNeeded() const { return _isNeeded; }

    /// Moves the points. Returns how far what they span is from where they were, at most.
    float Apply(LimitGrid* grid) const;

    /// Widens a range of quads that a ray may meet before points are moved to those that it may
    /// meet after.
    void Widen(int* firstColumn, int* lastColumn, int* firstRow, int* lastRow) const;

    /// Where a point of the grid, by its column and row, has gone.
    void Move(int* column, int* row) const;

    /// Where in the grid, in quads, a hit is that was found at u and v on a quad's triangle as if
    /// no point had moved.
    /// @param triangle  two for each quad, row by row (GridHit)
    void ToUnmoved(int triangle, float* u, float* v) const;

    /// True if a quad is where the grid joins an edge of another level.
    bool IsInFan(int column, int row) const;
    /// The same of a place in the square, from (0,0) to (1,1).
    bool IsInFan(const Vec2f& at) const;

  private:
    enum Border { kLowRow, kHighColumn, kHighRow, kLowColumn };

    static int _Nearest(int i, int step) { return (i + step / 2) / step * step; }
    /// Where the number of a column or row inside has gone. Fans leave no room for others at the
    /// patch's edges.
    int _MoveInside(int i, bool isLowEdge, bool isHighEdge) const;
    /// How far points are from straight lines between those that a border keeps.
    float _BorderDeviation(const LimitGrid& grid) const;
    /// How far points are from quads between those that are kept inside.
    float _InnerDeviation(const LimitGrid& grid) const;
    static void _Extend(int step, int side, int* first, int* last);

    int _side = 0;
    /// Quads between the points that are kept inside, and along each border.
    int _innerStep = 1, _steps[4] = {1, 1, 1, 1};
    bool _isEdge[4] = {false, false, false, false};  ///< whether borders are on the patch's edges
    bool _isNeeded = false;
};

}  // namespace cc
