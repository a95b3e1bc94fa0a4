#include "core/render/directLight.h"

#include <chrono>
#include <cmath>

namespace cc {
namespace {

constexpr float kInversePi = 0.318309886f;

/// A shadow ray ends this much before a light, in parts of its length.
constexpr float kLightClearance = 1e-4f;

/// Light that arrives at a point from one light, if nothing is in the way.
struct Arrival {
    Vec3f irradiance;
    Vec3f towardsLight;
    float distance;  ///< in lengths of towardsLight
};

/// Longer than any ray from a point through the scene.
float DistanceBeyond(const Box3f& bounds, const Vec3f& point) {
    return 2 * (Length(point - bounds.Center()) + bounds.Diagonal()) + 1;
}

Arrival ArrivalAt(const ShadingPoint& point, const Light& light, const Box3f& bounds) {
    Arrival arrival;
    float strength = 1;
    if (light.kind == Light::Kind::Distant) {
        arrival.towardsLight = Normalize(-light.direction);
        arrival.distance = DistanceBeyond(bounds, point.rayOrigin);
    } else {
        arrival.towardsLight = light.position - point.rayOrigin;
        arrival.distance = 1 - kLightClearance;
        strength = 1 / Dot(arrival.towardsLight, arrival.towardsLight);
    }
    const Vec3f direction = Normalize(arrival.towardsLight);
    // What lies behind the surface does not light it, whatever an authored normal says.
    const float cosine = Dot(point.normal, direction) > 0 ? Dot(point.shadingNormal, direction) : 0;
    arrival.irradiance = light.power * (strength * cosine);
    const bool arrives = cosine > 0 && std::isfinite(strength) && IsFinite(arrival.irradiance);
    return arrives ? arrival : Arrival{};
}

void AppendRay(const Vec3f& origin, const Vec3f& direction, float length, RayPacket* rays) {
    const int lane = rays->count++;
    rays->originX[lane] = origin.x;
    rays->originY[lane] = origin.y;
    rays->originZ[lane] = origin.z;
    rays->directionX[lane] = direction.x;
    rays->directionY[lane] = direction.y;
    rays->directionZ[lane] = direction.z;
    rays->tMin[lane] = 0;
    rays->tMax[lane] = length;
}

uint64_t TraceShadows(const Scene& scene, const Tracer& tracer, const RayPacket& rays,
                      RenderWorker* worker) {
    if (rays.count == 0) {
        return 0;
    }
    const auto start = std::chrono::steady_clock::now();
    const uint64_t occluded =
        tracer.Occluded(scene.Instances(), rays, &worker->statistics.trace, &worker->grids);
    worker->statistics.shadowSeconds +=
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    worker->statistics.shadowRays += rays.count;
    return occluded;
}

}  // namespace

void AddDirectLight(const Scene& scene, const Tracer& tracer, const ShadingPoint* points, int count,
                    Vec3f* radiance, RenderWorker* worker) {
    const Box3f bounds = scene.Instances().Bounds();
    for (const auto& light : scene.Lights()) {
        RayPacket rays;
        int pointOfRay[kPacketSize];
        Vec3f irradianceOfRay[kPacketSize];
        for (int i = 0; i < count; ++i) {
            const Arrival arrival = ArrivalAt(points[i], *light, bounds);
            if (arrival.irradiance != Vec3f{}) {
                pointOfRay[rays.count] = i;
                irradianceOfRay[rays.count] = arrival.irradiance;
                AppendRay(points[i].rayOrigin, arrival.towardsLight, arrival.distance, &rays);
            }
        }
        const uint64_t occluded =
            light->castsShadows ? TraceShadows(scene, tracer, rays, worker) : 0;
        for (int ray = 0; ray < rays.count; ++ray) {
            if (!(occluded >> ray & 1)) {
                const int i = pointOfRay[ray];
                radiance[i] += points[i].albedo * irradianceOfRay[ray] * kInversePi;
            }
        }
    }
}

}  // namespace cc
