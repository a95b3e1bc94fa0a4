#pragma once

#include <cmath>

#include "core/trace/instance.h"
#include "core/trace/tracer.h"

namespace cc::test {

/// Of an answer that is right whichever of the faces that coincide is hit.
constexpr uint32_t kAnyFace = kNoHit - 1;

/// What one ray hits.
struct RayAnswer {
    uint32_t instance = kNoHit, face = kNoHit;
    float distance = 0;
};

/// @param i  a ray that was traced
inline RayAnswer AnswerOf(const InstanceBvh& world, const RayPacket& rays, const HitPacket& hits,
                          int i) {
    if (hits.instance[i] == kNoHit) {
        return {};
    }
    const Surface& surface = SurfaceOf(world.Instances()[hits.instance[i]]);
    const Vec3f direction{rays.directionX[i], rays.directionY[i], rays.directionZ[i]};
    return {hits.instance[i], surface.Patches().AuthoredFace(hits.patch[i]),
            rays.tMax[i] * Length(direction)};
}

/// @param bound  how far apart hits may be
inline bool Agree(const RayAnswer& a, const RayAnswer& b, float bound) {
    return a.instance == b.instance &&
           (a.face == b.face || a.face == kAnyFace || b.face == kAnyFace) &&
           std::fabs(a.distance - b.distance) <= bound;
}

/// Rays that run beside ray i, at no more than a distance.
inline RayPacket RaysBeside(const RayPacket& rays, int i, float distance) {
    constexpr float kFull = 6.2831853f;
    const Vec3f direction = Normalize({rays.directionX[i], rays.directionY[i], rays.directionZ[i]});
    const Vec3f side = Normalize(Cross(direction, {0.3f, 0.8f, 0.5f}));
    const Vec3f up = Cross(side, direction);
    RayPacket beside;
    beside.count = kPacketSize;
    for (int k = 0; k < kPacketSize; ++k) {
        const float angle = kFull * static_cast<float>(k % 16) / 16;
        const float radius = distance * static_cast<float>(1 + k / 16) / 4;
        const Vec3f shift = (side * std::cos(angle) + up * std::sin(angle)) * radius;
        beside.originX[k] = rays.originX[i] + shift.x;
        beside.originY[k] = rays.originY[i] + shift.y;
        beside.originZ[k] = rays.originZ[i] + shift.z;
        beside.directionX[k] = rays.directionX[i];
        beside.directionY[k] = rays.directionY[i];
        beside.directionZ[k] = rays.directionZ[i];
        beside.tMin[k] = rays.tMin[i];
        beside.tMax[k] = 1e30f;
    }
    return beside;
}

/// True if the tracer gives an answer to some ray that runs beside ray i, at no more than a
/// distance: the ray passes that close by an edge between two answers, or grazes the surface.
inline bool IsAnswerBeside(const InstanceBvh& world, const Tracer& tracer, const RayPacket& rays,
                           int i, const RayAnswer& answer, float distance) {
    RayPacket beside = RaysBeside(rays, i, distance);
    HitPacket hits;
    TraceStatistics statistics;
    tracer.Intersect(world, &beside, &hits, &statistics);
    for (int k = 0; k < kPacketSize; ++k) {
        if (Agree(AnswerOf(world, beside, hits, k), answer, 10 * distance)) {
            return true;
        }
    }
    return false;
}

}  // namespace cc::test
