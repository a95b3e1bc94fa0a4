// Per-target include guard, as Highway's foreach_target asks for.
#if defined(CC_TRACE_BEZIER_ROWS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CC_TRACE_BEZIER_ROWS_INL_H
#undef CC_TRACE_BEZIER_ROWS_INL_H
#else
#define CC_TRACE_BEZIER_ROWS_INL_H
#endif

#include <array>

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
/// times 36: whole numbers.
struct BezierConversion {
    alignas(64) double weights[16][16];  ///< [B-spline point][Bezier point]

    constexpr BezierConversion() : weights() {
        constexpr int kCurve[4][4] = {{1, 4, 1, 0}, {0, 4, 2, 0}, {0, 2, 4, 0}, {0, 1, 4, 1}};
        for (int from = 0; from < 16; ++from) {
            for (int to = 0; to < 16; ++to) {
                const int row = to / 4, column = to % 4;
                const int fromRow = from / 4, fromColumn = from % 4;
                weights[from][to] = kCurve[row][fromRow] * kCurve[column][fromColumn];
            }
        }
    }
};
inline constexpr BezierConversion kBezierConversion;

/// Makes the Bezier form of a bicubic B-spline. Whole multiples of points on a lattice (Surface)
/// add up without rounding, so that patches that share an edge round the same sums once.
/// @param point  returns the coordinates of point 0..15
template <class Point>
HWY_INLINE void ConvertBSpline(const Point& point, BezierRows* patch) {
    const hn::CappedTag<double, 8> d;
    const hn::Rebind<float, decltype(d)> df;
    alignas(64) float bezier[4][16] = {};
    for (size_t lane = 0; lane < 16; lane += hn::Lanes(d)) {
        auto x = hn::Zero(d), y = x, z = x;
        for (int i = 0; i < 16; ++i) {
            const auto& p = point(i);
            const auto weight = hn::Load(d, kBezierConversion.weights[i] + lane);
            x = hn::MulAdd(weight, hn::Set(d, static_cast<double>(p[0])), x);
            y = hn::MulAdd(weight, hn::Set(d, static_cast<double>(p[1])), y);
            z = hn::MulAdd(weight, hn::Set(d, static_cast<double>(p[2])), z);
        }
        const auto scale = hn::Set(d, 1 / 36.0);
        hn::Store(hn::DemoteTo(df, hn::Mul(x, scale)), df, bezier[0] + lane);
        hn::Store(hn::DemoteTo(df, hn::Mul(y, scale)), df, bezier[1] + lane);
        hn::Store(hn::DemoteTo(df, hn::Mul(z, scale)), df, bezier[2] + lane);
    }
    const hn::CappedTag<float, 16> rows;
    for (int row = 0; row < 4; ++row) {
        for (size_t lane = 0; lane < 16; lane += hn::Lanes(rows)) {
            hn::Store(LoadFours(rows, bezier[lane / 4] + 4 * row, 16), rows,
                      patch->rows[row] + lane);
        }
    }
}

/// Gathers the Bezier form of a regular patch: to the bit the same on both sides of an edge between
/// two of them, be it a crease.
/// @param points  of the patch table
HWY_INLINE void GatherRegular(const PatchTable& patches, uint32_t patch, const Vec3f* points,
                              BezierRows* bezier) {
    const uint32_t* const indices = patches.Indices(patch);
    if (!patches.At(patch).isExtrapolated) {
        ConvertBSpline([&](int i) -> const Vec3f& { return points[indices[i]]; }, bezier);
        return;
    }
    std::array<double, 3> exact[16];
    for (int i = 0; i < 16; ++i) {
        exact[i] = patches.ExactPoint(points, indices[i]);
    }
    ConvertBSpline([&](int i) -> const std::array<double, 3>& { return exact[i]; }, bezier);
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
