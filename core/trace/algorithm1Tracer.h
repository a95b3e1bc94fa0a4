#pragma once

#include "core/trace/packetKernels.h"
#include "core/trace/textureHits.h"

namespace cc {

/// The recursion of the paper as published, over 4-tuples (Algorithm1 has where it differs).
PacketKernels Algorithm1Kernels();

/// The same over 8-tuples, which carry texture coordinates along, wherever nearest hits are asked
/// for. There is nobody to take the coordinates: what they cost is what these are for.
PacketKernels Algorithm1TextureKernels();

/// The kernel of these (PacketKernels::intersect), which gives the texture coordinates of hits.
/// Surfaces have none, so that a projection along z stands in: in the surface's own space, s is x
/// and t is y of the hit.
void IntersectWithTexture(const InstanceBvh& instances, int level, ObjectRays* worldRays,
                          const RayPacket& world, HitPacket* hits, TextureHits* texture,
                          TraceStatistics* statistics);

}  // namespace cc
