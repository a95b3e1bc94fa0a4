// Per-target include guard, as Highway's foreach_target asks for.
#if defined(CC_TRACE_LIMIT_GRID_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CC_TRACE_LIMIT_GRID_INL_H
#undef CC_TRACE_LIMIT_GRID_INL_H
#else
#define CC_TRACE_LIMIT_GRID_INL_H
#endif

#include <algorithm>

#include <hwy/highway.h>

#include "core/subdiv/cubicWeights.h"
#include "core/subdiv/limitGridPlan.h"
#include "core/trace/bezierRows-inl.h"
#include "core/trace/boxTests-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cc {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Quads along a side of a block: what one ray is tested against at once is a block's 4x4.
constexpr int kBlockSide = 4;

/// Points of the limit surface of a patch, or of a part of one, in a square grid. It lives while
/// one packet meets the patch.
struct LimitGrid {
    static constexpr int kStride = 32;

    int side;  ///< quads along each side: 1, 2, 4, 8 or 16
    /// Coordinates of the points [row along v][column along u].
    alignas(64) float points[3][kMaxGridSide + 1][kStride];

    int BlocksAlongSide() const { return std::max(side / kBlockSide, 1); }
};

using GridTag = hn::CappedTag<float, kMaxGridSide>;

/// Points of a cubic Bezier curve, one a lane, by even and odd parts: run backwards, the curve has
/// the same even part and the negative odd part, and so exactly the same points. Where two patches
/// share a curve they agree on it.
template <class D>
HWY_INLINE hn::Vec<D> CurvePoints(D d, const CubicWeights& weights, size_t lane, float first,
                                  float evenEnds, float evenInner, float oddEnds, float oddInner) {
    const auto even =
        hn::MulAdd(hn::Load(d, weights.evenInner + lane), hn::Set(d, evenInner),
                   hn::Mul(hn::Load(d, weights.evenEnds + lane), hn::Set(d, evenEnds)));
    const auto odd = hn::MulAdd(hn::Load(d, weights.oddInner + lane), hn::Set(d, oddInner),
                                hn::Mul(hn::Load(d, weights.oddEnds + lane), hn::Set(d, oddEnds)));
    const auto points = hn::Add(even, odd);
    // At parameter 0 the sum would round; the curve begins at its first control point.
    return lane == 0 ? hn::IfThenElse(hn::FirstN(d, 1), hn::Set(d, first), points) : points;
}

/// The control columns of a Bezier patch, combined for CurvePoints. Lane 4 * axis + row.
struct ColumnSums {
    alignas(64) float first[16], last[16], evenEnds[16], evenInner[16], oddEnds[16], oddInner[16];

    HWY_INLINE explicit ColumnSums(const BezierRows& patch) {
        const RowTag d;
        for (size_t lane = 0; lane < 16; lane += hn::Lanes(d)) {
            RowVector c[4] = {hn::Load(d, patch.rows[0] + lane), hn::Load(d, patch.rows[1] + lane),
                              hn::Load(d, patch.rows[2] + lane), hn::Load(d, patch.rows[3] + lane)};
            TransposeRows(c);
            hn::Store(c[0], d, first + lane);
            hn::Store(c[3], d, last + lane);
            hn::Store(hn::Add(c[0], c[3]), d, evenEnds + lane);
            hn::Store(hn::Add(c[1], c[2]), d, evenInner + lane);
            hn::Store(hn::Sub(c[3], c[0]), d, oddEnds + lane);
            hn::Store(hn::Sub(c[2], c[1]), d, oddInner + lane);
        }
    }

    template <class D>
    HWY_INLINE hn::Vec<D> Points(D d, const CubicWeights& weights, size_t lane, int i) const {
        return CurvePoints(d, weights, lane, first[i], evenEnds[i], evenInner[i], oddEnds[i],
                           oddInner[i]);
    }
};

/// What rounding may put between a grid's points and the bounds of their block, in units of the
/// largest coordinate.
constexpr float kRoundingMargin = 4e-7f;

/// Joins the boxes of 4x4 blocks to those of fewer, larger ones.
inline void MergeBlocks(int blocks, WideBoxes* boxes) {
    const WideBoxes small = *boxes;
    const int size = kBlockSide / blocks;
    boxes->count = blocks * blocks;
    for (int axis = 0; axis < 3; ++axis) {
        for (int block = 0; block < boxes->count; ++block) {
            const int first = kBlockSide * size * (block / blocks) + size * (block % blocks);
            float lower = small.lower[axis][first], upper = small.upper[axis][first];
            for (int i = 1; i < size * size; ++i) {
                const int other = first + kBlockSide * (i / size) + i % size;
                lower = std::min(lower, small.lower[axis][other]);
                upper = std::max(upper, small.upper[axis][other]);
            }
            boxes->lower[axis][block] = lower;
            boxes->upper[axis][block] = upper;
        }
    }
}

/// Evaluates the limit grid of a bicubic patch on demand: first the boxes of its blocks, then only
/// those rows of blocks that rays reach.
class BezierGrid {
  public:
    BezierGrid(const BezierRows& patch, int splits, LimitGrid* grid)
        : _patch(patch), _columns(patch), _splits(splits), _grid(*grid) {
        grid->side = 1 << splits;
    }

    /// Boxes of all blocks, row by row, from the corners of the blocks: between them the surface
    /// keeps to the bilinear patch of the corners within h^2 / 8 times the second derivatives along
    /// u and v, where h is a block's side.
    void MeasureBlocks(WideBoxes* boxes) const;

    /// Evaluates the points of a row of blocks, if they are not there yet.
    HWY_INLINE void Require(int blockRow) {
        if (_rowsDone == 0) {
            _EvaluateCurves();
        }
        if ((_rowsDone >> blockRow & 1) == 0) {
            _rowsDone |= 1u << blockRow;
            _EvaluateRows(kBlockSide * blockRow, std::min(kBlockSide * (blockRow + 1), _grid.side));
        }
    }

  private:
    void _EvaluateCurves();
    void _EvaluateRows(int first, int last);

    const BezierRows& _patch;
    const ColumnSums _columns;
    const int _splits;
    LimitGrid& _grid;
    uint32_t _rowsDone = 0;
    /// The curves of the four control rows at the grid's columns, combined for sums along v.
    alignas(64) float _first[3][kMaxGridSide], _last[3][kMaxGridSide];
    alignas(64) float _evenEnds[3][kMaxGridSide], _evenInner[3][kMaxGridSide];
    alignas(64) float _oddEnds[3][kMaxGridSide], _oddInner[3][kMaxGridSide];
    /// The curve at the last column.
    alignas(64) float _lastColumn[3][kMaxGridSide];
};

inline void BezierGrid::_EvaluateCurves() {
    const GridTag d;
    const CubicWeights& weights = kCubicWeights[_splits];
    for (int axis = 0; axis < 3; ++axis) {
        const float* c = _columns.last + 4 * axis;
        for (size_t lane = 0; lane < static_cast<size_t>(_grid.side); lane += hn::Lanes(d)) {
            const auto r0 = _columns.Points(d, weights, lane, 4 * axis);
            const auto r1 = _columns.Points(d, weights, lane, 4 * axis + 1);
            const auto r2 = _columns.Points(d, weights, lane, 4 * axis + 2);
            const auto r3 = _columns.Points(d, weights, lane, 4 * axis + 3);
            hn::Store(r0, d, _first[axis] + lane);
            hn::Store(r3, d, _last[axis] + lane);
            hn::Store(hn::Add(r0, r3), d, _evenEnds[axis] + lane);
            hn::Store(hn::Add(r1, r2), d, _evenInner[axis] + lane);
            hn::Store(hn::Sub(r3, r0), d, _oddEnds[axis] + lane);
            hn::Store(hn::Sub(r2, r1), d, _oddInner[axis] + lane);
            hn::Store(CurvePoints(d, weights, lane, c[0], c[0] + c[3], c[1] + c[2], c[3] - c[0],
                                  c[2] - c[1]),
                      d, _lastColumn[axis] + lane);
        }
    }
}

inline void BezierGrid::_EvaluateRows(int first, int last) {
    const GridTag d;
    const CubicWeights& weights = kCubicWeights[_splits];
    const int side = _grid.side;
    for (int axis = 0; axis < 3; ++axis) {
        auto& points = _grid.points[axis];
        for (size_t lane = 0; lane < static_cast<size_t>(side); lane += hn::Lanes(d)) {
            const auto evenEnds = hn::Load(d, _evenEnds[axis] + lane);
            const auto evenInner = hn::Load(d, _evenInner[axis] + lane);
            const auto oddEnds = hn::Load(d, _oddEnds[axis] + lane);
            const auto oddInner = hn::Load(d, _oddInner[axis] + lane);
            for (int row = std::max(first, 1); row <= std::min(last, side - 1); ++row) {
                const auto even = hn::MulAdd(hn::Set(d, weights.evenInner[row]), evenInner,
                                             hn::Mul(hn::Set(d, weights.evenEnds[row]), evenEnds));
                const auto odd = hn::MulAdd(hn::Set(d, weights.oddInner[row]), oddInner,
                                            hn::Mul(hn::Set(d, weights.oddEnds[row]), oddEnds));
                hn::Store(hn::Add(even, odd), d, points[row] + lane);
            }
            if (first == 0) {
                hn::Store(hn::Load(d, _first[axis] + lane), d, points[0] + lane);
            }
            if (last == side) {
                hn::Store(hn::Load(d, _last[axis] + lane), d, points[side] + lane);
            }
        }
        for (int row = first; row <= std::min(last, side - 1); ++row) {
            points[row][side] = _lastColumn[axis][row];
        }
        if (last == side) {
            points[side][side] = _columns.last[4 * axis + 3];
        }
    }
}

/// Points of cubic curves at parameters 0, 1/4, 1/2, 3/4 and 1.
HWY_INLINE void QuarterPoints(const RowVector c[4], RowVector out[5]) {
    const RowTag d;
    const CubicWeights& w = kCubicWeights[2];
    const RowVector evenEnds = hn::Add(c[0], c[3]), evenInner = hn::Add(c[1], c[2]);
    const RowVector even = hn::MulAdd(hn::Set(d, w.evenInner[1]), evenInner,
                                      hn::Mul(hn::Set(d, w.evenEnds[1]), evenEnds));
    const RowVector odd = hn::MulAdd(hn::Set(d, w.oddInner[1]), hn::Sub(c[2], c[1]),
                                     hn::Mul(hn::Set(d, w.oddEnds[1]), hn::Sub(c[3], c[0])));
    out[0] = c[0];
    out[1] = hn::Add(even, odd);
    out[2] = hn::MulAdd(hn::Set(d, w.evenInner[2]), evenInner,
                        hn::Mul(hn::Set(d, w.evenEnds[2]), evenEnds));
    out[3] = hn::Sub(even, odd);
    out[4] = c[3];
}

/// The largest second difference of four curves side by side, for each group of four lanes.
HWY_INLINE RowVector LargestSecondDifference(const RowVector c[4]) {
    const RowTag d;
    const RowVector two = hn::Set(d, 2.0f);
    RowVector largest = hn::Max(hn::Abs(hn::NegMulAdd(two, c[1], hn::Add(c[0], c[2]))),
                                hn::Abs(hn::NegMulAdd(two, c[2], hn::Add(c[1], c[3]))));
    largest = hn::Max(largest, hn::Shuffle2301(largest));
    return hn::Max(largest, hn::Shuffle1032(largest));
}

inline void BezierGrid::MeasureBlocks(WideBoxes* boxes) const {
    const RowTag d;
    // Lanes are axis and block column. A cubic's second derivative is six times its differences.
    constexpr float kMargin = 6.0f / 8 / (kBlockSide * kBlockSide);
    alignas(64) float lower[kBlockSide][16], upper[kBlockSide][16];
    for (size_t lane = 0; lane < 16; lane += hn::Lanes(d)) {
        RowVector rows[4], columns[4];
        for (int i = 0; i < 4; ++i) {
            columns[i] = rows[i] = hn::Load(d, _patch.rows[i] + lane);
        }
        TransposeRows(columns);
        const RowVector sagitta =
            hn::Add(LargestSecondDifference(rows), LargestSecondDifference(columns));
        RowVector largest = hn::Max(hn::Max(hn::Abs(rows[0]), hn::Abs(rows[1])),
                                    hn::Max(hn::Abs(rows[2]), hn::Abs(rows[3])));
        largest = hn::Max(largest, hn::Shuffle2301(largest));
        largest = hn::Max(largest, hn::Shuffle1032(largest));
        const RowVector margin =
            hn::MulAdd(hn::Set(d, kMargin), sagitta, hn::Mul(hn::Set(d, kRoundingMargin), largest));
        RowVector along[5], left[5], right[5];
        QuarterPoints(columns, along);
        RowVector firstFour[4] = {along[0], along[1], along[2], along[3]};
        RowVector lastFour[4] = {along[1], along[2], along[3], along[4]};
        TransposeRows(firstFour);
        TransposeRows(lastFour);
        QuarterPoints(firstFour, left);
        QuarterPoints(lastFour, right);
        for (int i = 0; i < kBlockSide; ++i) {
            const RowVector low =
                hn::Min(hn::Min(left[i], right[i]), hn::Min(left[i + 1], right[i + 1]));
            const RowVector high =
                hn::Max(hn::Max(left[i], right[i]), hn::Max(left[i + 1], right[i + 1]));
            hn::Store(hn::Sub(low, margin), d, lower[i] + lane);
            hn::Store(hn::Add(high, margin), d, upper[i] + lane);
        }
    }
    boxes->count = kBlockSide * kBlockSide;
    for (int axis = 0; axis < 3; ++axis) {
        for (size_t lane = 0; lane < 16; lane += hn::Lanes(d)) {
            hn::Store(LoadFours(d, lower[lane / 4] + 4 * axis, 16), d, boxes->lower[axis] + lane);
            hn::Store(LoadFours(d, upper[lane / 4] + 4 * axis, 16), d, boxes->upper[axis] + lane);
        }
    }
    if (_grid.BlocksAlongSide() < kBlockSide) {
        MergeBlocks(_grid.BlocksAlongSide(), boxes);
    }
}

/// Evaluates a patch by its plan. Sums run relative to the first point, so that they keep their
/// precision far from the origin.
/// @param base      the first control point
/// @param relative  the control points that the plan picks, relative to it, [axis][pick]
inline void EvaluateGrid(const LimitGridPlan& plan, const Vec3f& base,
                         const float* const relative[3], int splits, LimitGrid* grid) {
    const GridTag d;
    // So many vectors of points share what is loaded of the control points.
    constexpr size_t kVectors = 4;
    const size_t lanes = hn::Lanes(d), count = plan.Picks().size();
    alignas(64) float points[3][LimitGridPlan::kWeightCount];
    for (size_t at = 0; at < LimitGridPlan::kWeightCount; at += kVectors * lanes) {
        hn::Vec<GridTag> sums[3][kVectors];
        for (auto& axis : sums) {
            std::fill(axis, axis + kVectors, hn::Zero(d));
        }
        for (size_t i = 1; i < count; ++i) {
            const auto x = hn::Set(d, relative[0][i]), y = hn::Set(d, relative[1][i]),
                       z = hn::Set(d, relative[2][i]);
            for (size_t k = 0; k < kVectors; ++k) {
                const auto weight = hn::LoadU(d, plan.Weights(i) + at + k * lanes);
                sums[0][k] = hn::MulAdd(weight, x, sums[0][k]);
                sums[1][k] = hn::MulAdd(weight, y, sums[1][k]);
                sums[2][k] = hn::MulAdd(weight, z, sums[2][k]);
            }
        }
        for (size_t k = 0; k < kVectors; ++k) {
            for (int axis = 0; axis < 3; ++axis) {
                hn::Store(hn::Add(sums[axis][k], hn::Set(d, base[axis])), d,
                          points[axis] + at + k * lanes);
            }
        }
    }
    const int side = grid->side = 1 << splits, step = kMaxGridSide / side;
    for (int axis = 0; axis < 3; ++axis) {
        for (int row = 0; row <= side; ++row) {
            const float* from = points[axis] + kMaxGridSide * step * row;
            float* to = grid->points[axis][row];
            if (step == 1) {
                std::copy(from, from + kMaxGridSide, to);
            } else {
                for (int column = 0; column < side; ++column) {
                    to[column] = from[step * column];
                }
            }
            to[side] = points[axis][kMaxGridSide * (kMaxGridSide + 1) + step * row];
        }
    }
}

/// The boxes of a row of blocks along one axis, one bound of them: the least (or greatest, by
/// Least) of each block's points. Takes the bounds of the columns.
template <class Bound>
HWY_INLINE void BoundBlocks(const LimitGrid& grid, int axis, const Bound& bound, float* out) {
    const hn::CappedTag<float, 16> d;
    const int blocks = grid.BlocksAlongSide(), rows = std::min(grid.side, kBlockSide);
    for (int block = 0; block < blocks; ++block) {
        const auto& points = grid.points[axis];
        alignas(64) float columns[LimitGrid::kStride];
        const int first = kBlockSide * block;
        for (int lane = 0; lane <= grid.side; lane += static_cast<int>(hn::Lanes(d))) {
            auto v = hn::Load(d, points[first] + lane);
            for (int row = 1; row <= rows; ++row) {
                v = bound(v, hn::Load(d, points[first + row] + lane));
            }
            hn::Store(v, d, columns + lane);
        }
        for (int other = 0; other < blocks; ++other) {
            const hn::FixedTag<float, 1> d1;
            auto v = hn::Load(d1, columns + kBlockSide * other);
            for (int column = 1; column <= rows; ++column) {
                v = bound(v, hn::Load(d1, columns + kBlockSide * other + column));
            }
            out[block * blocks + other] = hn::GetLane(v);
        }
    }
}

/// The boxes of all blocks, row by row, widened by a margin.
HWY_INLINE void MeasureBlocks(const LimitGrid& grid, float margin, WideBoxes* boxes) {
    boxes->count = grid.BlocksAlongSide() * grid.BlocksAlongSide();
    for (int axis = 0; axis < 3; ++axis) {
        BoundBlocks(grid, axis, [](auto a, auto b) { return hn::Min(a, b); }, boxes->lower[axis]);
        BoundBlocks(grid, axis, [](auto a, auto b) { return hn::Max(a, b); }, boxes->upper[axis]);
        for (int i = 0; i < boxes->count; ++i) {
            boxes->lower[axis][i] -= margin;
            boxes->upper[axis][i] += margin;
        }
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace cc
HWY_AFTER_NAMESPACE();

#endif
