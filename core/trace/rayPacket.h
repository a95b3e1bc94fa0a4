#pragma once

#include <cstdint>

namespace cc {

/// Rays in a packet: the size that the paper found best (section 3.4).
constexpr int kPacketSize = 64;

/// No primitive, no instance: the ray missed.
constexpr uint32_t kNoHit = 0xffffffffu;

/// Up to 64 rays, one array a component. Rays need not be normalized: distances t are in units of
/// each ray's direction. Lanes at and above count are ignored, and so are rays with tMax < tMin.
struct alignas(64) RayPacket {
    float originX[kPacketSize], originY[kPacketSize], originZ[kPacketSize];
    float directionX[kPacketSize], directionY[kPacketSize], directionZ[kPacketSize];
    float tMin[kPacketSize];
    /// The far end of the ray. Intersect shortens it to the nearest hit.
    float tMax[kPacketSize];
    int count = 0;
};

/// The nearest hit of each ray of a packet. The distance is the ray's tMax.
struct alignas(64) HitPacket {
    uint32_t instance[kPacketSize];        ///< kNoHit if the ray missed
    uint32_t patch[kPacketSize];           ///< or another primitive of that instance's geometry
    float u[kPacketSize], v[kPacketSize];  ///< in the primitive, 0..1
};

}  // namespace cc
