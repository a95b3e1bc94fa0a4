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

/// Traces rays that are in world space already through all instances. Each instance sees them in
/// its own space; what shortened there is shortened here.
/// @tparam Rays         PacketRays or SingleRay
/// @param traceSurface  called with a surface, its instance's index and the rays in its space;
///                      returns false if every ray is done
template <class Rays, class TraceSurface>
HWY_INLINE void TraceInstances(const InstanceBvh& instances, const RayPacket& world,
                               ObjectRays* worldRays, TraceStatistics* statistics,
                               const TraceSurface& traceSurface) {
    Rays rays(worldRays);
    RayPacket current;
    bool isCopied = false;
    ObjectRays local;
    TraverseBvh(instances.TopLevel(), &rays, statistics,
                [&](uint32_t index, uint64_t, const Box3f&) {
                    const Instance& instance = instances.Instances()[index];
                    if (instance.isInPlace) {
                        return traceSurface(*instance.surface, index, &rays);
                    }
                    if (!isCopied) {
                        current = world;
                        isCopied = true;
                    }
                    std::copy(worldRays->tMax, worldRays->tMax + worldRays->count, current.tMax);
                    TransformRays(current, instance.worldToObject, &local);
                    Rays localRays(&local);
                    const bool goesOn = traceSurface(*instance.surface, index, &localRays);
                    std::copy(local.tMax, local.tMax + local.count, worldRays->tMax);
                    rays.Shortened();
                    return goesOn;
                });
}

}  // namespace HWY_NAMESPACE
}  // namespace cc
HWY_AFTER_NAMESPACE();

#endif
