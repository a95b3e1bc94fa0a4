#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/bvh/bvh.h"
#include "core/math/vec.h"
#include "core/subdiv/patchTable.h"

namespace cc {

/// The patches of a surface evaluated ahead of time: the quads of a level, or the triangles of the
/// Loop scheme, between points of the limit surface, and a BVH over small blocks of them. What
/// direct tracing is measured against; its memory grows by four a level.
class Tessellation {
  public:
    /// @param patchPoints  one a patch point
    /// @param level        each base face becomes 2^level x 2^level quads or triangles, 0..8; more
    ///                     where faces were refined deeper, as a mesh must meet at one level
    /// NeedOf must say that it is possible.
    Tessellation(const PatchTable& patches, const std::vector<Vec3f>& patchPoints, int level);

    /// The level that a mesh gets where this one is asked for.
    static int LevelOf(const PatchTable& patches, int level);

    /// Memory that a tessellation takes, in bytes, by estimates from above.
    struct Need {
        size_t kept = 0;         ///< as long as it is there
        size_t whileMade = 0;    ///< besides, until it is finished
        bool isPossible = true;  ///< false if there are more blocks than the BVH can hold
    };
    static Need NeedOf(const PatchTable& patches, int level);

    int Level() const { return _level; }

    /// The points of a patch: side + 1 rows along u. Those of a quad have side + 1 points; those of
    /// a triangle of the Loop scheme get shorter by one.
    struct Grid {
        size_t firstPoint;
        int side;         ///< in quads, or in triangles
        float tolerance;  ///< how far apart neighbouring patches may compute the same point
        bool isTriangle;

        /// Points of a row.
        int RowSize(int row) const { return isTriangle ? side + 1 - row : side + 1; }
        /// Quads of a row, or triangles that lie as the patch does; the others fill it up.
        int RowCells(int row) const { return RowSize(row) - 1; }
        size_t PointOf(int column, int row) const {
            const int missing = isTriangle ? row * (row - 1) / 2 : 0;
            return firstPoint + static_cast<size_t>(row) * (side + 1) - missing + column;
        }
        size_t PointCount() const { return PointOf(0, side + 1) - firstPoint; }
    };
    const Grid& PatchGrid(uint32_t patch) const { return _grids[patch]; }
    const Vec3f& PointAt(const Grid& grid, int column, int row) const {
        return _points[grid.PointOf(column, row)];
    }

    /// The cells from a column and a row of a patch on: BlockSide of them in each direction, as far
    /// as rows go.
    struct Block {
        uint32_t patch;
        uint16_t column, row;
    };
    const Block& BlockAt(uint32_t index) const { return _blocks[index]; }
    static int BlockSide(const Grid& grid) { return grid.side > 1 ? 2 : 1; }
    const Bvh& BlockBvh() const { return _bvh; }

    /// Memory held, in bytes.
    size_t Bytes() const;

  private:
    static Grid _MakeGrid(const PatchTable& patches, uint32_t patch, int level, size_t firstPoint);
    static size_t _BlockCount(const Grid& grid);
    void _LayOut(const PatchTable& patches);
    void _Evaluate(const PatchTable& patches, uint32_t patch, const Vec3f* patchPoints);
    Box3f _BlockBox(const Block& block) const;

    int _level;
    std::vector<Grid> _grids;
    std::vector<Vec3f> _points;
    std::vector<Block> _blocks;
    Bvh _bvh;
};

}  // namespace cc
