#include "core/trace/tessellation.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include <tbb/parallel_for.h>

#include "core/subdiv/bezierPatch.h"
#include "core/subdiv/limitPoint.h"

namespace cc {

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

/// Decides where everything goes.
void Tessellation::_LayOut(const PatchTable& patches) {
    _grids.resize(patches.Count());
    size_t pointCount = 0, blockCount = 0;
    for (uint32_t patch = 0; patch < patches.Count(); ++patch) {
        const Patch& p = patches.At(patch);
        const int side = p.kind == PatchKind::FlatTriangle ? 1 : 1 << (_level - p.depth);
        _grids[patch] = {pointCount, side, 0, patches.IsTriangle(patch)};
        pointCount += _grids[patch].PointCount();
        const size_t blocks = side / BlockSide(_grids[patch]);
        blockCount += patches.IsTriangle(patch) ? blocks * (blocks + 1) / 2 : blocks * blocks;
    }
    if (blockCount >= kBvhLeaf) {
        throw std::length_error("a surface has too many quads at level " + std::to_string(_level));
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
    const PatchKind kind = patches.At(patch).kind;
    // Gathered once for all points; the rest is found anew for each.
    const bool isQuad = kind == PatchKind::Regular || kind == PatchKind::Bilinear;
    const BezierPatch quad = isQuad ? GatherBezier(patches, patch, patchPoints) : BezierPatch();
    const auto evaluate = [&](float u, float v) {
        return isQuad ? quad.Position(u, v) : EvaluateLimitValue(patches, patch, patchPoints, u, v);
    };
    Vec3f* point = &_points[grid.firstPoint];
    float largest = 0;
    for (int row = 0; row <= grid.side; ++row) {
        for (int column = 0; column < grid.RowSize(row); ++column, ++point) {
            const float u = static_cast<float>(column) / static_cast<float>(grid.side);
            const float v = static_cast<float>(row) / static_cast<float>(grid.side);
            *point = evaluate(u, v);
            largest =
                std::max({largest, std::fabs(point->x), std::fabs(point->y), std::fabs(point->z)});
        }
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
