#include "core/render/cameraRays.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace cc {
namespace {

AffineTransform Translation(double x, double y, double z) {
    return AffineTransform({{{1, 0, 0, x}, {0, 1, 0, y}, {0, 0, 1, z}}});
}

struct Ray {
    Vec3f origin, direction;
    float tMin, tMax;
};

Ray RayAt(const CameraRays& rays, double x, double y) {
    RayPacket packet;
    rays.SetRay(x, y, 3, &packet);
    return {{packet.originX[3], packet.originY[3], packet.originZ[3]},
            {packet.directionX[3], packet.directionY[3], packet.directionZ[3]},
            packet.tMin[3],
            packet.tMax[3]};
}

TEST(CameraRays, PerspectiveRaysFanOutFromTheEye) {
    Camera camera;
    camera.cameraToWorld = Translation(1, 2, 3);
    camera.windowLower = {-2, -1};
    camera.windowUpper = {2, 1};
    const CameraRays rays(camera, 40, 20);
    ASSERT_TRUE(rays.IsValid());
    const Ray lowerLeft = RayAt(rays, 0, 0), middle = RayAt(rays, 20, 10);
    EXPECT_EQ(lowerLeft.origin, (Vec3f{1, 2, 3}));
    EXPECT_EQ(lowerLeft.direction, (Vec3f{-2, -1, -1}));
    EXPECT_EQ(middle.direction, (Vec3f{0, 0, -1}));
}

TEST(CameraRays, OrthographicRaysAreParallel) {
    Camera camera;
    camera.orthographic = true;
    camera.cameraToWorld = Translation(1, 2, 3);
    const CameraRays rays(camera, 10, 10);
    const Ray ray = RayAt(rays, 10, 0);
    EXPECT_EQ(ray.origin, (Vec3f{2, 1, 3}));
    EXPECT_EQ(ray.direction, (Vec3f{0, 0, -1}));
}

TEST(CameraRays, TheParameterIsTheDistanceAlongTheViewAxis) {
    Camera camera;
    // Looks along +x, with scale 2: t stays a distance in camera space.
    camera.cameraToWorld = AffineTransform({{{0, 0, -2, 5}, {0, 2, 0, 0}, {2, 0, 0, 0}}});
    camera.clipNear = 0.5f;
    camera.clipFar = 8;
    const CameraRays rays(camera, 16, 16);
    AffineTransform worldToCamera;
    ASSERT_TRUE(camera.cameraToWorld.Invert(&worldToCamera));
    const Ray ray = RayAt(rays, 2.25, 13.5);
    EXPECT_EQ(ray.tMin, 0.5f);
    EXPECT_EQ(ray.tMax, 8);
    for (const float t : {0.5f, 3.0f, 8.0f}) {
        EXPECT_NEAR(worldToCamera.Point(ray.origin + ray.direction * t).z, -t, 1e-5f);
    }
}

TEST(CameraRays, DepthIsProjected) {
    Camera camera;
    camera.clipNear = 2;
    camera.clipFar = 10;
    const CameraRays perspective(camera, 4, 4);
    EXPECT_FLOAT_EQ(perspective.ProjectedDepth(2), 0);
    EXPECT_FLOAT_EQ(perspective.ProjectedDepth(10), 1);
    EXPECT_FLOAT_EQ(perspective.ProjectedDepth(4), (1 / 2.0f - 1 / 4.0f) / (1 / 2.0f - 1 / 10.0f));
    camera.orthographic = true;
    EXPECT_FLOAT_EQ(CameraRays(camera, 4, 4).ProjectedDepth(4), 0.25f);
}

TEST(CameraRays, DepthIsNeverNan) {
    Camera camera;
    camera.clipNear = -1;
    camera.clipFar = std::numeric_limits<float>::infinity();
    const CameraRays rays(camera, 4, 4);
    ASSERT_TRUE(rays.IsValid());
    EXPECT_EQ(RayAt(rays, 1, 1).tMin, 0);
    EXPECT_TRUE(std::isfinite(RayAt(rays, 1, 1).tMax));
    EXPECT_EQ(rays.ProjectedDepth(5), 1);
}

TEST(CameraRays, CameraNormalsTurnWithTheCamera) {
    Camera camera;
    camera.cameraToWorld = AffineTransform({{{0, 0, -3, 5}, {0, 3, 0, 0}, {3, 0, 0, 0}}});
    const Vec3f n = CameraRays(camera, 4, 4).CameraNormal({-1, 0, 0});
    EXPECT_EQ(n, (Vec3f{0, 0, 1}));
}

TEST(CameraRays, RefusesCamerasThatShowNothing) {
    const Camera good;
    EXPECT_TRUE(CameraRays(good, 4, 4).IsValid());
    EXPECT_FALSE(CameraRays(good, 0, 0).IsValid());
    Camera flat;
    flat.cameraToWorld = AffineTransform({{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 0, 0}}});
    EXPECT_FALSE(CameraRays(flat, 4, 4).IsValid());
    Camera swapped;
    swapped.clipNear = 10;
    swapped.clipFar = 1;
    EXPECT_FALSE(CameraRays(swapped, 4, 4).IsValid());
    Camera nan;
    nan.windowLower.x = NAN;
    EXPECT_FALSE(CameraRays(nan, 4, 4).IsValid());
    nan = {};
    nan.clipFar = NAN;
    EXPECT_FALSE(CameraRays(nan, 4, 4).IsValid());
}

}  // namespace
}  // namespace cc
