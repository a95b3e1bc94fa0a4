#pragma once

#include <memory>

#include "core/trace/objectRays.h"
#include "core/trace/tracer.h"

namespace cc {

/// A way to trace packets: what differs between the tracers that take 64 rays at a time. Both get
/// the rays of a packet in world space twice: as they came, and made ready, where what they hit
/// shortens them.
struct PacketKernels {
    /// Finds the nearest hits. Hits are cleared already; grids may be null.
    void (*intersect)(const InstanceBvh& instances, const LevelMetric& levels,
                      ObjectRays* worldRays, const RayPacket& world, HitPacket* hits,
                      SharedGrids* grids, TraceStatistics* statistics);
    /// Ends every ray that hits anything: its tMax falls below its tMin.
    void (*occlude)(const InstanceBvh& instances, const LevelMetric& levels, ObjectRays* worldRays,
                    const RayPacket& world, SharedGrids* grids, TraceStatistics* statistics);
};

std::unique_ptr<Tracer> MakePacketTracer(const PacketKernels& kernels, const LevelMetric& levels);

}  // namespace cc
