#pragma once

#include "core/math/transform.h"
#include "core/trace/rayPacket.h"

namespace cc {

/// The rays of a packet in an instance's own space, with what box and quad tests ask for. The
/// distance t along a ray is the same as in the world, because directions are not normalized.
struct alignas(64) ObjectRays {
    float originX[kPacketSize], originY[kPacketSize], originZ[kPacketSize];
    float directionX[kPacketSize], directionY[kPacketSize], directionZ[kPacketSize];
    float inverseX[kPacketSize], inverseY[kPacketSize], inverseZ[kPacketSize];
    float length[kPacketSize];  ///< of the direction
    float tMin[kPacketSize];
    float tMax[kPacketSize];  ///< below tMin for a ray that is done or was never there
    int count;
};

/// Brings a packet into an instance's space. Lanes from count on are filled with rays that are
/// done, up to a multiple of 16.
void TransformRays(const RayPacket& rays, const AffineTransform& worldToObject, ObjectRays* out);

}  // namespace cc
