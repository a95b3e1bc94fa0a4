#pragma once

#include <cstdint>
#include <memory>

#include "core/trace/instance.h"
#include "core/trace/levelMetric.h"
#include "core/trace/rayPacket.h"
#include "core/trace/sharedGrids.h"
#include "core/trace/traceStatistics.h"

namespace cc {

/// The ways to trace rays. Every kind hits the same surface; they differ in speed and memory only.
enum class TracerKind {
    Packet,                 ///< 64 rays at a time
    Algorithm1,             ///< the same, by the paper's recursion as published
    Algorithm1WithTexture,  ///< the same with texture coordinates: to measure what they cost
    Single,                 ///< one ray at a time
    Tessellated,            ///< 64 rays at a time, against quads made ahead of time
};

/// Finds what rays hit. A tracer has no state of its own: calls may run in parallel. (What is
/// tessellated ahead of time belongs to the surfaces: Surface::TessellationAt.)
class Tracer {
  public:
    virtual ~Tracer();

    /// Finds the nearest hit of every ray in (tMin, tMax). Shortens tMax to the hit's distance and
    /// fills hits for lanes below count; a ray without a hit gets kNoHit.
    /// @param grids  what the packets of a batch share, or null
    virtual void Intersect(const InstanceBvh& instances, RayPacket* rays, HitPacket* hits,
                           TraceStatistics* statistics, SharedGrids* grids) const = 0;
    void Intersect(const InstanceBvh& instances, RayPacket* rays, HitPacket* hits,
                   TraceStatistics* statistics) const {
        Intersect(instances, rays, hits, statistics, nullptr);
    }

    /// Returns a bit a ray: set if anything lies in (tMin, tMax).
    /// @param grids  what the packets of a batch share, or null
    virtual uint64_t Occluded(const InstanceBvh& instances, const RayPacket& rays,
                              TraceStatistics* statistics, SharedGrids* grids) const = 0;
    uint64_t Occluded(const InstanceBvh& instances, const RayPacket& rays,
                      TraceStatistics* statistics) const {
        return Occluded(instances, rays, statistics, nullptr);
    }
};

/// Makes a tracer. Packets and single rays see surfaces as finely cut as the metric says; the
/// others, which have one level for all, at its finest.
std::unique_ptr<Tracer> MakeTracer(TracerKind kind, const LevelMetric& levels);

}  // namespace cc
