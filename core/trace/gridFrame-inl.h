// Per-target include guard, as Highway's foreach_target asks for.
#if defined(CC_TRACE_GRID_FRAME_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CC_TRACE_GRID_FRAME_INL_H
#undef CC_TRACE_GRID_FRAME_INL_H
#else
#define CC_TRACE_GRID_FRAME_INL_H
#endif

#include <algorithm>
#include <limits>

#include <hwy/highway.h>

#include "core/trace/bezierRows-inl.h"
#include "core/trace/boxTests-inl.h"
#include "core/trace/gridFrame.h"
#include "core/trace/limitGrid-inl.h"
#include "core/trace/objectRays.h"

HWY_BEFORE_NAMESPACE();
namespace cc {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Where points are in a frame.
template <class V>
struct Places {
    V at[3];

    HWY_INLINE Places(const GridFrame& frame, V x, V y, V z) {
        const hn::DFromV<V> d;
        x = hn::Sub(x, hn::Set(d, frame.base.x));
        y = hn::Sub(y, hn::Set(d, frame.base.y));
        z = hn::Sub(z, hn::Set(d, frame.base.z));
        for (int k = 0; k < 3; ++k) {
            at[k] = Along(frame.axes[k], x, y, z);
        }
    }
    /// A coordinate of vectors.
    static HWY_INLINE V Along(const Vec3f& axis, V x, V y, V z) {
        const hn::DFromV<V> d;
        return hn::MulAdd(hn::Set(d, axis.x), x,
                          hn::MulAdd(hn::Set(d, axis.y), y, hn::Mul(hn::Set(d, axis.z), z)));
    }
};

/// The quadratic surface nearest to 16 Bezier control values, and the control values of its terms.
/// Along a row, half the second derivative of the parabola nearest to a cubic a, b, c, d is
/// 3/2 (a - b - c + d); on average over four rows. Degree elevation of c (c - 1) is exact.
struct QuadraticTables {
    enum Term { kColumns, kRows, kTwist, kCubicColumns, kCubicRows, kTermCount };
    /// The greatest value of x (1 - x) (1 - 2x), a third of what its control values say.
    static constexpr float kGreatestCubic = 0.0962251f;
    alignas(64) float fit[kTermCount][16];     ///< sums of these times values are a bend
    alignas(64) float values[kTermCount][16];  ///< control values of a unit bend, on a unit square
    alignas(64) float places[3][16];  ///< control values of an even and flat patch, on the same

    constexpr QuadraticTables() : fit(), values(), places() {
        constexpr float kFit[4] = {0.375f, -0.375f, -0.375f, 0.375f};
        constexpr float kParabola[4] = {0, -1.0f / 3, -1.0f / 3, 0};
        constexpr float kFitCubic[4] = {-0.125f, 0.375f, -0.375f, 0.125f};
        constexpr float kCubic[4] = {0, 1.0f / 3, -1.0f / 3, 0};
        for (int i = 0; i < 16; ++i) {
            const int row = i / 4, column = i % 4;
            fit[kColumns][i] = kFit[column];
            fit[kRows][i] = kFit[row];
            fit[kCubicColumns][i] = kFitCubic[column];
            fit[kCubicRows][i] = kFitCubic[row];
            values[kCubicColumns][i] = kCubic[column];
            values[kCubicRows][i] = kCubic[row];
            if (row % 3 == 0 && column % 3 == 0) {
                fit[kTwist][i] = row == column ? 1.0f : -1.0f;
            }
            values[kColumns][i] = kParabola[column];
            values[kRows][i] = kParabola[row];
            places[0][i] = static_cast<float>(column) / 3;
            places[1][i] = static_cast<float>(row) / 3;
            values[kTwist][i] = (places[0][i] - 0.5f) * (places[1][i] - 0.5f);
        }
    }
};
inline constexpr QuadraticTables kQuadraticTables;

/// Measures how a Bezier patch is bent and how far it strays in the frame of its corners, by its
/// control points.
HWY_INLINE void MeasureDeviation(const BezierRows& patch, GridFrame* frame) {
    constexpr const QuadraticTables& kTables = kQuadraticTables;
    const RowTag d;
    const float side = static_cast<float>(frame->side);
    alignas(64) float off[3][16];
    RowVector sums[3][QuadraticTables::kTermCount];
    for (size_t lane = 0; lane < 16; lane += hn::Lanes(d)) {
        const float* row = patch.rows[lane / 4];
        const Places<RowVector> places(*frame, LoadFours(d, row, 16), LoadFours(d, row + 4, 16),
                                       LoadFours(d, row + 8, 16));
        for (int k = 0; k < 3; ++k) {
            const auto value = hn::NegMulAdd(hn::Load(d, kTables.places[k] + lane),
                                             hn::Set(d, side), places.at[k]);
            hn::Store(value, d, off[k] + lane);
            for (int term = 0; term < QuadraticTables::kTermCount; ++term) {
                const auto part = hn::Mul(hn::Load(d, kTables.fit[term] + lane), value);
                sums[k][term] = lane == 0 ? part : hn::Add(sums[k][term], part);
            }
        }
    }
    const float scale = 1 / (side * side);
    for (int k = 0; k < 3; ++k) {
        for (RowVector& sum : sums[k]) {
            sum = hn::SumOfLanes(d, sum);
        }
        RowVector lower, upper;
        for (size_t lane = 0; lane < 16; lane += hn::Lanes(d)) {
            auto left = hn::Load(d, off[k] + lane);
            for (int term = 0; term < QuadraticTables::kTermCount; ++term) {
                left = hn::NegMulAdd(sums[k][term], hn::Load(d, kTables.values[term] + lane), left);
            }
            lower = lane == 0 ? left : hn::Min(lower, left);
            upper = lane == 0 ? left : hn::Max(upper, left);
        }
        const float cubic = QuadraticTables::kGreatestCubic *
                            (std::fabs(hn::GetLane(sums[k][QuadraticTables::kCubicColumns])) +
                             std::fabs(hn::GetLane(sums[k][QuadraticTables::kCubicRows])));
        frame->SetDeviation(k,
                            {scale * hn::GetLane(sums[k][QuadraticTables::kColumns]),
                             scale * hn::GetLane(sums[k][QuadraticTables::kRows]),
                             scale * hn::GetLane(sums[k][QuadraticTables::kTwist])},
                            hn::GetLane(hn::MinOfLanes(d, lower)) - cubic,
                            hn::GetLane(hn::MaxOfLanes(d, upper)) + cubic);
    }
}

/// The least and greatest deviation of points from their places and a bend.
struct DeviationRange {
    using Tag = GridTag;
    using V = hn::Vec<Tag>;
    const GridFrame& frame;
    const GridBend (&bend)[3];
    V lower[3], upper[3];

    HWY_INLINE DeviationRange(const GridFrame& frame, const GridBend (&bend)[3])
        : frame(frame), bend(bend) {
        for (int k = 0; k < 3; ++k) {
            lower[k] = hn::Set(Tag(), std::numeric_limits<float>::infinity());
            upper[k] = hn::Neg(lower[k]);
        }
    }
    /// Takes in points of which as many as count are there.
    HWY_INLINE void Extend(V x, V y, V z, V column, V row, int count) {
        const Tag d;
        const V infinity = hn::Set(d, std::numeric_limits<float>::infinity());
        const float s = static_cast<float>(frame.side);
        const V side = hn::Set(d, s), half = hn::Set(d, s / 2);
        const V columns = hn::Mul(column, hn::Sub(column, side)),
                rows = hn::Mul(row, hn::Sub(row, side)),
                twist = hn::Mul(hn::Sub(column, half), hn::Sub(row, half));
        const V even[3] = {column, row, hn::Zero(d)};
        const auto isThere = hn::FirstN(d, static_cast<size_t>(std::max(count, 0)));
        const Places<V> places(frame, x, y, z);
        for (int k = 0; k < 3; ++k) {
            V off = hn::Sub(places.at[k], even[k]);
            off = hn::NegMulAdd(hn::Set(d, bend[k].columns), columns, off);
            off = hn::NegMulAdd(hn::Set(d, bend[k].rows), rows, off);
            off = hn::NegMulAdd(hn::Set(d, bend[k].twist), twist, off);
            lower[k] = hn::Min(lower[k], hn::IfThenElse(isThere, off, infinity));
            upper[k] = hn::Max(upper[k], hn::IfThenElse(isThere, off, hn::Neg(infinity)));
        }
    }
};

/// Measures how the points of a grid are bent: by the ends and middles of three columns and rows.
inline void MeasureBend(const LimitGrid& grid, const GridFrame& frame, GridBend bend[3]) {
    const int side = grid.side;
    const float scale = 1 / static_cast<float>(side * side);
    for (int i = 0; i < 3 && side > 1; ++i) {
        for (int j = 0; j < 3; ++j) {
            const Vec3f point = grid.At(i * side / 2, j * side / 2) - frame.base;
            for (int k = 0; k < 3; ++k) {
                const float place = scale * Dot(frame.axes[k], point);
                bend[k].columns += (j == 1 ? -4.0f : 2.0f) / 3 * place;
                bend[k].rows += (i == 1 ? -4.0f : 2.0f) / 3 * place;
                bend[k].twist += static_cast<float>((i - 1) * (j - 1)) * place;
            }
        }
    }
}

/// Measures how the points of a grid are bent, and how far they stray.
inline void MeasureDeviation(const LimitGrid& grid, GridFrame* frame) {
    const GridTag d;
    const int lanes = static_cast<int>(hn::Lanes(d)), side = grid.side;
    const auto number = [&](int i) { return hn::Set(d, static_cast<float>(i)); };
    GridBend bend[3];
    MeasureBend(grid, *frame, bend);
    DeviationRange range(*frame, bend);
    // All columns but the last, row by row, then that.
    for (int row = 0; row <= side; ++row) {
        for (int first = 0; first < side; first += lanes) {
            range.Extend(hn::LoadU(d, grid.points[0][row] + first),
                         hn::LoadU(d, grid.points[1][row] + first),
                         hn::LoadU(d, grid.points[2][row] + first),
                         hn::Iota(d, static_cast<float>(first)), number(row), side - first);
        }
    }
    alignas(64) float column[3][2 * kMaxGridSide] = {};
    for (int axis = 0; axis < 3; ++axis) {
        for (int row = 0; row <= side; ++row) {
            column[axis][row] = grid.points[axis][row][side];
        }
    }
    for (int first = 0; first <= side; first += lanes) {
        range.Extend(hn::Load(d, column[0] + first), hn::Load(d, column[1] + first),
                     hn::Load(d, column[2] + first), number(side),
                     hn::Iota(d, static_cast<float>(first)), side + 1 - first);
    }
    for (int k = 0; k < 3; ++k) {
        frame->SetDeviation(k, bend[k], hn::GetLane(hn::MinOfLanes(d, range.lower[k])),
                            hn::GetLane(hn::MaxOfLanes(d, range.upper[k])));
    }
}

/// The quads of a grid that each ray of a packet may meet: a rectangle of columns and rows, both
/// ends included. Those of rays that may meet none are meaningless.
struct QuadRanges {
    alignas(64) int32_t firstColumn[kPacketSize], lastColumn[kPacketSize];
    alignas(64) int32_t firstRow[kPacketSize], lastRow[kPacketSize];
};

/// Intervals, one a lane.
template <class V>
struct Intervals {
    V least, greatest;

    HWY_INLINE void AddScaled(float scale, const Intervals& other) {
        const hn::DFromV<V> d;
        const V a = hn::Mul(hn::Set(d, scale), other.least),
                b = hn::Mul(hn::Set(d, scale), other.greatest);
        least = hn::Add(least, hn::Min(a, b));
        greatest = hn::Add(greatest, hn::Max(a, b));
    }
};

/// The terms of a GridBend over ranges of columns and rows, by interval arithmetic.
template <class V>
struct BendTerms {
    Intervals<V> columns, rows, twist;

    HWY_INLINE BendTerms(float side, const Intervals<V>& column, const Intervals<V>& row)
        : columns(_Parabola(side, column)), rows(_Parabola(side, row)) {
        const hn::DFromV<V> d;
        const V half = hn::Set(d, side / 2);
        const V a = hn::Sub(column.least, half), b = hn::Sub(column.greatest, half),
                e = hn::Sub(row.least, half), f = hn::Sub(row.greatest, half);
        const V ae = hn::Mul(a, e), af = hn::Mul(a, f), be = hn::Mul(b, e), bf = hn::Mul(b, f);
        twist = {hn::Min(hn::Min(ae, af), hn::Min(be, bf)),
                 hn::Max(hn::Max(ae, af), hn::Max(be, bf))};
    }
    HWY_INLINE Intervals<V> Of(const GridBend& bend, float lower, float upper) const {
        const hn::DFromV<V> d;
        Intervals<V> sum{hn::Set(d, lower), hn::Set(d, upper)};
        sum.AddScaled(bend.columns, columns);
        sum.AddScaled(bend.rows, rows);
        sum.AddScaled(bend.twist, twist);
        return sum;
    }

  private:
    static HWY_INLINE Intervals<V> _Parabola(float side, const Intervals<V>& x) {
        const hn::DFromV<V> d;
        const V p = hn::Mul(x.least, hn::Sub(x.least, hn::Set(d, side)));
        const V q = hn::Mul(x.greatest, hn::Sub(x.greatest, hn::Set(d, side)));
        const V middle = hn::Set(d, side / 2);
        const auto isAcross = hn::And(hn::Lt(x.least, middle), hn::Gt(x.greatest, middle));
        return {hn::IfThenElse(isAcross, hn::Set(d, -side * side / 4), hn::Min(p, q)),
                hn::Max(p, q)};
    }
};

/// Rays in a grid's frame, a vector of them.
template <class D>
struct FramedRays {
    using V = hn::Vec<D>;
    V origin[3], direction[3], margin[3];
    V inverse;              ///< of the direction's height
    V near, far;            ///< where they may meet the grid
    Intervals<V> quads[2];  ///< the columns and rows that they may meet there

    HWY_INLINE FramedRays(D d, const GridFrame& frame, const ObjectRays& rays, size_t first)
        : near(hn::Load(d, rays.tMin + first)), far(hn::Load(d, rays.tMax + first)) {
        const V ox = hn::Sub(hn::Load(d, rays.originX + first), hn::Set(d, frame.base.x));
        const V oy = hn::Sub(hn::Load(d, rays.originY + first), hn::Set(d, frame.base.y));
        const V oz = hn::Sub(hn::Load(d, rays.originZ + first), hn::Set(d, frame.base.z));
        const V dx = hn::Load(d, rays.directionX + first),
                dy = hn::Load(d, rays.directionY + first),
                dz = hn::Load(d, rays.directionZ + first);
        const V away = hn::Add(hn::Add(hn::Abs(ox), hn::Abs(oy)), hn::Abs(oz));
        const V tiny = hn::Set(d, 1e-30f);
        for (int k = 0; k < 3; ++k) {
            origin[k] = Places<V>::Along(frame.axes[k], ox, oy, oz);
            direction[k] = Places<V>::Along(frame.axes[k], dx, dy, dz);
            margin[k] = hn::Mul(hn::Set(d, frame.margin[k]), away);
            // Reciprocal of a zero: large but finite, so that zero times it is zero.
            const V safe = hn::IfThenElse(hn::Lt(hn::Abs(direction[k]), tiny),
                                          hn::CopySign(tiny, direction[k]), direction[k]);
            inverse = hn::Div(hn::Set(d, 1.0f), safe);
            _Clip(d, k, {hn::Set(d, frame.boxLower[k]), hn::Set(d, frame.boxUpper[k])});
        }
        for (int k = 0; k < 2; ++k) {
            const float end = static_cast<float>(frame.side);
            _FindQuads(d, frame, k,
                       {hn::Set(d, frame.boxLower[k]), hn::Set(d, frame.boxUpper[k] - end)});
        }
    }

    /// Narrows all to where the grid can be between the columns and rows that were found.
    HWY_INLINE void ClipToBends(D d, const GridFrame& frame) {
        const BendTerms<V> terms(static_cast<float>(frame.side), quads[0], quads[1]);
        _Clip(d, 2, terms.Of(frame.bend[2], frame.lower[2], frame.upper[2]));
        for (int k = 0; k < 2; ++k) {
            _FindQuads(d, frame, k, terms.Of(frame.bend[k], frame.lower[k], frame.upper[k]));
        }
    }

  private:
    /// Narrows near and far to a slab across an axis, the last that the inverse is of.
    HWY_INLINE void _Clip(D d, int k, const Intervals<V>& slab) {
        ClipToSlab(hn::Sub(slab.least, margin[k]), hn::Add(slab.greatest, margin[k]), origin[k],
                   inverse, hn::Set(d, 1.0f), &near, &far);
    }

    /// @param off  how far points between near and far are from their places
    HWY_INLINE void _FindQuads(D d, const GridFrame& frame, int k, const Intervals<V>& off) {
        const V from = hn::MulAdd(direction[k], near, origin[k]);
        const V to = hn::MulAdd(direction[k], far, origin[k]);
        const V side = hn::Set(d, static_cast<float>(frame.side));
        const auto clamp = [&](V place) { return hn::Min(hn::Max(place, hn::Zero(d)), side); };
        quads[k] = {clamp(hn::Sub(hn::Min(from, to), hn::Add(off.greatest, margin[k]))),
                    clamp(hn::Sub(hn::Max(from, to), hn::Sub(off.least, margin[k])))};
    }
};

/// Finds the quads that rays may meet. Returns a bit for each ray that may meet any.
/// @param among  a bit for each ray that counts
template <class D>
HWY_INLINE uint64_t FindQuads(D d, const GridFrame& frame, const ObjectRays& rays, uint64_t among,
                              QuadRanges* ranges) {
    using V = hn::Vec<D>;
    const hn::Rebind<int32_t, D> di;
    const int lanes = static_cast<int>(hn::Lanes(d));
    const uint64_t group = (uint64_t(1) << lanes) - 1;
    const V last = hn::Set(d, static_cast<float>(frame.side - 1));
    const auto store = [&](V place, int32_t* to) {
        hn::Store(hn::ConvertTo(di, hn::Min(place, last)), di, to);
    };
    uint64_t meeting = 0;
    for (int first = 0; first < rays.count; first += lanes) {
        if ((among >> first & group) == 0) {
            continue;
        }
        FramedRays<D> framed(d, frame, rays, first);
        if (frame.IsBent()) {
            framed.ClipToBends(d, frame);
        }
        meeting |= static_cast<uint64_t>(LaneBits(d, hn::Le(framed.near, framed.far))) << first;
        store(framed.quads[0].least, ranges->firstColumn + first);
        store(framed.quads[0].greatest, ranges->lastColumn + first);
        store(framed.quads[1].least, ranges->firstRow + first);
        store(framed.quads[1].greatest, ranges->lastRow + first);
    }
    return meeting & among;
}

}  // namespace HWY_NAMESPACE
}  // namespace cc
HWY_AFTER_NAMESPACE();

#endif
