#include "core/trace/spheres.h"

#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "core/trace/levelMetric.h"
#include "core/trace/tracer.h"
#include "tests/unit/trace/traceKit.h"

namespace cc::test {
namespace {

constexpr TracerKind kKinds[] = {TracerKind::Packet, TracerKind::Algorithm1,
                                 TracerKind::Algorithm1WithTexture, TracerKind::Single,
                                 TracerKind::Tessellated};

/// Spheres in a world, with a transform.
struct TracedSpheres {
    explicit TracedSpheres(std::vector<Sphere> from,
                           const AffineTransform& objectToWorld = AffineTransform())
        : spheres(std::move(from)) {
        Instance instance;
        instance.geometry = &spheres;
        instance.objectToWorld = objectToWorld;
        objectToWorld.Invert(&instance.worldToObject);
        world = InstanceBvh({instance});
    }

    Spheres spheres;
    InstanceBvh world;
};

/// What a ray hits, in doubles, by the quadratic formula itself.
struct Expected {
    uint32_t sphere = kNoHit;
    double t = HUGE_VAL;
    double clearance = HUGE_VAL;  ///< least distance of the line from grazing a sphere, in radii
};

Expected Expect(const Spheres& spheres, const RayPacket& rays, int i) {
    const double o[3] = {rays.originX[i], rays.originY[i], rays.originZ[i]};
    const double d[3] = {rays.directionX[i], rays.directionY[i], rays.directionZ[i]};
    Expected expected;
    for (uint32_t s = 0; s < spheres.PrimitiveCount(); ++s) {
        const Sphere& sphere = spheres.At(s);
        double a = 0, b = 0, c = -double(sphere.radius) * sphere.radius;
        for (int axis = 0; axis < 3; ++axis) {
            const double f = o[axis] - sphere.center[axis];
            a += d[axis] * d[axis];
            b += f * d[axis];
            c += f * f;
        }
        const double discriminant = b * b - a * c;
        expected.clearance =
            std::min(expected.clearance,
                     std::fabs(discriminant) / (a * double(sphere.radius) * sphere.radius));
        if (discriminant < 0) {
            continue;
        }
        for (const double sign : {-1.0, 1.0}) {
            const double t = (-b + sign * std::sqrt(discriminant)) / a;
            if (t > rays.tMin[i] && t < rays.tMax[i] && t < expected.t) {
                expected.sphere = s;
                expected.t = t;
            }
        }
    }
    return expected;
}

std::vector<Sphere> RandomSpheres(int count, std::mt19937* random) {
    std::uniform_real_distribution<float> unit(-1, 1), size(0.01f, 0.25f);
    std::vector<Sphere> spheres;
    for (int i = 0; i < count; ++i) {
        spheres.push_back({{unit(*random), unit(*random), unit(*random)}, size(*random)});
    }
    return spheres;
}

/// Rays among the spheres, many of which begin or end inside one.
RayPacket RandomRays(std::mt19937* random) {
    std::uniform_real_distribution<float> unit(-1, 1), length(0.2f, 3);
    RayPacket rays;
    rays.count = kPacketSize - 3;
    for (int i = 0; i < rays.count; ++i) {
        SetRay(i, Vec3f{unit(*random), unit(*random), unit(*random)} * 1.5f,
               {unit(*random), unit(*random), unit(*random)}, &rays);
        rays.tMin[i] = i % 3 == 0 ? 0.2f * length(*random) : 0;
        rays.tMax[i] = i % 5 == 0 ? length(*random) : 1e30f;
    }
    return rays;
}

class SpheresTest : public testing::TestWithParam<TracerKind> {};

TEST_P(SpheresTest, AreHitWhereTheQuadraticFormulaSays) {
    std::mt19937 random(3);
    const auto tracer = MakeTracer(GetParam(), LevelMetric(2));
    const TracedSpheres traced(RandomSpheres(60, &random));
    int hitCount = 0;
    for (int packet = 0; packet < 60; ++packet) {
        const RayPacket from = RandomRays(&random);
        RayPacket rays = from;
        HitPacket hits;
        TraceStatistics statistics;
        tracer->Intersect(traced.world, &rays, &hits, &statistics);
        const uint64_t occluded = tracer->Occluded(traced.world, from, &statistics);
        for (int i = 0; i < rays.count; ++i) {
            const Expected expected = Expect(traced.spheres, from, i);
            if (expected.clearance < 1e-4) {
                continue;
            }
            ASSERT_EQ(hits.patch[i], expected.sphere);
            EXPECT_EQ(occluded >> i & 1, expected.sphere != kNoHit);
            if (expected.sphere != kNoHit) {
                ++hitCount;
                EXPECT_EQ(hits.instance[i], 0u);
                EXPECT_NEAR(rays.tMax[i], expected.t, 2e-5 * (1 + expected.t));
            }
        }
    }
    EXPECT_GT(hitCount, 500);
}

TEST_P(SpheresTest, ThatAreSmallAndFarAwayAreRound) {
    // Of the textbook's discriminant, nothing is left at this distance.
    const float distance = 3000, radius = 0.01f;
    const TracedSpheres traced({{{0, 0, -distance}, radius}});
    const auto tracer = MakeTracer(GetParam(), LevelMetric(2));
    RayPacket rays;
    rays.count = kPacketSize;
    for (int i = 0; i < kPacketSize; ++i) {
        const float beside = 2 * radius * (static_cast<float>(i) + 0.5f) / kPacketSize;
        SetRay(i, {beside, 0, 0}, {0, 0, -1}, &rays);
    }
    HitPacket hits;
    TraceStatistics statistics;
    tracer->Intersect(traced.world, &rays, &hits, &statistics);
    for (int i = 0; i < kPacketSize; ++i) {
        EXPECT_EQ(hits.patch[i], i < kPacketSize / 2 ? 0u : kNoHit) << i;
    }
}

TEST_P(SpheresTest, ThatAreLargeAndNearAreFlat) {
    const float radius = 1e6f;
    const TracedSpheres traced({{{0, 0, -radius}, radius}});
    const auto tracer = MakeTracer(GetParam(), LevelMetric(2));
    RayPacket rays;
    rays.count = kPacketSize;
    for (int i = 0; i < kPacketSize; ++i) {
        SetRay(i, {static_cast<float>(i), 0, 2}, {0, 0, -1}, &rays);
    }
    HitPacket hits;
    TraceStatistics statistics;
    tracer->Intersect(traced.world, &rays, &hits, &statistics);
    for (int i = 0; i < kPacketSize; ++i) {
        ASSERT_EQ(hits.patch[i], 0u);
        EXPECT_NEAR(rays.tMax[i], 2 + double(i) * i / (2 * radius), 0.2) << i;
    }
}

TEST_P(SpheresTest, InstancesAreEllipsoids) {
    const AffineTransform stretched({{{2, 0, 0, 5}, {0, 0.5, 0, 0}, {0, 0, 1, 0}}});
    const TracedSpheres traced({{{0, 0, 0}, 1}}, stretched);
    const auto tracer = MakeTracer(GetParam(), LevelMetric(2));
    RayPacket rays;
    rays.count = 4;
    SetRay(0, {5, 0, 9}, {0, 0, -2}, &rays);
    SetRay(1, {6.9f, 0, 9}, {0, 0, -1}, &rays);
    SetRay(2, {5, 0.6f, 9}, {0, 0, -1}, &rays);
    SetRay(3, {9, 0, 0}, {-1, 0, 0}, &rays);
    HitPacket hits;
    TraceStatistics statistics;
    tracer->Intersect(traced.world, &rays, &hits, &statistics);
    EXPECT_NEAR(rays.tMax[0], 4, 1e-5);
    EXPECT_NEAR(rays.tMax[1], 9 - std::sqrt(1 - 0.95 * 0.95), 1e-4);
    EXPECT_EQ(hits.patch[2], kNoHit);
    EXPECT_NEAR(rays.tMax[3], 2, 1e-5);
}

INSTANTIATE_TEST_SUITE_P(Kinds, SpheresTest, testing::ValuesIn(kKinds), [](const auto& info) {
    return "Kind" + std::to_string(static_cast<int>(info.param));
});

TEST(Spheres, TellPositionNormalAndSideOfHits) {
    std::mt19937 random(5);
    const TracedSpheres traced(RandomSpheres(60, &random));
    const auto tracer = MakeTracer(TracerKind::Packet, LevelMetric(2));
    int fronts = 0, backs = 0;
    for (int packet = 0; packet < 60; ++packet) {
        const RayPacket from = RandomRays(&random);
        RayPacket rays = from;
        HitPacket hits;
        TraceStatistics statistics;
        tracer->Intersect(traced.world, &rays, &hits, &statistics);
        for (int i = 0; i < rays.count; ++i) {
            if (hits.patch[i] == kNoHit) {
                continue;
            }
            const Vec3f origin{rays.originX[i], rays.originY[i], rays.originZ[i]};
            const Vec3f direction{rays.directionX[i], rays.directionY[i], rays.directionZ[i]};
            const GeometryPoint point =
                traced.spheres.PointAt({hits.patch[i], hits.u[i], hits.v[i], origin, direction},
                                       traced.world.Instances()[0], LevelMetric(2));
            const Sphere& sphere = traced.spheres.At(hits.patch[i]);
            EXPECT_LT(Length(point.position - PointOf(rays, i)), 1e-5f);
            const Vec3f outward = Normalize(point.position - sphere.center);
            EXPECT_LT(Length(point.normal - outward), 1e-5f);
            EXPECT_NEAR(Dot(point.du, point.normal), 0, 1e-5f);
            EXPECT_NEAR(Dot(point.dv, point.normal), 0, 1e-5f);
            const float cosine = Dot(point.normal, Normalize(direction));
            if (std::fabs(cosine) > 1e-2f) {
                EXPECT_EQ(point.isBehind, cosine > 0);
                (point.isBehind ? backs : fronts) += 1;
            }
        }
    }
    EXPECT_GT(fronts, 500);
    EXPECT_GT(backs, 100);
}

TEST(Spheres, DerivativesAreThoseOfThePosition) {
    const TracedSpheres traced({{{1, 2, 3}, 0.5f}});
    const auto at = [&](float u, float v) {
        return traced.spheres.PointAt({0, u, v, {}, {0, 0, 1}}, traced.world.Instances()[0],
                                      LevelMetric(2));
    };
    constexpr float kStep = 1e-3f;
    for (const float u : {0.1f, 0.4f, 0.8f}) {
        for (const float v : {0.2f, 0.5f, 0.9f}) {
            const GeometryPoint point = at(u, v);
            const Vec3f du =
                (at(u + kStep, v).position - at(u - kStep, v).position) * (0.5f / kStep);
            const Vec3f dv =
                (at(u, v + kStep).position - at(u, v - kStep).position) * (0.5f / kStep);
            EXPECT_LT(Length(point.du - du), 2e-3f);
            EXPECT_LT(Length(point.dv - dv), 2e-3f);
            const Vec2f back = SphereParameters(point.normal);
            EXPECT_NEAR(back.x, u, 1e-6f);
            EXPECT_NEAR(back.y, v, 1e-6f);
        }
    }
}

TEST(Spheres, WithoutSizeAreNotHit) {
    const float nan = std::nanf("");
    const TracedSpheres traced(
        {{{0, 0, 0}, 0}, {{0, 0, -1}, -1}, {{nan, 0, 0}, 0}, {{0, 0, -4}, nan}, {{0, 0, -6}, 1}});
    RayPacket rays;
    rays.count = 1;
    SetRay(0, {0, 0, 5}, {0, 0, -1}, &rays);
    HitPacket hits;
    TraceStatistics statistics;
    MakeTracer(TracerKind::Packet, LevelMetric(2))
        ->Intersect(traced.world, &rays, &hits, &statistics);
    EXPECT_EQ(hits.patch[0], 4u);
    EXPECT_NEAR(rays.tMax[0], 10, 1e-5);
}

}  // namespace
}  // namespace cc::test
