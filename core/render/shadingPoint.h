#pragma once

#include "core/math/vec.h"
#include "core/trace/instance.h"
#include "core/trace/levelMetric.h"
#include "core/trace/rayPacket.h"

namespace cc {

/// What shading needs to know of a hit, in world space.
struct ShadingPoint {
    Vec3f position;  ///< on the limit surface
    Vec3f normal;    ///< unit, of the limit surface, on the side that is seen
    /// What light is measured against: unit, and on the side that normal is on. It is normal itself
    /// unless the scene gives another.
    Vec3f shadingNormal;
    /// Derivatives of the position by the parameters of the authored face (FaceParameter).
    Vec3f du, dv;
    /// Where rays that leave on that side begin: clear of the quads that are traced.
    Vec3f rayOrigin;
    Vec3f albedo;
};

/// Makes all but the albedo.
/// @param authoredNormal  in object space and of any length; zero for the surface's own
/// @param lane   of a ray that hit the instance
/// @param levels  that the tracer traced
ShadingPoint MakeShadingPoint(const Instance& instance, const Vec3f& authoredNormal,
                              const RayPacket& rays, const HitPacket& hits, int lane,
                              const LevelMetric& levels);

/// True if a ray hit the inner side: the one that the limit surface's normal points away from.
bool IsHitFromBehind(const Instance& instance, const RayPacket& rays, const HitPacket& hits,
                     int lane, const LevelMetric& levels);

}  // namespace cc
