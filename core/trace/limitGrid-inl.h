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
#include "core/trace/limitGrid.h"

HWY_BEFORE_NAMESPACE();
namespace cc {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using GridTag = hn::CappedTag<float, 16>;

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

/// The control points of the curve that a row of a grid runs along, as a row of BezierRows.
HWY_INLINE void EvaluateCurve(const BezierRows& patch, int row, int side, const CubicWeights& w,
                              float curve[16]) {
    const RowTag d;
    for (size_t lane = 0; lane < 16; lane += hn::Lanes(d)) {
        const RowVector a = hn::Load(d, patch.rows[0] + lane),
                        b = hn::Load(d, patch.rows[1] + lane),
                        c = hn::Load(d, patch.rows[2] + lane),
                        e = hn::Load(d, patch.rows[3] + lane);
        if (row == 0 || row >= side) {
            hn::Store(row == 0 ? a : e, d, curve + lane);
            continue;
        }
        // To the bit as in CurvePoints: this curve begins where the patch next to it, whose row
        // runs along the border, has a point.
        const RowVector even = hn::MulAdd(hn::Set(d, w.evenInner[row]), hn::Add(b, c),
                                          hn::Mul(hn::Set(d, w.evenEnds[row]), hn::Add(a, e)));
        const RowVector odd = hn::MulAdd(hn::Set(d, w.oddInner[row]), hn::Sub(c, b),
                                         hn::Mul(hn::Set(d, w.oddEnds[row]), hn::Sub(e, a)));
        hn::Store(hn::Add(even, odd), d, curve + lane);
    }
}

/// Evaluates a row of points of a Bezier patch. Beyond the last row it repeats that.
HWY_INLINE void EvaluateRow(const BezierRows& patch, int splits, int row, LimitGrid* grid) {
    const GridTag d;
    const CubicWeights& weights = kCubicWeights[splits];
    alignas(64) float curve[16];
    EvaluateCurve(patch, row, grid->side, weights, curve);
    for (int axis = 0; axis < 3; ++axis) {
        const float* c = curve + 4 * axis;
        float* points = grid->points[axis][row];
        for (size_t lane = 0; lane < static_cast<size_t>(grid->side); lane += hn::Lanes(d)) {
            hn::StoreU(CurvePoints(d, weights, lane, c[0], c[0] + c[3], c[1] + c[2], c[3] - c[0],
                                   c[2] - c[1]),
                       d, points + lane);
        }
        points[grid->side] = c[3];
    }
    if (grid->side < LimitGrid::kLeastColumns) {
        grid->FillRow(row);
    }
}

/// Evaluates a patch by its plan. Sums run relative to the first point, so that they keep their
/// precision far from the origin.
/// @param splits    0..kPlanSplits
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
    const int side = grid->side = 1 << splits, step = kPlanSide / side;
    for (int axis = 0; axis < 3; ++axis) {
        for (int row = 0; row <= side; ++row) {
            const float* from = points[axis] + kPlanSide * step * row;
            float* to = grid->points[axis][row];
            if (step == 1) {
                std::copy(from, from + kPlanSide, to);
            } else {
                for (int column = 0; column < side; ++column) {
                    to[column] = from[step * column];
                }
            }
            to[side] = points[axis][kPlanSide * (kPlanSide + 1) + step * row];
        }
    }
    grid->Fill();
}

}  // namespace HWY_NAMESPACE
}  // namespace cc
HWY_AFTER_NAMESPACE();

#endif
