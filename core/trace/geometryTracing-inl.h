// Per-target include guard, as Highway's foreach_target asks for.
#if defined(CC_TRACE_GEOMETRY_TRACING_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CC_TRACE_GEOMETRY_TRACING_INL_H
#undef CC_TRACE_GEOMETRY_TRACING_INL_H
#else
#define CC_TRACE_GEOMETRY_TRACING_INL_H
#endif

#include "core/trace/instance.h"
#include "core/trace/traversal-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cc {
namespace HWY_NAMESPACE {

/// Traces rays through the geometry of an instance, if that is no surface: those have tracers of
/// many kinds, all others one. Returns false if every ray is done.
/// @tparam Rays   PacketRays or SingleRay; instantiated in geometryTracing.cpp
/// @param number  of the instance, as hits give it
/// @param rays    in the instance's space
template <class Rays, bool kAnyHit>
bool TraceGeometry(const Instance& instance, uint32_t number, const TraversalStart& start,
                   Rays* rays, HitPacket* hits, TraceStatistics* statistics);

}  // namespace HWY_NAMESPACE
}  // namespace cc
HWY_AFTER_NAMESPACE();

#endif
