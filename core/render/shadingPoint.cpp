#include "core/render/shadingPoint.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cc {
namespace {

/// Rounding errors of a point, in units of the last place of the largest number it is made from.
constexpr float kOffsetUlps = 32;

Vec3f RayDirection(const RayPacket& rays, int lane) {
    return {rays.directionX[lane], rays.directionY[lane], rays.directionZ[lane]};
}

GeometryPoint PointAtHit(const Instance& instance, const RayPacket& rays, const HitPacket& hits,
                         int lane, const LevelMetric& levels) {
    const Vec3f origin{rays.originX[lane], rays.originY[lane], rays.originZ[lane]};
    const Vec3f direction = RayDirection(rays, lane);
    const GeometryHit hit{hits.patch[lane],
                          hits.u[lane],
                          hits.v[lane],
                          instance.worldToObject.Point(origin),
                          instance.worldToObject.Direction(direction),
                          instance.worldToObject.Point(origin + direction * rays.tMax[lane])};
    return instance.geometry->PointAt(hit, instance, levels);
}

float LargestComponent(const Vec3f& v) {
    return std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)});
}

/// The largest number that took part in finding a hit: bounds the rounding errors of its position.
float LargestNumber(const Instance& instance, const Vec3f& objectPosition, const Vec3f& origin,
                    const Vec3f& hitPosition) {
    const AffineTransform& m = instance.objectToWorld;
    const float object = LargestComponent(objectPosition);
    float largest = std::max(LargestComponent(origin), LargestComponent(hitPosition));
    for (int row = 0; row < 3; ++row) {
        const double scale = std::fabs(m(row, 0)) + std::fabs(m(row, 1)) + std::fabs(m(row, 2));
        largest = std::max(largest, static_cast<float>(scale * object));
        largest = std::max(largest, static_cast<float>(std::fabs(m(row, 3))));
    }
    return largest;
}

/// An authored normal in world space, turned to the side that the surface's normal is on: it
/// shades, but does not say what is outside.
Vec3f ShadingNormal(const Instance& instance, const Vec3f& authored, const Vec3f& normal) {
    const Vec3f world = Normalize(instance.worldToObject.NormalByInverse(Normalize(authored)));
    if (world == Vec3f{}) {
        return normal;
    }
    return Dot(world, normal) < 0 ? -world : world;
}

}  // namespace

ShadingPoint MakeShadingPoint(const Instance& instance, const Vec3f& authoredNormal,
                              const RayPacket& rays, const HitPacket& hits, int lane,
                              const LevelMetric& levels) {
    const GeometryPoint own = PointAtHit(instance, rays, hits, lane, levels);
    const Vec3f direction = RayDirection(rays, lane);
    const Vec3f origin{rays.originX[lane], rays.originY[lane], rays.originZ[lane]};
    const Vec3f hitPosition = origin + direction * rays.tMax[lane];

    ShadingPoint point;
    point.position = instance.objectToWorld.Point(own.position);
    point.normal = Normalize(instance.worldToObject.NormalByInverse(own.normal));
    if (own.isBehind) {
        point.normal = -point.normal;
    }
    if (point.normal == Vec3f{}) {
        point.normal = Normalize(-direction);
    }
    point.shadingNormal = ShadingNormal(instance, authoredNormal, point.normal);
    point.du = instance.objectToWorld.Direction(own.du);
    point.dv = instance.objectToWorld.Direction(own.dv);
    // Where the surface is hollow, the quads lie above it and would shadow it; where it bulges, the
    // quads lie below, and on a quad's own plane its neighbours would cast shadows.
    const bool isQuadAbove = Dot(hitPosition - point.position, point.normal) > 0;
    const float offset = kOffsetUlps * std::numeric_limits<float>::epsilon() *
                         LargestNumber(instance, own.position, origin, hitPosition);
    point.rayOrigin = (isQuadAbove ? hitPosition : point.position) + point.normal * offset;
    return point;
}

bool IsHitFromBehind(const Instance& instance, const RayPacket& rays, const HitPacket& hits,
                     int lane, const LevelMetric& levels) {
    return PointAtHit(instance, rays, hits, lane, levels).isBehind;
}

}  // namespace cc
