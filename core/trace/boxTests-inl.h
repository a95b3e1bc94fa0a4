// Per-target include guard, as Highway's foreach_target asks for.
#if defined(CC_TRACE_BOX_TESTS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CC_TRACE_BOX_TESTS_INL_H
#undef CC_TRACE_BOX_TESTS_INL_H
#else
#define CC_TRACE_BOX_TESTS_INL_H
#endif

#include <hwy/highway.h>

#include "core/bvh/bvh.h"
#include "core/trace/objectRays.h"
#include "core/trace/packetInterval.h"

HWY_BEFORE_NAMESPACE();
namespace cc {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Slack of slab tests for the rounding of their own arithmetic.
constexpr float kSlabSlack = 1.0f + 4e-7f;

/// Which of the rays from lane first on hit a box.
template <class D>
HWY_INLINE hn::Mask<D> RaysHitBox(D d, const ObjectRays& rays, size_t first, const Box3f& box) {
    auto near = hn::Load(d, rays.tMin + first);
    auto far = hn::Load(d, rays.tMax + first);
    const auto slab = [&](const float* origins, const float* inverses, float lower, float upper) {
        const auto origin = hn::Load(d, origins + first);
        const auto inverse = hn::Load(d, inverses + first);
        const auto t0 = hn::Mul(hn::Sub(hn::Set(d, lower), origin), inverse);
        const auto t1 = hn::Mul(hn::Sub(hn::Set(d, upper), origin), inverse);
        near = hn::Max(near, hn::Min(t0, t1));
        far = hn::Min(far, hn::Mul(hn::Max(t0, t1), hn::Set(d, kSlabSlack)));
    };
    slab(rays.originX, rays.inverseX, box.lower.x, box.upper.x);
    slab(rays.originY, rays.inverseY, box.lower.y, box.upper.y);
    slab(rays.originZ, rays.inverseZ, box.lower.z, box.upper.z);
    return hn::Le(near, far);
}

/// The first-hit test (paper, section 3.4): the first ray at or after `from` that hits the box, or
/// the packet's count if none does. Mostly the first vector of rays decides.
template <class D>
HWY_INLINE int FirstRayThatHits(D d, const ObjectRays& rays, int from, const Box3f& box) {
    const int lanes = static_cast<int>(hn::Lanes(d));
    for (int group = from - from % lanes; group < rays.count; group += lanes) {
        const auto hits = RaysHitBox(d, rays, group, box);
        if (!hn::AllFalse(d, hits)) {
            return group + static_cast<int>(hn::FindFirstTrue(d, hits));
        }
    }
    return rays.count;
}

/// Children of a node that may be hit, and how far away they begin.
struct NodeHits {
    uint32_t mask = 0;
    alignas(64) float distance[kBvhWidth];
};

using NodeTag = hn::CappedTag<float, kBvhWidth>;

HWY_INLINE uint32_t MaskBits(NodeTag d, hn::Mask<NodeTag> mask) {
    alignas(8) uint8_t bytes[8] = {};
    hn::StoreMaskBits(d, mask, bytes);
    return bytes[0] & ((1u << hn::Lanes(d)) - 1);
}

inline const float* Lower(const BvhNode& node, int axis) {
    return axis == 0 ? node.lowerX : axis == 1 ? node.lowerY : node.lowerZ;
}
inline const float* Upper(const BvhNode& node, int axis) {
    return axis == 0 ? node.upperX : axis == 1 ? node.upperY : node.upperZ;
}

/// PacketInterval::Culls for all children of a node at once.
HWY_INLINE NodeHits NodeHitsOfPacket(const BvhNode& node, const PacketInterval& interval) {
    const NodeTag d;
    NodeHits result;
    const uint32_t used = (1u << node.childCount) - 1;
    if (!interval.IsValid()) {
        result.mask = used;
        for (float& distance : result.distance) {
            distance = 0;
        }
        return result;
    }
    for (size_t lane = 0; lane < kBvhWidth; lane += hn::Lanes(d)) {
        auto low = hn::Load(d, Lower(node, interval.Axis()) + lane);
        auto high = hn::Load(d, Upper(node, interval.Axis()) + lane);
        if (interval.IsReversed()) {
            const auto swap = hn::Neg(low);
            low = hn::Neg(high);
            high = swap;
        }
        const auto far = hn::Sub(high, hn::Set(d, interval.OriginMin()));
        const auto near = hn::Max(hn::Sub(low, hn::Set(d, interval.OriginMax())), hn::Zero(d));
        auto hit = hn::And(hn::Ge(far, hn::Set(d, interval.Nearest())),
                           hn::Le(near, hn::Set(d, interval.Reach())));
        for (int i = 0; i < 2; ++i) {
            const PacketInterval::Slab& side = interval.Side(i);
            const auto slopeMin = hn::Set(d, side.slopeMin), slopeMax = hn::Set(d, side.slopeMax);
            const auto least = hn::Add(hn::Set(d, side.originMin),
                                       hn::Min(hn::Mul(slopeMin, near), hn::Mul(slopeMin, far)));
            const auto most = hn::Add(hn::Set(d, side.originMax),
                                      hn::Max(hn::Mul(slopeMax, near), hn::Mul(slopeMax, far)));
            hit = hn::And(hit, hn::And(hn::Le(least, hn::Load(d, Upper(node, side.axis) + lane)),
                                       hn::Ge(most, hn::Load(d, Lower(node, side.axis) + lane))));
        }
        result.mask |= MaskBits(d, hit) << lane;
        hn::Store(near, d, result.distance + lane);
    }
    result.mask &= used;
    return result;
}

/// Slab tests of one ray against all children of a node.
HWY_INLINE NodeHits NodeHitsOfRay(const BvhNode& node, const ObjectRays& rays) {
    const NodeTag d;
    NodeHits result;
    for (size_t lane = 0; lane < kBvhWidth; lane += hn::Lanes(d)) {
        auto near = hn::Set(d, rays.tMin[0]), far = hn::Set(d, rays.tMax[0]);
        const auto slab = [&](float origin, float inverse, const float* lower, const float* upper) {
            const auto o = hn::Set(d, origin), i = hn::Set(d, inverse);
            const auto t0 = hn::Mul(hn::Sub(hn::Load(d, lower + lane), o), i);
            const auto t1 = hn::Mul(hn::Sub(hn::Load(d, upper + lane), o), i);
            near = hn::Max(near, hn::Min(t0, t1));
            far = hn::Min(far, hn::Mul(hn::Max(t0, t1), hn::Set(d, kSlabSlack)));
        };
        slab(rays.originX[0], rays.inverseX[0], node.lowerX, node.upperX);
        slab(rays.originY[0], rays.inverseY[0], node.lowerY, node.upperY);
        slab(rays.originZ[0], rays.inverseZ[0], node.lowerZ, node.upperZ);
        result.mask |= MaskBits(d, hn::Le(near, far)) << lane;
        hn::Store(near, d, result.distance + lane);
    }
    result.mask &= (1u << node.childCount) - 1;
    return result;
}

}  // namespace HWY_NAMESPACE
}  // namespace cc
HWY_AFTER_NAMESPACE();

#endif
