// Per-target include guard, as Highway's foreach_target asks for.
#if defined(CC_TRACE_PATCH_RAYS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CC_TRACE_PATCH_RAYS_INL_H
#undef CC_TRACE_PATCH_RAYS_INL_H
#else
#define CC_TRACE_PATCH_RAYS_INL_H
#endif

#include <algorithm>
#include <cmath>

#include <hwy/highway.h>

#include "core/trace/boxTests-inl.h"
#include "core/trace/objectRays.h"
#include "core/trace/traceStatistics.h"

HWY_BEFORE_NAMESPACE();
namespace cc {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// How far apart neighbouring patches may compute the same point, given control points of one.
inline float RoundingTolerance(const Vec3f* points, int count) {
    float largest = 0;
    for (int i = 0; i < count; ++i) {
        largest = std::max(
            {largest, std::fabs(points[i].x), std::fabs(points[i].y), std::fabs(points[i].z)});
    }
    return 2.5e-7f * largest;
}

inline Box3f Widened(Box3f box, float by) {
    for (int axis = 0; axis < 3; ++axis) {
        box.lower[axis] -= by;
        box.upper[axis] += by;
    }
    return box;
}

/// The first ray from a given one on that hits a box, or the packet's count: culling by interval
/// first.
template <class Rays>
int FirstRayIn(const Rays& rays, const Box3f& box, int firstRay, TraceStatistics* statistics) {
    ++statistics->boxTests;
    if (rays.Culls(box)) {
        ++statistics->intervalCulls;
        return rays.rays.count;
    }
    const int first = FirstRayThatHits(typename Rays::Tag(), rays.rays, firstRay, box);
    statistics->earlyHits += first == firstRay;
    return first;
}

/// A bit for each ray from a given one on that hits a box.
template <class Rays>
uint64_t RaysIn(const Rays& rays, const Box3f& box, int firstRay) {
    const typename Rays::Tag d;
    const int lanes = static_cast<int>(hn::Lanes(d));
    uint64_t bits = 0;
    for (int group = firstRay - firstRay % lanes; group < rays.rays.count; group += lanes) {
        bits |= static_cast<uint64_t>(LaneBits(d, RaysHitBox(d, rays.rays, group, box))) << group;
    }
    return bits;
}

}  // namespace HWY_NAMESPACE
}  // namespace cc
HWY_AFTER_NAMESPACE();

#endif
