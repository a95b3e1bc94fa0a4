#include "rayMaker.h"

#include <cmath>
#include <limits>

#include "core/subdiv/limitPoint.h"
#include "tracing.h"

namespace {

constexpr int kTile = 8;
/// Tiles are in the order of the renderer's: block by block, so that neighbours follow each other.
constexpr int kBlock = 8 * kTile;
/// How far secondary rays start from the surface, in shares of the hit's distance: more than any
/// tessellation of it is off by.
constexpr float kOffset = 2e-4f;
/// Shadow rays end just before the light.
constexpr float kAlmostOne = 0.9999f;

/// The square window in the middle of the camera's.
struct Window {
    explicit Window(const cc::Camera& camera) {
        const cc::Vec2f a = camera.windowLower, b = camera.windowUpper;
        side = std::min(b.x - a.x, b.y - a.y);
        lower = {0.5f * (a.x + b.x - side), 0.5f * (a.y + b.y - side)};
    }
    cc::Vec2f lower;
    float side;
};

Ray MakePrimaryRay(const cc::Camera& camera, float x, float y) {
    const cc::Vec3f inWindow{x, y, 0}, along{0, 0, -1};
    const bool isFlat = camera.orthographic;
    Ray ray;
    ray.origin = camera.cameraToWorld.Point(isFlat ? inWindow : cc::Vec3f{});
    ray.direction = camera.cameraToWorld.Direction(isFlat ? along : inWindow + along);
    ray.tMin = camera.clipNear;
    ray.tMax = camera.clipFar;
    return ray;
}

/// A point that was hit, moved off the surface to the side that the ray came from.
struct HitPoint {
    cc::Vec3f position, normal, incoming;
};

HitPoint PointOfHit(const cc::Scene& scene, const Ray& ray, float t, const cc::HitPacket& hits,
                    size_t lane) {
    const cc::Instance& instance = scene.Instances().Instances()[hits.instance[lane]];
    const cc::Surface& surface = cc::SurfaceOf(instance);
    const cc::LimitPoint limit =
        EvaluateLimit(surface.Patches(), hits.patch[lane], surface.PatchPoints().data(),
                      hits.u[lane], hits.v[lane]);
    cc::Vec3f normal = Normalize(instance.worldToObject.NormalByInverse(limit.normal));
    if (Dot(normal, ray.direction) > 0) {
        normal = -normal;
    }
    const float away = kOffset * t * Length(ray.direction);
    return {ray.origin + t * ray.direction + away * normal, normal, ray.direction};
}

/// What up to 64 rays hit; those that miss leave no point.
std::vector<HitPoint> HitPoints(const cc::Scene& scene, const cc::Tracer& tracer, const Ray* rays,
                                size_t count) {
    cc::RayPacket packet;
    cc::HitPacket hits;
    cc::TraceStatistics statistics;
    FillPacket(rays, static_cast<int>(count), &packet);
    tracer.Intersect(scene.Instances(), &packet, &hits, &statistics);
    std::vector<HitPoint> points;
    for (size_t i = 0; i < count; ++i) {
        if (hits.instance[i] != cc::kNoHit) {
            points.push_back(PointOfHit(scene, rays[i], packet.tMax[i], hits, i));
        }
    }
    return points;
}

void AddShadowRays(const std::vector<HitPoint>& points, const std::array<cc::Vec3f, 2>& lights,
                   RaySet* set) {
    for (const cc::Vec3f& light : lights) {
        std::vector<Ray> packet;
        for (const HitPoint& point : points) {
            const cc::Vec3f way = light - point.position;
            if (Dot(way, point.normal) > 0) {
                packet.push_back({point.position, 0, way, kAlmostOne});
            }
        }
        set->AddPacket(packet);
    }
}

std::vector<Ray> MirroredRays(const std::vector<HitPoint>& points) {
    std::vector<Ray> rays;
    for (const HitPoint& point : points) {
        const cc::Vec3f& in = point.incoming;
        const cc::Vec3f out = in - 2 * Dot(in, point.normal) * point.normal;
        rays.push_back({point.position, 0, Normalize(out), std::numeric_limits<float>::max()});
    }
    return rays;
}

}  // namespace

void MakeSquare(cc::Camera* camera) {
    const Window window(*camera);
    camera->windowLower = window.lower;
    camera->windowUpper = {window.lower.x + window.side, window.lower.y + window.side};
}

RaySet MakePrimaryRays(const cc::Camera& camera, int size) {
    const Window window(camera);
    const float pixel = window.side / static_cast<float>(size);
    RaySet set;
    set.name = "primary";
    const auto addTile = [&](int x0, int y0) {
        std::vector<Ray> tile;
        for (int y = y0; y < std::min(y0 + kTile, size); ++y) {
            for (int x = x0; x < std::min(x0 + kTile, size); ++x) {
                tile.push_back(MakePrimaryRay(camera, window.lower.x + (x + 0.5f) * pixel,
                                              window.lower.y + (y + 0.5f) * pixel));
            }
        }
        set.AddPacket(tile);
    };
    const auto addBlock = [&](int x0, int y0) {
        for (int y = y0; y < std::min(y0 + kBlock, size); y += kTile) {
            for (int x = x0; x < std::min(x0 + kBlock, size); x += kTile) {
                addTile(x, y);
            }
        }
    };
    for (int y = 0; y < size; y += kBlock) {
        for (int x = 0; x < size; x += kBlock) {
            addBlock(x, y);
        }
    }
    return set;
}

std::vector<RaySet> MakeSecondaryRays(const cc::Scene& scene,
                                      const std::array<cc::Vec3f, 2>& lights, const RaySet& primary,
                                      const cc::Tracer& tracer) {
    RaySet shadow, reflection, reflectionShadow;
    shadow.name = "shadow";
    reflection.name = "reflection";
    reflectionShadow.name = "reflection-shadow";
    shadow.anyHit = reflectionShadow.anyHit = true;
    const Ray* rays = primary.rays.data();
    for (const uint8_t count : primary.packetSizes) {
        const std::vector<HitPoint> seen = HitPoints(scene, tracer, rays, count);
        AddShadowRays(seen, lights, &shadow);
        const std::vector<Ray> mirrored = MirroredRays(seen);
        AddShadowRays(HitPoints(scene, tracer, mirrored.data(), mirrored.size()), lights,
                      &reflectionShadow);
        reflection.AddPacket(mirrored);
        rays += count;
    }
    return {std::move(shadow), std::move(reflection), std::move(reflectionShadow)};
}
