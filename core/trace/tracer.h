#pragma once

#include <cstdint>
#include <memory>

#include "core/trace/instance.h"
#include "core/trace/rayPacket.h"
#include "core/trace/traceStatistics.h"

namespace cc {

/// The ways to trace rays. Every kind hits the same surface; they differ in speed only.
enum class TracerKind { Packet, Single };

/// Finds what rays hit. A tracer has no state of its own: calls may run in parallel.
class Tracer {
  public:
    virtual ~Tracer();

    /// Finds the nearest hit of every ray in (tMin, tMax). Shortens tMax to the hit's distance and
    /// fills hits for lanes below count; a ray without a hit gets kNoHit.
    virtual void Intersect(const InstanceBvh& instances, RayPacket* rays, HitPacket* hits,
                           TraceStatistics* statistics) const = 0;

    /// Returns a bit a ray: set if anything lies in (tMin, tMax).
    virtual uint64_t Occluded(const InstanceBvh& instances, const RayPacket& rays,
                              TraceStatistics* statistics) const = 0;
};

/// @param level  each base face is split into 2^level x 2^level quads, 0..8
std::unique_ptr<Tracer> MakeTracer(TracerKind kind, int level);

}  // namespace cc
