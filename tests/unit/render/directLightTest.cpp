#include "core/render/directLight.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/unit/render/renderTestKit.h"

namespace cc::test {
namespace {

constexpr float kPi = 3.14159265f;

/// A white point at the origin that faces +z.
ShadingPoint PointUp() {
    ShadingPoint point{};
    point.normal = point.shadingNormal = {0, 0, 1};
    point.rayOrigin = {0, 0, 1e-4f};
    point.albedo = {1, 1, 1};
    return point;
}

/// Light that a point sends on.
Vec3f Lit(Scene* scene, const ShadingPoint& point, RenderWorker* worker) {
    scene->Build({"geometry"});
    Vec3f radiance;
    AddDirectLight(*scene, *MakeTracer(TracerKind::Packet, 3), &point, 1, &radiance, worker);
    return radiance;
}

Vec3f Lit(Scene* scene, const ShadingPoint& point = PointUp()) {
    RenderWorker worker;
    return Lit(scene, point, &worker);
}

Light* AddDistant(Scene* scene, const Vec3f& direction, const Vec3f& power) {
    Light* light = scene->AddLight();
    light->direction = Normalize(direction);
    light->power = power;
    return light;
}

Light* AddSphere(Scene* scene, const Vec3f& position, const Vec3f& power) {
    Light* light = scene->AddLight();
    light->kind = Light::Kind::Sphere;
    light->position = position;
    light->power = power;
    return light;
}

TEST(DirectLight, NoLightIsBlack) {
    Scene scene;
    EXPECT_EQ(Lit(&scene), (Vec3f{}));
}

TEST(DirectLight, DistantLightFallsWithTheCosine) {
    Scene scene;
    AddDistant(&scene, {0, 1, -1}, {kPi, 2 * kPi, 0});
    const Vec3f lit = Lit(&scene);
    EXPECT_NEAR(lit.x, std::sqrt(0.5f), 1e-5f);
    EXPECT_NEAR(lit.y, 2 * std::sqrt(0.5f), 1e-5f);
    EXPECT_EQ(lit.z, 0);
}

TEST(DirectLight, SphereLightFallsWithTheSquaredDistance) {
    Scene scene;
    AddSphere(&scene, {0, 0, 4}, {kPi, kPi, kPi});
    EXPECT_NEAR(Lit(&scene).x, 1 / 16.0f, 1e-4f);
}

TEST(DirectLight, AlbedoColorsTheLightAndLightsAddUp) {
    Scene scene;
    AddDistant(&scene, {0, 0, -1}, {kPi, kPi, kPi});
    AddDistant(&scene, {0, 0, -1}, {kPi, kPi, kPi});
    ShadingPoint point = PointUp();
    point.albedo = {0.5f, 0.25f, 0};
    const Vec3f lit = Lit(&scene, point);
    EXPECT_NEAR(lit.x, 1, 1e-5f);
    EXPECT_NEAR(lit.y, 0.5f, 1e-5f);
    EXPECT_EQ(lit.z, 0);
}

TEST(DirectLight, LightFromBehindIsNoLightAndNeedsNoRay) {
    Scene scene;
    AddDistant(&scene, {0, 0, 1}, {1, 1, 1});
    AddSphere(&scene, {0, 0, -3}, {1, 1, 1});
    RenderWorker worker;
    EXPECT_EQ(Lit(&scene, PointUp(), &worker), (Vec3f{}));
    EXPECT_EQ(worker.statistics.shadowRays, 0u);
}

TEST(DirectLight, WhatIsBetweenCastsAShadow) {
    Scene scene;
    AddCage(&scene, "/roof", Square())->SetTransform(Placed(1, 0, 0, 2));
    Light* above = AddSphere(&scene, {0, 0, 4}, {1, 1, 1});
    RenderWorker worker;
    EXPECT_EQ(Lit(&scene, PointUp(), &worker), (Vec3f{}));
    EXPECT_EQ(worker.statistics.shadowRays, 1u);
    above->castsShadows = false;
    EXPECT_GT(Lit(&scene).x, 0);
    above->castsShadows = true;
    // What is behind the light casts none.
    above->position = {0, 0, 1.99f};
    EXPECT_GT(Lit(&scene).x, 0);
}

TEST(DirectLight, DistantShadowsReachThroughTheScene) {
    Scene scene;
    AddCage(&scene, "/roof", Square())->SetTransform(Placed(1e4, 0, 0, 1e6));
    AddDistant(&scene, {0, 0, -1}, {1, 1, 1});
    EXPECT_EQ(Lit(&scene), (Vec3f{}));
}

TEST(DirectLight, OddLightsAreNoLight) {
    Scene scene;
    AddDistant(&scene, {NAN, 0, -1}, {1, 1, 1});
    AddDistant(&scene, {0, 0, 0}, {1, 1, 1});
    AddDistant(&scene, {0, 0, -1}, {INFINITY, 1, 1});
    AddSphere(&scene, PointUp().rayOrigin, {1, 1, 1});
    AddSphere(&scene, {0, 0, INFINITY}, {1, 1, 1});
    EXPECT_EQ(Lit(&scene), (Vec3f{}));
}

}  // namespace
}  // namespace cc::test
