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

/// Where the control points of a Bezier patch would be if it were flat and even, for a side of one.
struct EvenControlPoints {
    alignas(64) float places[3][16];

    constexpr EvenControlPoints() : places() {
        for (int i = 0; i < 16; ++i) {
            const int row = i / 4, column = i % 4;
            places[0][i] = static_cast<float>(column) / 3;
            places[1][i] = static_cast<float>(row) / 3;
        }
    }
};
inline constexpr EvenControlPoints kEvenControlPoints;

/// Measures how far a Bezier patch strays in the frame of its corners, by its control points.
HWY_INLINE void MeasureDeviation(const BezierRows& patch, GridFrame* frame) {
    const RowTag d;
    const auto side = hn::Set(d, static_cast<float>(frame->side));
    RowVector lower[3], upper[3];
    for (size_t lane = 0; lane < 16; lane += hn::Lanes(d)) {
        const float* row = patch.rows[lane / 4];
        const Places<RowVector> places(*frame, LoadFours(d, row, 16), LoadFours(d, row + 4, 16),
                                       LoadFours(d, row + 8, 16));
        for (int k = 0; k < 3; ++k) {
            const auto even = hn::Load(d, kEvenControlPoints.places[k] + lane);
            const auto off = hn::NegMulAdd(even, side, places.at[k]);
            lower[k] = lane == 0 ? off : hn::Min(lower[k], off);
            upper[k] = lane == 0 ? off : hn::Max(upper[k], off);
        }
    }
    for (int k = 0; k < 3; ++k) {
        frame->SetDeviation(k, hn::GetLane(hn::MinOfLanes(d, lower[k])),
                            hn::GetLane(hn::MaxOfLanes(d, upper[k])));
    }
}

/// The least and greatest deviation of points from their places.
struct DeviationRange {
    using Tag = GridTag;
    using V = hn::Vec<Tag>;
    V lower[3], upper[3];

    HWY_INLINE DeviationRange() {
        for (int k = 0; k < 3; ++k) {
            lower[k] = hn::Set(Tag(), std::numeric_limits<float>::infinity());
            upper[k] = hn::Neg(lower[k]);
        }
    }
    /// Takes in points of which as many as count are there.
    HWY_INLINE void Extend(const GridFrame& frame, V x, V y, V z, V column, V row, int count) {
        const Tag d;
        const V infinity = hn::Set(d, std::numeric_limits<float>::infinity());
        const auto isThere = hn::FirstN(d, static_cast<size_t>(std::max(count, 0)));
        const Places<V> places(frame, x, y, z);
        const V off[3] = {hn::Sub(places.at[0], column), hn::Sub(places.at[1], row), places.at[2]};
        for (int k = 0; k < 3; ++k) {
            lower[k] = hn::Min(lower[k], hn::IfThenElse(isThere, off[k], infinity));
            upper[k] = hn::Max(upper[k], hn::IfThenElse(isThere, off[k], hn::Neg(infinity)));
        }
    }
};

/// Measures how far the points of a grid stray.
inline void MeasureDeviation(const LimitGrid& grid, GridFrame* frame) {
    const GridTag d;
    const int lanes = static_cast<int>(hn::Lanes(d)), side = grid.side;
    const auto number = [&](int i) { return hn::Set(d, static_cast<float>(i)); };
    DeviationRange range;
    // All columns but the last, row by row, then that.
    for (int row = 0; row <= side; ++row) {
        for (int first = 0; first < side; first += lanes) {
            range.Extend(*frame, hn::LoadU(d, grid.points[0][row] + first),
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
        range.Extend(*frame, hn::Load(d, column[0] + first), hn::Load(d, column[1] + first),
                     hn::Load(d, column[2] + first), number(side),
                     hn::Iota(d, static_cast<float>(first)), side + 1 - first);
    }
    for (int k = 0; k < 3; ++k) {
        frame->SetDeviation(k, hn::GetLane(hn::MinOfLanes(d, range.lower[k])),
                            hn::GetLane(hn::MaxOfLanes(d, range.upper[k])));
    }
}

/// The quads of a grid that each ray of a packet may meet: a rectangle of columns and rows, both
/// ends included. Those of rays that may meet none are meaningless.
struct QuadRanges {
    alignas(64) int32_t firstColumn[kPacketSize], lastColumn[kPacketSize];
    alignas(64) int32_t firstRow[kPacketSize], lastRow[kPacketSize];
};

/// Rays in a grid's frame, a vector of them.
template <class D>
struct FramedRays {
    using V = hn::Vec<D>;
    V origin[3], direction[3], margin[3];
    V near, far;  ///< where they may be inside the frame's box

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
            const float end = k < 2 ? static_cast<float>(frame.side) : 0;
            const V lower = hn::Sub(hn::Set(d, frame.lower[k]), margin[k]);
            const V upper = hn::Add(hn::Set(d, frame.upper[k] + end), margin[k]);
            // Reciprocal of a zero: large but finite, so that zero times it is zero.
            const V safe = hn::IfThenElse(hn::Lt(hn::Abs(direction[k]), tiny),
                                          hn::CopySign(tiny, direction[k]), direction[k]);
            ClipToSlab(lower, upper, origin[k], hn::Div(hn::Set(d, 1.0f), safe), hn::Set(d, 1.0f),
                       &near, &far);
        }
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
        hn::Store(hn::ConvertTo(di, hn::Min(hn::Max(place, hn::Zero(d)), last)), di, to);
    };
    uint64_t meeting = 0;
    for (int first = 0; first < rays.count; first += lanes) {
        if ((among >> first & group) == 0) {
            continue;
        }
        const FramedRays<D> framed(d, frame, rays, first);
        meeting |= static_cast<uint64_t>(LaneBits(d, hn::Le(framed.near, framed.far))) << first;
        int32_t* const firsts[2] = {ranges->firstColumn + first, ranges->firstRow + first};
        int32_t* const lasts[2] = {ranges->lastColumn + first, ranges->lastRow + first};
        for (int k = 0; k < 2; ++k) {
            const V from = hn::MulAdd(framed.direction[k], framed.near, framed.origin[k]);
            const V to = hn::MulAdd(framed.direction[k], framed.far, framed.origin[k]);
            store(hn::Sub(hn::Min(from, to), hn::Add(hn::Set(d, frame.upper[k]), framed.margin[k])),
                  firsts[k]);
            store(hn::Sub(hn::Max(from, to), hn::Sub(hn::Set(d, frame.lower[k]), framed.margin[k])),
                  lasts[k]);
        }
    }
    return meeting & among;
}

}  // namespace HWY_NAMESPACE
}  // namespace cc
HWY_AFTER_NAMESPACE();

#endif
