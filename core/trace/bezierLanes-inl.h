// Per-target include guard, as Highway's foreach_target asks for.
#if defined(CC_TRACE_BEZIER_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CC_TRACE_BEZIER_LANES_INL_H
#undef CC_TRACE_BEZIER_LANES_INL_H
#else
#define CC_TRACE_BEZIER_LANES_INL_H
#endif

#include <hwy/highway.h>

#include "core/math/box.h"
#include "core/trace/bezierTables.h"

HWY_BEFORE_NAMESPACE();
namespace cc {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// A quartic Bezier triangle laid out for SIMD: a lane for each of its control points, and one more
/// that repeats the first.
struct alignas(64) BezierLanes {
    float axis[3][16];

    BezierLanes() = default;
    explicit BezierLanes(const BezierTriangle& patch) {
        for (int i = 0; i < 16; ++i) {
            const Vec3f& p = patch.points[i % BezierTriangle::kPointCount];
            axis[0][i] = p.x;
            axis[1][i] = p.y;
            axis[2][i] = p.z;
        }
    }
};

/// 16 points that are sums of a patch's control points. The sums run alike from both ends of an
/// edge, as those that count for one are its corners, then pairs of points that mirror each other,
/// then its middle: a curve that two patches share has the same points in both.
HWY_INLINE void Combine(const BezierLanes& patch, const BezierCombination& sum,
                        float points[3][16]) {
    const hn::CappedTag<float, 16> d;
    for (size_t lane = 0; lane < 16; lane += hn::Lanes(d)) {
        for (int axis = 0; axis < 3; ++axis) {
            const float* p = patch.axis[axis];
            const auto term = [&](int i) HWY_ATTR {
                return hn::Mul(hn::Load(d, sum.weights[i] + lane), hn::Set(d, p[i]));
            };
            auto total = hn::Add(hn::Add(term(0), term(1)), term(2));
            for (int i = 3; i < 9; i += 2) {
                total = hn::Add(total, hn::Add(term(i), term(i + 1)));
            }
            for (int i = 9; i < BezierTriangle::kPointCount; ++i) {
                total = hn::Add(total, term(i));
            }
            hn::Store(total, d, points[axis] + lane);
        }
    }
}

/// The four parts of SubTriangle::Split.
HWY_INLINE void SplitTriangle(const BezierLanes& patch, BezierLanes parts[4]) {
    const BezierTables& tables = BezierTables::Get();
    for (int part = 0; part < 4; ++part) {
        Combine(patch, tables.splits[part], parts[part].axis);
    }
}

/// The box of the control points: it holds the patch (convex hull property).
HWY_INLINE Box3f HullBox(const BezierLanes& patch) {
    const hn::CappedTag<float, 16> d;
    Box3f box;
    for (int axis = 0; axis < 3; ++axis) {
        auto low = hn::Load(d, patch.axis[axis]), high = low;
        for (size_t lane = hn::Lanes(d); lane < 16; lane += hn::Lanes(d)) {
            const auto p = hn::Load(d, patch.axis[axis] + lane);
            low = hn::Min(low, p);
            high = hn::Max(high, p);
        }
        box.lower[axis] = hn::GetLane(hn::MinOfLanes(d, low));
        box.upper[axis] = hn::GetLane(hn::MaxOfLanes(d, high));
    }
    return box;
}

}  // namespace HWY_NAMESPACE
}  // namespace cc
HWY_AFTER_NAMESPACE();

#endif
