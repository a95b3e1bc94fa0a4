// Per-target include guard, as Highway's foreach_target asks for.
#if defined(CC_TRACE_TRAVERSAL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CC_TRACE_TRAVERSAL_INL_H
#undef CC_TRACE_TRAVERSAL_INL_H
#else
#define CC_TRACE_TRAVERSAL_INL_H
#endif

#include <cmath>

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

/// Rays that travel together: a packet, culled by intervals.
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

/// Below this many rays each is tested against all boxes of a node at once, else each box against
/// all rays at once.
constexpr int kFewRays = 12;

/// The order in which the children of a node are visited: any will do for rays that end at whatever
/// they hit.
enum class ChildOrder { NearestFirst, Any };

/// Entries of a traversal: boxes that rays may hit.
template <ChildOrder kOrder>
class TraversalStack {
  public:
    /// Not a Box3f, which a stack of them would make empty first.
    struct Entry {
        float lower[3], upper[3];
        float distance;  ///< of the nearest ray if isCertain is set, else of the whole packet
        uint32_t child;
        uint64_t rays;   ///< those that may hit the box
        bool isCertain;  ///< each of the rays has been tested against the box

        Box3f Box() const {
            Box3f box;
            box.lower = {lower[0], lower[1], lower[2]};
            box.upper = {upper[0], upper[1], upper[2]};
            return box;
        }
    };

    bool IsEmpty() const { return _size == 0; }
    Entry Pop() { return _entries[--_size]; }

    /// Children that are pushed from here on are sorted by their distance, the nearest on top, if
    /// the order asks for it.
    void BeginNode() { _bottom = _size; }

    HWY_INLINE void Push(const WideBoxes& boxes, int slot, const Entry& entry) {
        int at = _size++;
        for (; kOrder == ChildOrder::NearestFirst && at > _bottom &&
               _entries[at - 1].distance < entry.distance;
             --at) {
            _entries[at] = _entries[at - 1];
        }
        _entries[at] = entry;
        for (int axis = 0; axis < 3; ++axis) {
            _entries[at].lower[axis] = boxes.lower[axis][slot];
            _entries[at].upper[axis] = boxes.upper[axis][slot];
        }
    }

  private:
    // Every level leaves at most all children but one behind.
    Entry _entries[kBvhMaxDepth * (kBvhWidth - 1) + 1];
    int _size = 0, _bottom = 0;
};

/// Which rays hit which of many boxes, ray by ray, and the least distance of each box.
struct RaysOfBoxes {
    uint64_t rays[kBvhWidth] = {};
    alignas(64) float distance[kBvhWidth];
    uint32_t boxes = 0;

    HWY_INLINE RaysOfBoxes(const WideBoxes& wide, const ObjectRays& all, uint64_t among) {
        const WideTag d;
        for (size_t lane = 0; lane < kBvhWidth; lane += hn::Lanes(d)) {
            hn::Store(hn::Set(d, HUGE_VALF), d, distance + lane);
        }
        for (; among != 0; among &= among - 1) {
            const int ray = __builtin_ctzll(among);
            const WideHits hits = BoxesThatRayHits(wide, all, ray);
            for (uint32_t rest = hits.mask; rest != 0; rest &= rest - 1) {
                rays[__builtin_ctz(rest)] |= uint64_t(1) << ray;
            }
            boxes |= hits.mask;
            for (size_t lane = 0; lane < kBvhWidth; lane += hn::Lanes(d)) {
                hn::Store(hn::Min(hn::Load(d, distance + lane), hn::Load(d, hits.distance + lane)),
                          d, distance + lane);
            }
        }
    }
};

/// Pushes the children of a node that rays may hit, and calls prefetch with those that are
/// primitives.
template <ChildOrder kOrder, class Rays, class Prefetch>
HWY_INLINE void PushChildren(const BvhNode& node, const Rays& rays, uint64_t among,
                             TraversalStack<kOrder>* stack, const Prefetch& prefetch) {
    const auto announce = [&](uint32_t child) __attribute__((always_inline)) {
        if ((child & kBvhLeaf) != 0) {
            prefetch(child & ~kBvhLeaf);
        }
    };
    WideBoxes boxes;
    DecodeBoxes(node, &boxes);
    stack->BeginNode();
    if (hwy::PopCount(among) <= kFewRays) {
        const RaysOfBoxes hits(boxes, rays.rays, among);
        for (uint32_t rest = hits.boxes; rest != 0; rest &= rest - 1) {
            const int slot = __builtin_ctz(rest);
            announce(node.child[slot]);
            stack->Push(boxes, slot,
                        {{}, {}, hits.distance[slot], node.child[slot], hits.rays[slot], true});
        }
        return;
    }
    const WideHits hits = rays.HitBoxes(boxes);
    for (uint32_t rest = hits.mask; rest != 0; rest &= rest - 1) {
        const int slot = __builtin_ctz(rest);
        announce(node.child[slot]);
        stack->Push(boxes, slot, {{}, {}, hits.distance[slot], node.child[slot], among, false});
    }
}

/// A bit for each ray of a packet.
inline uint64_t AllRays(const ObjectRays& rays) {
    return rays.count == 0 ? 0 : ~uint64_t(0) >> (kPacketSize - rays.count);
}

/// The rays that no hit nearer than a distance has ended yet.
inline uint64_t RaysThatReach(const ObjectRays& rays, uint64_t among, float distance) {
    uint64_t reaching = among;
    for (; among != 0; among &= among - 1) {
        const int ray = __builtin_ctzll(among);
        reaching &= ~(uint64_t(!(rays.tMax[ray] >= distance)) << ray);
    }
    return reaching;
}

/// Where a walk through a BVH begins: with a child of a node.
struct TraversalStart {
    uint32_t child;    ///< as in BvhNode
    uint64_t hitting;  ///< a bit for each ray that hits its box
    Box3f box;         ///< of a primitive
};

/// Walks a BVH depth first and calls leaf(primitive, hitting, box) for every
/// primitive whose box a ray hits; hitting has a bit for each ray that does. The walk ends when
/// leaf returns false.
/// @param prefetch  called with primitives that leaf is likely to be called with
template <ChildOrder kOrder, class Rays, class Leaf, class Prefetch>
HWY_INLINE void TraverseBvh(const Bvh& bvh, const TraversalStart& start, Rays* rays,
                            TraceStatistics* statistics, const Leaf& leaf,
                            const Prefetch& prefetch) {
    if ((start.child & kBvhLeaf) != 0) {
        leaf(start.child & ~kBvhLeaf, start.hitting, start.box);
        return;
    }
    const typename Rays::Tag d;
    TraversalStack<kOrder> stack;
    ++statistics->traversals;
    PushChildren(bvh.Nodes()[start.child], *rays, start.hitting, &stack, prefetch);
    while (!stack.IsEmpty()) {
        const typename TraversalStack<kOrder>::Entry entry = stack.Pop();
        const Box3f box = entry.Box();
        uint64_t hitting = 0;
        if (entry.isCertain) {
            hitting = RaysThatReach(rays->rays, entry.rays, entry.distance);
        } else if (!rays->IsBeyond(entry.distance)) {
            hitting = RaysThatHit(d, rays->rays, entry.rays, box);
        }
        if (hitting == 0) {
            continue;
        }
        if ((entry.child & kBvhLeaf) == 0) {
            ++statistics->traversals;
            PushChildren(bvh.Nodes()[entry.child], *rays, hitting, &stack, prefetch);
        } else if (!leaf(entry.child & ~kBvhLeaf, hitting, box)) {
            return;
        }
    }
}

/// The same from the root on, without prefetching.
template <ChildOrder kOrder = ChildOrder::NearestFirst, class Rays, class Leaf>
HWY_INLINE void TraverseBvh(const Bvh& bvh, Rays* rays, TraceStatistics* statistics,
                            const Leaf& leaf) {
    if (!bvh.IsEmpty()) {
        TraverseBvh<kOrder>(bvh, {0, AllRays(rays->rays), {}}, rays, statistics, leaf,
                            [](uint32_t) {});
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace cc
HWY_AFTER_NAMESPACE();

#endif
