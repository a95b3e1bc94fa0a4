#pragma once

#include <cmath>
#include <memory>
#include <random>
#include <string>

#include "core/trace/instance.h"
#include "core/trace/rayPacket.h"
#include "core/trace/surface.h"
#include "tests/unit/subdiv/testCages.h"

namespace cc::test {

/// A cage's surface, alone in a world, with a transform.
struct TracedCage {
    explicit TracedCage(Cage cage, const AffineTransform& objectToWorld = AffineTransform()) {
        ValidateControlMesh(&cage.mesh, cage.points.size());
        surface = std::make_unique<Surface>(cage.mesh, cage.points);
        Instance instance;
        instance.geometry = surface.get();
        instance.objectToWorld = objectToWorld;
        objectToWorld.Invert(&instance.worldToObject);
        world = InstanceBvh({instance});
    }

    std::unique_ptr<Surface> surface;
    InstanceBvh world;
};

/// A ray that goes on for ever.
inline void SetRay(int i, const Vec3f& origin, const Vec3f& direction, RayPacket* rays) {
    rays->originX[i] = origin.x;
    rays->originY[i] = origin.y;
    rays->originZ[i] = origin.z;
    rays->directionX[i] = direction.x;
    rays->directionY[i] = direction.y;
    rays->directionZ[i] = direction.z;
    rays->tMin[i] = 0;
    rays->tMax[i] = 1e30f;
}

/// Rays of a small pinhole camera that looks at the middle of a box from outside, 8 x 8.
inline RayPacket CameraPacket(const Box3f& box, const Vec3f& from, float width,
                              std::mt19937* random) {
    std::uniform_real_distribution<float> unit(-0.5f, 0.5f);
    const Vec3f eye = box.Center() + from * box.Diagonal();
    const Vec3f target{box.Center().x + unit(*random) * box.Size().x,
                       box.Center().y + unit(*random) * box.Size().y,
                       box.Center().z + unit(*random) * box.Size().z};
    const Vec3f forward = Normalize(target - eye);
    const Vec3f side = Normalize(Cross(forward, {0.3f, 0.8f, 0.5f}));
    const Vec3f up = Cross(side, forward);
    RayPacket rays;
    rays.count = kPacketSize;
    for (int i = 0; i < kPacketSize; ++i) {
        const float x = width * ((i % 8) / 7.0f - 0.5f), y = width * ((i / 8) / 7.0f - 0.5f);
        const Vec3f d = forward + side * x + up * y;
        SetRay(i, eye, d, &rays);
    }
    return rays;
}

/// Rays from all sides through one point, that begin at a distance from it.
inline RayPacket PacketThrough(const Vec3f& point, float distance) {
    RayPacket rays;
    rays.count = kPacketSize;
    for (int i = 0; i < kPacketSize; ++i) {
        const float height = 2 * (static_cast<float>(i) + 0.5f) / kPacketSize - 1;
        const float angle = 2.4f * static_cast<float>(i), width = std::sqrt(1 - height * height);
        const Vec3f direction{width * std::cos(angle), width * std::sin(angle), height};
        SetRay(i, point - direction * distance, direction, &rays);
    }
    return rays;
}

inline Vec3f PointOf(const RayPacket& rays, int i) {
    const float t = rays.tMax[i];
    return {rays.originX[i] + t * rays.directionX[i], rays.originY[i] + t * rays.directionY[i],
            rays.originZ[i] + t * rays.directionZ[i]};
}

/// Faces of these coincide: which of them a ray meets first is up to rounding.
inline bool HasCoincidentFaces(const Cage& cage) {
    return cage.name == "two triangles back to back" ||
           cage.name.find("face twice") != std::string::npos ||
           cage.name.find("touche") != std::string::npos;
}

}  // namespace cc::test
