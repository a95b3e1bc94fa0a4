#include "core/scene/lightUnits.h"

#include <gtest/gtest.h>

#include <limits>

namespace cc {
namespace {

constexpr float kPi = 3.14159265f;

TEST(LightUnits, RadianceIsTheProductOfItsControls) {
    LightUnits units;
    units.intensity = 3;
    units.exposure = 2;
    units.diffuse = 0.5f;
    units.color = {1, 0.5f, 0};
    EXPECT_EQ(LightRadiance(units), (Vec3f{6, 3, 0}));
}

TEST(LightUnits, DistantLightIntegratesItsCone) {
    LightUnits units;
    units.angle = 180;
    EXPECT_NEAR(DistantLightPower(units).x, kPi, 1e-5);
    units.angle = 360;
    EXPECT_NEAR(DistantLightPower(units).x, 2 * kPi, 1e-5);
    units.angle = 60;
    EXPECT_NEAR(DistantLightPower(units).x, kPi / 4, 1e-5);
    units.normalize = true;
    EXPECT_EQ(DistantLightPower(units).x, 1);
    units.normalize = false;
    units.angle = 0;
    EXPECT_EQ(DistantLightPower(units).x, 1);
}

TEST(LightUnits, RecordersCameraLightGivesAboutUnitIrradiance) {
    LightUnits units;
    units.intensity = 15000;
    EXPECT_NEAR(DistantLightPower(units).x, 1.008f, 1e-3);
}

TEST(LightUnits, SphereLightGrowsWithItsDisk) {
    LightUnits units;
    EXPECT_NEAR(SphereLightPower(units).x, kPi / 4, 1e-6);
    units.scale = 2;
    EXPECT_NEAR(SphereLightPower(units).x, kPi, 1e-6);
    units.normalize = true;
    EXPECT_NEAR(SphereLightPower(units).x, 0.25f, 1e-6);
}

TEST(LightUnits, PointHasTheLimitOfANormalizedSphere) {
    LightUnits units;
    units.radius = 0;
    EXPECT_EQ(SphereLightPower(units).x, 0);
    units.treatAsPoint = true;
    EXPECT_EQ(SphereLightPower(units).x, 0.25f);
}

TEST(LightUnits, BlackbodyColorHasTheLuminanceOfWhite) {
    for (float kelvin = 2000; kelvin <= 10000; kelvin += 500) {
        const Vec3f color = BlackbodyColor(kelvin);
        EXPECT_NEAR(Dot(color, {0.2126f, 0.7152f, 0.0722f}), 1, 2e-3) << kelvin;
    }
    EXPECT_GT(BlackbodyColor(2000).x, BlackbodyColor(2000).z);
    EXPECT_LT(BlackbodyColor(9000).x, BlackbodyColor(9000).z);
    EXPECT_EQ(BlackbodyColor(500), BlackbodyColor(1000));
}

TEST(LightUnits, WhatIsNoPowerIsTold) {
    EXPECT_TRUE(IsUsableLightPower({0, 1, 2}));
    EXPECT_FALSE(IsUsableLightPower({0, -1, 2}));
    EXPECT_FALSE(IsUsableLightPower({std::numeric_limits<float>::quiet_NaN(), 1, 2}));
    EXPECT_FALSE(IsUsableLightPower({std::numeric_limits<float>::infinity(), 1, 2}));
}

}  // namespace
}  // namespace cc
