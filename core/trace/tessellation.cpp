#include "core/trace/tessellation.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

#include "core/subdiv/limitGrid.h"
#include "core/subdiv/limitLattice.h"

namespace cc {
namespace {

/// Of the BVH, for each block.
constexpr size_t kBvhBytes = 24;
/// Boxes, and what the BVH is built from.
constexpr size_t kScratchBytes = 112;

/// Evaluates a patch relative to one of its points, so that little is rounded.
template <class AnyPatch, class Grid>
void EvaluateNear(const Vec3f& origin, AnyPatch patch, const Grid& grid, size_t pointCount,
                  void (*evaluate)(const AnyPatch&, const Grid&)) {
    patch.Translate(-origin);
    evaluate(patch, grid);
    for (size_t i = 0; i < pointCount; ++i) {
        grid.points[i] += origin;
    }
}

}  // namespace

int Tessellation::LevelOf(const PatchTable& patches, int level) {
    return std::max(level, patches.MaxDepth());
}

Tessellation::Tessellation(const PatchTable& patches, const std::vector<Vec3f>& patchPoints,
                           int level)
    : _level(LevelOf(patches, level)) {
    _LayOut(patches);
    tbb::parallel_for(size_t(0), patches.Count(), [&](size_t patch) {
        _Evaluate(patches, static_cast<uint32_t>(patch), patchPoints.data());
    });
    std::vector<Box3f> boxes(_blocks.size());
    tbb::parallel_for(size_t(0), boxes.size(), [&](size_t i) { boxes[i] = _BlockBox(_blocks[i]); });
    _bvh = Bvh(boxes);
}

Tessellation::Grid Tessellation::_MakeGrid(const PatchTable& patches, uint32_t patch, int level,
                                           size_t firstPoint) {
    const Patch& p = patches.At(patch);
    const int side = p.kind == PatchKind::FlatTriangle ? 1 : 1 << (level - p.depth);
    return {firstPoint, side, 0, patches.IsTriangle(patch)};
}

size_t Tessellation::_BlockCount(const Grid& grid) {
    const size_t blocks = static_cast<size_t>(grid.side / BlockSide(grid));
    return grid.isTriangle ? blocks * (blocks + 1) / 2 : blocks * blocks;
}

Tessellation::Need Tessellation::NeedOf(const PatchTable& patches, int level) {
    size_t pointCount = 0, blockCount = 0;
    for (uint32_t patch = 0; patch < patches.Count(); ++patch) {
        const Grid grid = _MakeGrid(patches, patch, LevelOf(patches, level), 0);
        pointCount += grid.PointCount();
        blockCount += _BlockCount(grid);
    }
    Need need;
    need.kept = patches.Count() * sizeof(Grid) + pointCount * sizeof(Vec3f) +
                blockCount * (sizeof(Block) + kBvhBytes);
    need.whileMade = blockCount * kScratchBytes;
    need.isPossible = blockCount < kBvhLeaf;
    return need;
}

/// Decides where everything goes.
void Tessellation::_LayOut(const PatchTable& patches) {
    _grids.resize(patches.Count());
    size_t pointCount = 0, blockCount = 0;
    for (uint32_t patch = 0; patch < patches.Count(); ++patch) {
        _grids[patch] = _MakeGrid(patches, patch, _level, pointCount);
        pointCount += _grids[patch].PointCount();
        blockCount += _BlockCount(_grids[patch]);
    }
    _points.resize(pointCount);
    _blocks.reserve(blockCount);
    for (uint32_t patch = 0; patch < patches.Count(); ++patch) {
        const Grid& grid = _grids[patch];
        const int step = BlockSide(grid);
        for (int row = 0; row < grid.side; row += step) {
            for (int column = 0; column < grid.RowCells(row); column += step) {
                _blocks.push_back(
                    {patch, static_cast<uint16_t>(column), static_cast<uint16_t>(row)});
            }
        }
    }
}

void Tessellation::_Evaluate(const PatchTable& patches, uint32_t patch, const Vec3f* patchPoints) {
    Grid& grid = _grids[patch];
    Vec3f* const points = &_points[grid.firstPoint];
    const size_t count = grid.PointCount();
    const LimitSquare square{points, grid.side + 1, grid.side};
    const LimitLattice lattice{points, grid.side};
    switch (patches.At(patch).kind) {
        case PatchKind::Regular:
        case PatchKind::Bilinear:
            EvaluateLimitGrid(GatherBezier(patches, patch, patchPoints), square);
            break;
        case PatchKind::Extraordinary: {
            const ExtraordinaryPatch gathered = GatherExtraordinary(patches, patch, patchPoints);
            EvaluateNear(gathered.LimitPosition(), gathered, square, count, EvaluateLimitGrid);
            break;
        }
        case PatchKind::Irregular: {
            const IrregularPatch gathered = GatherIrregular(patches, patch, patchPoints);
            EvaluateNear(gathered.rings[0].center, gathered, square, count, EvaluateLimitGrid);
            break;
        }
        case PatchKind::RegularTriangle:
            EvaluateLimitLattice(GatherBezierTriangle(patches, patch, patchPoints), lattice);
            break;
        case PatchKind::IrregularTriangle: {
            const IrregularTriangle gathered = GatherIrregularTriangle(patches, patch, patchPoints);
            EvaluateNear(gathered.rings[0].center, gathered, lattice, count, EvaluateLimitLattice);
            break;
        }
        case PatchKind::FlatTriangle:
            for (int i = 0; i < 3; ++i) {
                points[i] = patchPoints[patches.Indices(patch)[i]];
            }
            break;
    }
    float largest = 0;
    for (size_t i = 0; i < count; ++i) {
        const Vec3f& p = points[i];
        largest = std::max({largest, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
    }
    grid.tolerance = 2.5e-7f * largest;
}

Box3f Tessellation::_BlockBox(const Block& block) const {
    const Grid& grid = _grids[block.patch];
    const int step = BlockSide(grid);
    Box3f box;
    for (int row = block.row; row <= block.row + step; ++row) {
        const int end = std::min(block.column + step + 1, grid.RowSize(row));
        for (int column = block.column; column < end; ++column) {
            box.Extend(PointAt(grid, column, row));
        }
    }
    const Vec3f margin{grid.tolerance, grid.tolerance, grid.tolerance};
    box.lower = box.lower - margin;
    box.upper = box.upper + margin;
    return box;
}

size_t Tessellation::Bytes() const {
    return _grids.capacity() * sizeof(Grid) + _points.capacity() * sizeof(Vec3f) +
           _blocks.capacity() * sizeof(Block) + _bvh.Bytes();
}

}  // namespace cc
