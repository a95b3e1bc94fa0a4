// Per-target include guard, as Highway's foreach_target asks for.
#if defined(CC_TRACE_BEZIER_ROWS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CC_TRACE_BEZIER_ROWS_INL_H
#undef CC_TRACE_BEZIER_ROWS_INL_H
#else
#define CC_TRACE_BEZIER_ROWS_INL_H
#endif

#include <algorithm>

#include <hwy/highway.h>

#include "core/math/box.h"
#include "core/subdiv/patchTable.h"
#include "core/trace/bezierRows.h"

HWY_BEFORE_NAMESPACE();
namespace cc {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Four floats at a time, a stride apart, side by side in one vector. Vectors that are read soon
/// are put together in registers: a load that spans several stores waits for all of them.
template <class D>
HWY_INLINE hn::Vec<D> LoadFours(D d, const float* from, size_t stride) {
    if constexpr (hn::MaxLanes(D()) <= 4) {
        return hn::LoadU(d, from);
    } else {
        const hn::Half<D> half;
        const float* upper = from + hn::MaxLanes(half) / 4 * stride;
        return hn::Combine(d, LoadFours(half, upper, stride), LoadFours(half, from, stride));
    }
}

/// Weights that turn the 16 points of a uniform bicubic B-spline into the 16 of a Bezier patch,
/// times 36: whole numbers. Where outer points are extrapolated as 2a - b, a and b have their
/// weights: what is stored of them is rounded, on either side of a crease in its own way.
struct BezierConversion {
    alignas(64) double weights[16][16];  ///< [B-spline point][Bezier point]

    constexpr explicit BezierConversion(int sides) : weights() {
        double rows[4][4] = {}, columns[4][4] = {};
        _SetCurve((sides & kLowRow) != 0, (sides & kHighRow) != 0, rows);
        _SetCurve((sides & kLowColumn) != 0, (sides & kHighColumn) != 0, columns);
        for (int from = 0; from < 16; ++from) {
            for (int to = 0; to < 16; ++to) {
                weights[from][to] = rows[to / 4][from / 4] * columns[to % 4][from % 4];
            }
        }
    }

  private:
    static constexpr void _SetCurve(bool isLow, bool isHigh, double curve[4][4]) {
        constexpr double kCurve[4][4] = {{1, 4, 1, 0}, {0, 4, 2, 0}, {0, 2, 4, 0}, {0, 1, 4, 1}};
        for (int to = 0; to < 4; ++to) {
            const double low = isLow ? kCurve[to][0] : 0, high = isHigh ? kCurve[to][3] : 0;
            curve[to][0] = kCurve[to][0] - low;
            curve[to][1] = kCurve[to][1] + 2 * low - high;
            curve[to][2] = kCurve[to][2] - low + 2 * high;
            curve[to][3] = kCurve[to][3] - high;
        }
    }
};
/// By Patch::extrapolatedSides.
inline constexpr BezierConversion kBezierConversions[16] = {
    BezierConversion(0),  BezierConversion(1),  BezierConversion(2),  BezierConversion(3),
    BezierConversion(4),  BezierConversion(5),  BezierConversion(6),  BezierConversion(7),
    BezierConversion(8),  BezierConversion(9),  BezierConversion(10), BezierConversion(11),
    BezierConversion(12), BezierConversion(13), BezierConversion(14), BezierConversion(15)};

/// Gathers the Bezier form of a regular patch. Whole multiples of points on a lattice (Surface) add
/// up without rounding, so that patches that share an edge, be it a crease, round the same sums
/// once.
/// @param points  of the patch table
HWY_INLINE void GatherRegular(const PatchTable& patches, uint32_t patch, const Vec3f* points,
                              BezierRows* bezier) {
    const hn::CappedTag<double, 8> d;
    const hn::Rebind<float, decltype(d)> df;
    const uint32_t* const indices = patches.Indices(patch);
    const BezierConversion& conversion = kBezierConversions[patches.At(patch).extrapolatedSides];
    alignas(64) float coordinates[4][16] = {};
    // So many vectors of sums share what is loaded of a point.
    constexpr size_t kVectors = 2;
    for (size_t lane = 0; lane < 16; lane += kVectors * hn::Lanes(d)) {
        hn::Vec<decltype(d)> sums[3][kVectors];
        for (auto& axis : sums) {
            std::fill(axis, axis + kVectors, hn::Zero(d));
        }
        for (int i = 0; i < 16; ++i) {
            const Vec3f& p = points[indices[i]];
            const auto x = hn::Set(d, static_cast<double>(p.x)),
                       y = hn::Set(d, static_cast<double>(p.y)),
                       z = hn::Set(d, static_cast<double>(p.z));
            for (size_t k = 0; k < kVectors; ++k) {
                const auto weight = hn::Load(d, conversion.weights[i] + lane + k * hn::Lanes(d));
                sums[0][k] = hn::MulAdd(weight, x, sums[0][k]);
                sums[1][k] = hn::MulAdd(weight, y, sums[1][k]);
                sums[2][k] = hn::MulAdd(weight, z, sums[2][k]);
            }
        }
        const auto scale = hn::Set(d, 1 / 36.0);
        for (size_t k = 0; k < kVectors; ++k) {
            for (int axis = 0; axis < 3; ++axis) {
                hn::Store(hn::DemoteTo(df, hn::Mul(sums[axis][k], scale)), df,
                          coordinates[axis] + lane + k * hn::Lanes(d));
            }
        }
    }
    const hn::CappedTag<float, 16> rows;
    for (int row = 0; row < 4; ++row) {
        for (size_t lane = 0; lane < 16; lane += hn::Lanes(rows)) {
            hn::Store(LoadFours(rows, coordinates[lane / 4] + 4 * row, 16), rows,
                      bezier->rows[row] + lane);
        }
    }
}

using RowTag = hn::CappedTag<float, 16>;
using RowVector = hn::Vec<RowTag>;

/// De Casteljau at the middle, between rows: both halves of a part of the lanes.
struct SplitRowsResult {
    RowVector low[4], high[4];
};
HWY_INLINE SplitRowsResult SplitRows(RowVector r0, RowVector r1, RowVector r2, RowVector r3) {
    const RowVector half = hn::Set(RowTag(), 0.5f);
    const RowVector ab = hn::Mul(hn::Add(r0, r1), half);
    const RowVector bc = hn::Mul(hn::Add(r1, r2), half);
    const RowVector cd = hn::Mul(hn::Add(r2, r3), half);
    const RowVector abc = hn::Mul(hn::Add(ab, bc), half);
    const RowVector bcd = hn::Mul(hn::Add(bc, cd), half);
    const RowVector middle = hn::Mul(hn::Add(abc, bcd), half);
    return {{r0, ab, abc, middle}, {middle, bcd, cd, r3}};
}

/// Exchanges rows and columns of the 4x4 block of every coordinate.
HWY_INLINE void TransposeRows(RowVector r[4]) {
    const RowTag d;
    const RowVector lower02 = hn::InterleaveLower(d, r[0], r[2]);
    const RowVector upper02 = hn::InterleaveUpper(d, r[0], r[2]);
    const RowVector lower13 = hn::InterleaveLower(d, r[1], r[3]);
    const RowVector upper13 = hn::InterleaveUpper(d, r[1], r[3]);
    r[0] = hn::InterleaveLower(d, lower02, lower13);
    r[1] = hn::InterleaveUpper(d, lower02, lower13);
    r[2] = hn::InterleaveLower(d, upper02, upper13);
    r[3] = hn::InterleaveUpper(d, upper02, upper13);
}

/// Splits a patch in both directions. Quarter 2a + b is half a of the rows and half b of the
/// columns. The quarters come out transposed: their rows run where the columns of the patch ran,
/// which saves a transposition, and two splits restore the order.
HWY_INLINE void SplitPatch(const BezierRows& patch, BezierRows quarters[4]) {
    const RowTag d;
    for (size_t lane = 0; lane < 16; lane += hn::Lanes(d)) {
        SplitRowsResult halves =
            SplitRows(hn::Load(d, patch.rows[0] + lane), hn::Load(d, patch.rows[1] + lane),
                      hn::Load(d, patch.rows[2] + lane), hn::Load(d, patch.rows[3] + lane));
        for (int half = 0; half < 2; ++half) {
            RowVector* rows = half == 0 ? halves.low : halves.high;
            TransposeRows(rows);
            const SplitRowsResult split = SplitRows(rows[0], rows[1], rows[2], rows[3]);
            for (int r = 0; r < 4; ++r) {
                hn::Store(split.low[r], d, quarters[2 * half].rows[r] + lane);
                hn::Store(split.high[r], d, quarters[2 * half + 1].rows[r] + lane);
            }
        }
    }
}

/// The box of the control points: it holds the patch (convex hull property).
HWY_INLINE Box3f HullBox(const BezierRows& patch) {
    const RowTag d;
    alignas(64) float lower[16], upper[16];
    for (size_t lane = 0; lane < 16; lane += hn::Lanes(d)) {
        const RowVector r0 = hn::Load(d, patch.rows[0] + lane);
        const RowVector r1 = hn::Load(d, patch.rows[1] + lane);
        const RowVector r2 = hn::Load(d, patch.rows[2] + lane);
        const RowVector r3 = hn::Load(d, patch.rows[3] + lane);
        RowVector low = hn::Min(hn::Min(r0, r1), hn::Min(r2, r3));
        RowVector high = hn::Max(hn::Max(r0, r1), hn::Max(r2, r3));
        low = hn::Min(low, hn::Shuffle2301(low));
        high = hn::Max(high, hn::Shuffle2301(high));
        low = hn::Min(low, hn::Shuffle1032(low));
        high = hn::Max(high, hn::Shuffle1032(high));
        hn::Store(low, d, lower + lane);
        hn::Store(high, d, upper + lane);
    }
    Box3f box;
    box.lower = {lower[0], lower[4], lower[8]};
    box.upper = {upper[0], upper[4], upper[8]};
    return box;
}

}  // namespace HWY_NAMESPACE
}  // namespace cc
HWY_AFTER_NAMESPACE();

#endif
