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
constexpr float kSlabSlack = 1.0f + 1e-6f;

/// A bit for each lane of a mask.
template <class D>
HWY_INLINE uint32_t LaneBits(D d, hn::Mask<D> mask) {
    static_assert(hn::MaxLanes(D()) <= 16, "bits are those of two bytes");
    alignas(8) uint8_t bytes[8] = {};
    hn::StoreMaskBits(d, mask, bytes);
    return (bytes[0] | static_cast<uint32_t>(bytes[1]) << 8) & ((1u << hn::Lanes(d)) - 1);
}

/// Narrows [near, far] to the part of rays between two planes across one axis.
template <class V>
HWY_INLINE void ClipToSlab(V lower, V upper, V origin, V inverse, V slack, V* near, V* far) {
    const V t0 = hn::Mul(hn::Sub(lower, origin), inverse);
    const V t1 = hn::Mul(hn::Sub(upper, origin), inverse);
    *near = hn::Max(*near, hn::Min(t0, t1));
    *far = hn::Min(*far, hn::Mul(hn::Max(t0, t1), slack));
}

/// Which of the rays from lane first on hit a box.
template <class D>
HWY_INLINE hn::Mask<D> RaysHitBox(D d, const ObjectRays& rays, size_t first, const Box3f& box) {
    auto near = hn::Load(d, rays.tMin + first);
    auto far = hn::Load(d, rays.tMax + first);
    const auto slack = hn::Set(d, kSlabSlack);
    ClipToSlab(hn::Set(d, box.lower.x), hn::Set(d, box.upper.x), hn::Load(d, rays.originX + first),
               hn::Load(d, rays.inverseX + first), slack, &near, &far);
    ClipToSlab(hn::Set(d, box.lower.y), hn::Set(d, box.upper.y), hn::Load(d, rays.originY + first),
               hn::Load(d, rays.inverseY + first), slack, &near, &far);
    ClipToSlab(hn::Set(d, box.lower.z), hn::Set(d, box.upper.z), hn::Load(d, rays.originZ + first),
               hn::Load(d, rays.inverseZ + first), slack, &near, &far);
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

/// As many boxes as one test takes, one array a bound: the children of a node, or the blocks of a
/// limit grid. Slots from count on are meaningless.
struct WideBoxes {
    alignas(64) float lower[3][kBvhWidth], upper[3][kBvhWidth];
    int count;

    Box3f At(int slot) const {
        Box3f box;
        box.lower = {lower[0][slot], lower[1][slot], lower[2][slot]};
        box.upper = {upper[0][slot], upper[1][slot], upper[2][slot]};
        return box;
    }
};

/// Boxes that may be hit, and how far away they begin.
struct WideHits {
    uint32_t mask = 0;
    alignas(64) float distance[kBvhWidth];
};

using WideTag = hn::CappedTag<float, kBvhWidth>;

/// Decodes the boxes of a node's children.
HWY_INLINE void DecodeBoxes(const BvhNode& node, WideBoxes* boxes) {
    const WideTag d;
    const hn::Rebind<int32_t, WideTag> di;
    const hn::Rebind<uint8_t, WideTag> d8;
    boxes->count = node.childCount;
    for (int axis = 0; axis < 3; ++axis) {
        const auto origin = hn::Set(d, node.origin[axis]), scale = hn::Set(d, node.scale[axis]);
        const auto decode = [&](const uint8_t* from, float* to) {
            const auto steps = hn::ConvertTo(d, hn::PromoteTo(di, hn::LoadU(d8, from)));
            hn::Store(hn::MulAdd(steps, scale, origin), d, to);
        };
        for (size_t lane = 0; lane < kBvhWidth; lane += hn::Lanes(d)) {
            decode(node.lower[axis] + lane, boxes->lower[axis] + lane);
            decode(node.upper[axis] + lane, boxes->upper[axis] + lane);
        }
    }
}

/// PacketInterval::Culls for many boxes at once.
HWY_INLINE WideHits BoxesThatPacketHits(const WideBoxes& boxes, const PacketInterval& interval) {
    const WideTag d;
    WideHits result;
    const uint32_t used = (1u << boxes.count) - 1;
    if (!interval.IsValid()) {
        result.mask = used;
        for (float& distance : result.distance) {
            distance = 0;
        }
        return result;
    }
    const int axis = interval.Axis();
    for (size_t lane = 0; lane < kBvhWidth; lane += hn::Lanes(d)) {
        auto low = hn::Load(d, boxes.lower[axis] + lane);
        auto high = hn::Load(d, boxes.upper[axis] + lane);
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
            hit = hn::And(hit, hn::And(hn::Le(least, hn::Load(d, boxes.upper[side.axis] + lane)),
                                       hn::Ge(most, hn::Load(d, boxes.lower[side.axis] + lane))));
        }
        result.mask |= LaneBits(d, hit) << lane;
        hn::Store(near, d, result.distance + lane);
    }
    result.mask &= used;
    return result;
}

/// Slab tests of one ray against many boxes.
HWY_INLINE WideHits BoxesThatRayHits(const WideBoxes& boxes, const ObjectRays& rays, int ray) {
    const WideTag d;
    WideHits result;
    for (size_t lane = 0; lane < kBvhWidth; lane += hn::Lanes(d)) {
        auto near = hn::Set(d, rays.tMin[ray]), far = hn::Set(d, rays.tMax[ray]);
        const float origins[3] = {rays.originX[ray], rays.originY[ray], rays.originZ[ray]};
        const float inverses[3] = {rays.inverseX[ray], rays.inverseY[ray], rays.inverseZ[ray]};
        for (int axis = 0; axis < 3; ++axis) {
            ClipToSlab(hn::Load(d, boxes.lower[axis] + lane), hn::Load(d, boxes.upper[axis] + lane),
                       hn::Set(d, origins[axis]), hn::Set(d, inverses[axis]),
                       hn::Set(d, kSlabSlack), &near, &far);
        }
        result.mask |= LaneBits(d, hn::Le(near, far)) << lane;
        hn::Store(near, d, result.distance + lane);
    }
    result.mask &= (1u << boxes.count) - 1;
    return result;
}

/// A bit for each ray that hits a box, of those whose bit is set.
template <class D>
HWY_INLINE uint64_t RaysThatHit(D d, const ObjectRays& rays, uint64_t among, const Box3f& box) {
    const int lanes = static_cast<int>(hn::Lanes(d));
    const uint64_t group = (uint64_t(1) << lanes) - 1;
    uint64_t bits = 0;
    for (int first = 0; first < rays.count; first += lanes) {
        if ((among >> first & group) != 0) {
            bits |= static_cast<uint64_t>(LaneBits(d, RaysHitBox(d, rays, first, box))) << first;
        }
    }
    return bits & among;
}

}  // namespace HWY_NAMESPACE
}  // namespace cc
HWY_AFTER_NAMESPACE();

#endif
