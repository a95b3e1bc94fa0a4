#include "core/render/shadingPoint.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "core/subdiv/limitPoint.h"
#include "core/trace/instanceLevels.h"

namespace cc {
namespace {

/// Below this cosine between ray and normal, the limit surface may turn away from a ray that hit
/// the side of a triangle that faces it. The coarser the triangles, the more they may be off.
float GrazingCosine(int level) { return level < 2 ? 1 / static_cast<float>(1 << level) : 0.25f; }

/// Rounding errors of a point, in units of the last place of the largest number it is made from.
constexpr float kOffsetUlps = 32;

Vec3f RayDirection(const RayPacket& rays, int lane) {
    return {rays.directionX[lane], rays.directionY[lane], rays.directionZ[lane]};
}

LimitPoint LimitAtHit(const Instance& instance, const HitPacket& hits, int lane) {
    const Surface& surface = *instance.surface;
    return EvaluateLimit(surface.Patches(), hits.patch[lane], surface.PatchPoints().data(),
                         hits.u[lane], hits.v[lane]);
}

/// Normal of the traced triangle that a point of a patch lies on, in object space and of any
/// length. The patch has so many segments along u and v.
/// @param corner  gives the surface at parameters
template <class Corner>
Vec3f NormalInQuad(const Corner& corner, int segments, float u, float v) {
    const float size = 1 / static_cast<float>(segments);
    const float u0 = std::min(std::floor(u * segments), segments - 1.0f) * size;
    const float v0 = std::min(std::floor(v * segments), segments - 1.0f) * size;
    // Quads are cut from (0,0) to (1,1).
    const Vec3f origin = corner(u0, v0);
    const Vec3f diagonal = corner(u0 + size, v0 + size) - origin;
    return u - u0 > v - v0 ? Cross(corner(u0 + size, v0) - origin, diagonal)
                           : Cross(diagonal, corner(u0, v0 + size) - origin);
}

/// The same in a triangular patch: it is cut into upright triangles and, between those, turned
/// ones.
template <class Corner>
Vec3f NormalInTriangle(const Corner& corner, int segments, float u, float v) {
    const float size = 1 / static_cast<float>(segments);
    float column = std::floor(u * segments), row = std::floor(v * segments);
    // On the long edge there is no triangle further on.
    if (column + row >= segments) {
        (row > 0 ? row : column) -= 1;
    }
    const bool isTurned =
        column + row + 1 < segments && (u * segments - column) + (v * segments - row) > 1;
    const float turn = isTurned ? -size : size;
    const float u0 = (column + isTurned) * size, v0 = (row + isTurned) * size;
    const Vec3f origin = corner(u0, v0);
    return Cross(corner(u0 + turn, v0) - origin, corner(u0, v0 + turn) - origin);
}

Vec3f TriangleNormal(const Surface& surface, uint32_t patch, float u, float v, int level) {
    const PatchTable& patches = surface.Patches();
    const int splits = level - patches.At(patch).depth;
    const auto corner = [&](float cu, float cv) {
        return EvaluateLimitValue(patches, patch, surface.PatchPoints().data(), cu, cv);
    };
    return patches.IsTriangle(patch) ? NormalInTriangle(corner, 1 << splits, u, v)
                                     : NormalInQuad(corner, 1 << splits, u, v);
}

bool IsBehind(const Instance& instance, const LimitPoint& limit, const RayPacket& rays,
              const HitPacket& hits, int lane, const LevelMetric& levels) {
    const PatchLevels of = InstanceLevels(levels, instance).Of(hits.patch[lane]);
    const Vec3f direction = Normalize(instance.worldToObject.Direction(RayDirection(rays, lane)));
    const float cosine = Dot(limit.normal, direction);
    if (std::fabs(cosine) > GrazingCosine(of.Coarsest())) {
        return cosine > 0;
    }
    // At silhouettes the triangle decides: a flipped normal would be lit from the far side.
    const Vec3f normal = TriangleNormal(*instance.surface, hits.patch[lane], hits.u[lane],
                                        hits.v[lane], of.interior);
    const float orientation = Dot(normal, limit.normal);
    return orientation == 0 ? cosine > 0 : (Dot(normal, direction) > 0) == (orientation > 0);
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
    const LimitPoint limit = LimitAtHit(instance, hits, lane);
    const Vec3f direction = RayDirection(rays, lane);
    const Vec3f origin{rays.originX[lane], rays.originY[lane], rays.originZ[lane]};
    const Vec3f hitPosition = origin + direction * rays.tMax[lane];

    ShadingPoint point;
    point.position = instance.objectToWorld.Point(limit.position);
    point.normal = Normalize(instance.worldToObject.NormalByInverse(limit.normal));
    if (IsBehind(instance, limit, rays, hits, lane, levels)) {
        point.normal = -point.normal;
    }
    if (point.normal == Vec3f{}) {
        point.normal = Normalize(-direction);
    }
    point.shadingNormal = ShadingNormal(instance, authoredNormal, point.normal);
    const LimitPoint onFace = ByFaceParameter(instance.surface->Patches(), hits.patch[lane], limit);
    point.du = instance.objectToWorld.Direction(onFace.du);
    point.dv = instance.objectToWorld.Direction(onFace.dv);
    // Where the surface is hollow, the quads lie above it and would shadow it; where it bulges, the
    // quads lie below, and on a quad's own plane its neighbours would cast shadows.
    const bool isQuadAbove = Dot(hitPosition - point.position, point.normal) > 0;
    const float offset = kOffsetUlps * std::numeric_limits<float>::epsilon() *
                         LargestNumber(instance, limit.position, origin, hitPosition);
    point.rayOrigin = (isQuadAbove ? hitPosition : point.position) + point.normal * offset;
    return point;
}

bool IsHitFromBehind(const Instance& instance, const RayPacket& rays, const HitPacket& hits,
                     int lane, const LevelMetric& levels) {
    return IsBehind(instance, LimitAtHit(instance, hits, lane), rays, hits, lane, levels);
}

}  // namespace cc
