// Per-target include guard, as Highway's foreach_target asks for.
#if defined(CC_TRACE_TRAVERSAL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CC_TRACE_TRAVERSAL_INL_H
#undef CC_TRACE_TRAVERSAL_INL_H
#else
#define CC_TRACE_TRAVERSAL_INL_H
#endif

#include <hwy/highway.h>

#include "core/bvh/bvh.h"
#include "core/trace/boxTests-inl.h"
#include "core/trace/objectRays.h"
#include "core/trace/packetInterval.h"
#include "core/trace/traceStatistics.h"

HWY_BEFORE_NAMESPACE();
namespace cc {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Rays that travel together: a packet, culled by intervals and by its first hit.
struct PacketRays {
    using Tag = hn::CappedTag<float, 16>;

    explicit PacketRays(ObjectRays* rays) : rays(*rays), interval(*rays) {}

    WideHits HitBoxes(const WideBoxes& boxes) const { return BoxesThatPacketHits(boxes, interval); }
    bool Culls(const Box3f& box) const { return interval.Culls(box); }
    bool IsBeyond(float distance) const {
        return interval.IsValid() && distance > interval.Reach();
    }
    void Shortened() { interval.UpdateReach(rays); }

    ObjectRays& rays;
    PacketInterval interval;
};

/// One ray by itself: every box is tested exactly, nothing is shared.
struct SingleRay {
    using Tag = hn::CappedTag<float, 1>;

    explicit SingleRay(ObjectRays* rays) : rays(*rays) {}

    WideHits HitBoxes(const WideBoxes& boxes) const { return BoxesThatRayHits(boxes, rays, 0); }
    bool Culls(const Box3f&) const { return false; }
    bool IsBeyond(float distance) const { return distance > rays.tMax[0]; }
    void Shortened() {}

    ObjectRays& rays;
};

/// Walks a BVH depth first, nearest child first, and calls leaf(primitive, firstRay, box) for every
/// primitive whose box a ray hits; firstRay is the first that does. The walk ends when leaf
/// returns false.
template <class Rays, class Leaf>
HWY_INLINE void TraverseBvh(const Bvh& bvh, Rays* rays, TraceStatistics* statistics,
                            const Leaf& leaf) {
    // Not a Box3f, which a stack of them would make empty first.
    struct Entry {
        float lower[3], upper[3];
        uint32_t child;
        int firstRay;
        float distance;
    };
    // Every level leaves at most all children but one behind.
    Entry stack[kBvhMaxDepth * (kBvhWidth - 1) + 1];
    int size = 0;
    const typename Rays::Tag d;

    const auto pushChildren = [&](const BvhNode& node, int firstRay) {
        ++statistics->traversals;
        WideBoxes boxes;
        DecodeBoxes(node, &boxes);
        const WideHits hits = rays->HitBoxes(boxes);
        const int bottom = size;
        for (uint32_t mask = hits.mask; mask != 0; mask &= mask - 1) {
            const int slot = __builtin_ctz(mask);
            // Sorted by distance, the nearest on top.
            int at = size++;
            for (; at > bottom && stack[at - 1].distance < hits.distance[slot]; --at) {
                stack[at] = stack[at - 1];
            }
            stack[at] = {{boxes.lower[0][slot], boxes.lower[1][slot], boxes.lower[2][slot]},
                         {boxes.upper[0][slot], boxes.upper[1][slot], boxes.upper[2][slot]},
                         node.child[slot],
                         firstRay,
                         hits.distance[slot]};
        }
    };

    if (bvh.IsEmpty()) {
        return;
    }
    pushChildren(bvh.Nodes()[0], 0);
    while (size > 0) {
        const Entry entry = stack[--size];
        if (rays->IsBeyond(entry.distance)) {
            continue;
        }
        Box3f box;
        box.lower = {entry.lower[0], entry.lower[1], entry.lower[2]};
        box.upper = {entry.upper[0], entry.upper[1], entry.upper[2]};
        const int firstRay = FirstRayThatHits(d, rays->rays, entry.firstRay, box);
        if (firstRay >= rays->rays.count) {
            continue;
        }
        if ((entry.child & kBvhLeaf) == 0) {
            pushChildren(bvh.Nodes()[entry.child], firstRay);
        } else if (!leaf(entry.child & ~kBvhLeaf, firstRay, box)) {
            return;
        }
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace cc
HWY_AFTER_NAMESPACE();

#endif
