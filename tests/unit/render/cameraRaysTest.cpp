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

Ray RayAt(const CameraRays& rays, double x, double y, const Vec2f& onLens = {0, 0}) {
    RayPacket packet;
    rays.SetLensRay(x, y, onLens, 3, &packet);
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

Camera CameraWithLens() {
    Camera camera;
    camera.cameraToWorld = Translation(1, 2, 3);
    camera.lensRadius = 0.5f;
    camera.focusDistance = 4;
    return camera;
}

TEST(CameraRays, RaysThroughTheLensMeetAtTheFocusDistance) {
    const Camera camera = CameraWithLens();
    const CameraRays rays(camera, 16, 16);
    ASSERT_TRUE(rays.HasLens());
    const Ray centre = RayAt(rays, 3, 13);
    EXPECT_EQ(centre.origin, (Vec3f{1, 2, 3}));
    for (const Vec2f& onLens : {Vec2f{1, 0}, Vec2f{0, -1}, Vec2f{-0.6f, 0.8f}}) {
        const Ray ray = RayAt(rays, 3, 13, onLens);
        EXPECT_EQ(ray.origin, (Vec3f{1 + 0.5f * onLens.x, 2 + 0.5f * onLens.y, 3}));
        EXPECT_EQ(ray.direction.z, -1);
        const Vec3f apart = ray.origin + ray.direction * 4 - (centre.origin + centre.direction * 4);
        EXPECT_LT(Length(apart), 1e-5f);
    }
}

TEST(CameraRays, OnlyPerspectiveCamerasHaveALens) {
    Camera camera = CameraWithLens();
    camera.orthographic = true;
    const CameraRays orthographic(camera, 16, 16);
    EXPECT_FALSE(orthographic.HasLens());
    EXPECT_EQ(RayAt(orthographic, 3, 5, {1, 0}).origin, RayAt(orthographic, 3, 5).origin);
    camera = CameraWithLens();
    camera.lensRadius = 0;
    EXPECT_FALSE(CameraRays(camera, 16, 16).HasLens());
    camera = CameraWithLens();
    camera.focusDistance = 0;
    EXPECT_FALSE(CameraRays(camera, 16, 16).HasLens());
}

TEST(CameraRays, ClipPlanesCutBothEnds) {
    Camera camera;
    camera.cameraToWorld = Translation(1, 2, 3);
    camera.clipNear = 1;
    camera.clipFar = 9;
    camera.clipPlanes = {{{0, 0, -2}, -4}};  // beyond 2
    EXPECT_EQ(RayAt(CameraRays(camera, 8, 8), 1, 1).tMin, 2);
    EXPECT_EQ(RayAt(CameraRays(camera, 8, 8), 1, 1).tMax, 9);
    camera.clipPlanes.push_back({{0, 0, 1}, 5});  // nearer than 5
    camera.clipPlanes.push_back({{0, 0, 1}, 50});
    EXPECT_EQ(RayAt(CameraRays(camera, 8, 8), 1, 1).tMin, 2);
    EXPECT_EQ(RayAt(CameraRays(camera, 8, 8), 1, 1).tMax, 5);
}

TEST(CameraRays, ClipPlanesSlant) {
    Camera camera;
    camera.clipNear = 1;
    camera.clipFar = 9;
    camera.clipPlanes = {{{1, 0, -1}, -6}};  // where x and distance make 6 or more
    const CameraRays rays(camera, 8, 8);
    EXPECT_FLOAT_EQ(RayAt(rays, 4, 4).tMin, 6);
    EXPECT_FLOAT_EQ(RayAt(rays, 8, 4).tMin, 3);
    const Ray empty = RayAt(rays, 0, 4);  // runs along the plane
    EXPECT_LT(empty.tMax, empty.tMin);
    camera.orthographic = true;
    EXPECT_FLOAT_EQ(RayAt(CameraRays(camera, 8, 8), 8, 4).tMin, 5);
}

TEST(CameraRays, NothingIsLeftBetweenPlanesThatExcludeEachOther) {
    Camera camera;
    camera.clipPlanes = {{{0, 0, -1}, -5}, {{0, 0, 1}, 4}};
    const Ray ray = RayAt(CameraRays(camera, 8, 8), 2, 2);
    EXPECT_LT(ray.tMax, ray.tMin);
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
