#include "core/trace/packetInterval.h"

#include <random>

#include <gtest/gtest.h>

namespace cc::test {
namespace {

/// Rays from one point, or from around it, that spread about a direction.
RayPacket Spread(const Vec3f& origin, const Vec3f& direction, float jitter, float spread, int count,
                 std::mt19937* random) {
    std::uniform_real_distribution<float> unit(-1, 1);
    RayPacket rays;
    rays.count = count;
    for (int i = 0; i < count; ++i) {
        rays.originX[i] = origin.x + jitter * unit(*random);
        rays.originY[i] = origin.y + jitter * unit(*random);
        rays.originZ[i] = origin.z + jitter * unit(*random);
        rays.directionX[i] = direction.x + spread * unit(*random);
        rays.directionY[i] = direction.y + spread * unit(*random);
        rays.directionZ[i] = direction.z + spread * unit(*random);
        rays.tMin[i] = 0.5f;
        rays.tMax[i] = 5;
    }
    return rays;
}

Vec3f PointAt(const RayPacket& rays, int i, float t) {
    return {rays.originX[i] + t * rays.directionX[i], rays.originY[i] + t * rays.directionY[i],
            rays.originZ[i] + t * rays.directionZ[i]};
}

const Vec3f kDirections[] = {{1, 0.1f, 0},  {-1, 0.2f, 0.3f}, {0, 1, 0.2f},
                             {0.3f, -1, 0}, {0, 0.1f, 1},     {0.2f, 0.1f, -1}};

TEST(PacketInterval, NeverCullsABoxThatARayEnters) {
    std::mt19937 random(4);
    std::uniform_real_distribution<float> distance(0.5f, 5), size(0, 0.2f);
    for (const Vec3f& direction : kDirections) {
        for (const int count : {1, 5, 37, 64}) {
            const RayPacket rays = Spread({3, -2, 1}, direction, 0.1f, 0.2f, count, &random);
            ObjectRays local;
            TransformRays(rays, AffineTransform(), &local);
            const PacketInterval interval(local);
            ASSERT_TRUE(interval.IsValid());
            for (int i = 0; i < count; ++i) {
                Box3f box;
                box.Extend(PointAt(rays, i, distance(random)));
                box.Extend(box.lower + Vec3f{size(random), size(random), size(random)});
                EXPECT_FALSE(interval.Culls(box));
            }
        }
    }
}

TEST(PacketInterval, CullsWhatLiesBesideBehindAndBeyond) {
    std::mt19937 random(5);
    for (const Vec3f& direction : kDirections) {
        const Vec3f origin{3, -2, 1};
        const RayPacket rays = Spread(origin, direction, 0.01f, 0.05f, 64, &random);
        ObjectRays local;
        TransformRays(rays, AffineTransform(), &local);
        const PacketInterval interval(local);
        const Vec3f side = Normalize(Cross(direction, {0.3f, 0.5f, 0.8f}));
        for (const Vec3f& center : {origin + direction * 2 + side * 1.5f, origin - direction * 2,
                                    origin + direction * 9}) {
            Box3f box;
            box.Extend(center - Vec3f{0.1f, 0.1f, 0.1f});
            box.Extend(center + Vec3f{0.1f, 0.1f, 0.1f});
            EXPECT_TRUE(interval.Culls(box));
        }
    }
}

TEST(PacketInterval, HitsShortenItsReach) {
    std::mt19937 random(6);
    const RayPacket rays = Spread({0, 0, 0}, {1, 0, 0}, 0, 0.1f, 64, &random);
    ObjectRays local;
    TransformRays(rays, AffineTransform(), &local);
    PacketInterval interval(local);
    Box3f box;
    box.Extend(Vec3f{3, -1, -1});
    box.Extend(Vec3f{4, 1, 1});
    EXPECT_FALSE(interval.Culls(box));
    for (int i = 0; i < 64; ++i) {
        local.tMax[i] = i == 13 ? 1.5f : -1;
    }
    interval.UpdateReach(local);
    EXPECT_TRUE(interval.Culls(box));
}

TEST(PacketInterval, RaysThatRunApartCullNothing) {
    std::mt19937 random(7);
    const RayPacket rays = Spread({0, 0, 0}, {0, 0, 0}, 0, 1, 64, &random);
    ObjectRays local;
    TransformRays(rays, AffineTransform(), &local);
    const PacketInterval interval(local);
    EXPECT_FALSE(interval.IsValid());
    Box3f box;
    box.Extend(Vec3f{100, 100, 100});
    EXPECT_FALSE(interval.Culls(box));
}

}  // namespace
}  // namespace cc::test
