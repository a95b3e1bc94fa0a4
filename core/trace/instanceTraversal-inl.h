// Per-target include guard, as Highway's foreach_target asks for.
#if defined(CC_TRACE_INSTANCE_TRAVERSAL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CC_TRACE_INSTANCE_TRAVERSAL_INL_H
#undef CC_TRACE_INSTANCE_TRAVERSAL_INL_H
#else
#define CC_TRACE_INSTANCE_TRAVERSAL_INL_H
#endif

#include <algorithm>

#include <hwy/highway.h>

#include "core/trace/instance.h"
#include "core/trace/objectRays.h"
#include "core/trace/traversal-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cc {
namespace HWY_NAMESPACE {

/// Rays of the world, and the same in the space of one instance at a time. What shortens them there
/// shortens them here.
/// @tparam Rays  PacketRays or SingleRay
template <class Rays>
class InstanceRays {
  public:
    /// @param world      the rays as they came
    /// @param worldRays  the same, made ready
    InstanceRays(const RayPacket& world, ObjectRays* worldRays)
        : _world(world), _worldRays(*worldRays), _rays(worldRays) {}

    Rays* World() { return &_rays; }

    /// Calls trace with the rays in an instance's space, and returns what it does.
    template <class Trace>
    HWY_INLINE bool In(const Instance& instance, const Trace& trace) {
        if (instance.isInPlace) {
            return trace(&_rays);
        }
        if (!_isCopied) {
            _current = _world;
            _isCopied = true;
        }
        std::copy(_worldRays.tMax, _worldRays.tMax + _worldRays.count, _current.tMax);
        TransformRays(_current, instance.worldToObject, &_local);
        Rays localRays(&_local);
        const bool goesOn = trace(&localRays);
        std::copy(_local.tMax, _local.tMax + _local.count, _worldRays.tMax);
        _rays.Shortened();
        return goesOn;
    }

  private:
    const RayPacket& _world;
    ObjectRays& _worldRays;
    Rays _rays;
    bool _isCopied = false;
    RayPacket _current;
    ObjectRays _local;
};

/// Traces rays through all instances.
/// @param trace  called with an instance's index and the rays in its space; returns false if every
///               ray is done
template <class Rays, class Trace>
HWY_INLINE void TraceInstances(const InstanceBvh& instances, const RayPacket& world,
                               ObjectRays* worldRays, TraceStatistics* statistics,
                               const Trace& trace) {
    InstanceRays<Rays> rays(world, worldRays);
    TraverseBvh(instances.TopLevel(), rays.World(), statistics,
                [&](uint32_t index, uint64_t, const Box3f&) {
                    return rays.In(instances.Instances()[index],
                                   [&](Rays* local) { return trace(index, local); });
                });
}

/// Traces rays through the parts of all instances.
/// @param trace  called with an instance's index, the rays in its space, and the start of their way
///               through its geometry's PrimitiveBvh; returns false if every ray is done
template <ChildOrder kOrder, class Rays, class Trace>
HWY_INLINE void TraceParts(const InstanceBvh& instances, const RayPacket& world,
                           ObjectRays* worldRays, TraceStatistics* statistics, const Trace& trace) {
    InstanceRays<Rays> rays(world, worldRays);
    TraverseBvh<kOrder>(instances.PartBvh(), rays.World(), statistics,
                        [&](uint32_t index, uint64_t hitting, const Box3f&) {
                            const InstancePart& part = instances.Parts()[index];
                            const Instance& instance = instances.Instances()[part.instance];
                            const auto& nodes = instance.geometry->PrimitiveBvh().Nodes();
                            return rays.In(instance, [&](Rays* local) {
                                TraversalStart start{part.node, AllRays(local->rays), {}};
                                if (part.slot != InstancePart::kWhole) {
                                    start.child = nodes[part.node].child[part.slot];
                                    start.box = nodes[part.node].ChildBox(part.slot);
                                    start.hitting = RaysThatHit(
                                        typename Rays::Tag(), local->rays,
                                        instance.isInPlace ? hitting : start.hitting, start.box);
                                }
                                return start.hitting == 0 || trace(part.instance, local, start);
                            });
                        });
}

}  // namespace HWY_NAMESPACE
}  // namespace cc
HWY_AFTER_NAMESPACE();

#endif
