#include "core/trace/curveSegments.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "core/trace/levelMetric.h"
#include "core/trace/tracer.h"
#include "tests/unit/trace/traceKit.h"

namespace cc::test {
namespace {

constexpr TracerKind kKinds[] = {TracerKind::Packet, TracerKind::Algorithm1, TracerKind::Single,
                                 TracerKind::Tessellated};

CurveSegment Segment(const Vec3f& a, const Vec3f& b, const Vec3f& c, const Vec3f& d, float radius) {
    CurveSegment segment;
    const Vec3f points[4] = {a, b, c, d};
    for (int i = 0; i < 4; ++i) {
        segment.points[i] = points[i];
        segment.radii[i] = radius;
    }
    segment.pieces = 1;
    return segment;
}

CurveSegment Line(const Vec3f& a, const Vec3f& b, float radius) {
    return Segment(a, a * (2 / 3.0f) + b * (1 / 3.0f), a * (1 / 3.0f) + b * (2 / 3.0f), b, radius);
}

struct TracedCurves {
    explicit TracedCurves(std::vector<CurveSegment> from, std::vector<RibbonNormals> normals = {})
        : curves(std::move(from), std::move(normals)) {
        Instance instance;
        instance.geometry = &curves;
        world = InstanceBvh({instance});
    }

    GeometryPoint At(const RayPacket& rays, const HitPacket& hits, int i) const {
        const Vec3f direction{rays.directionX[i], rays.directionY[i], rays.directionZ[i]};
        return curves.PointAt({hits.patch[i],
                               hits.u[i],
                               hits.v[i],
                               {rays.originX[i], rays.originY[i], rays.originZ[i]},
                               direction,
                               PointOf(rays, i)},
                              world.Instances()[0], LevelMetric(2));
    }

    CurveSegments curves;
    InstanceBvh world;
};

/// Traces and checks that any hit says the same.
HitPacket Trace(TracerKind kind, const TracedCurves& traced, RayPacket* rays) {
    const auto tracer = MakeTracer(kind, LevelMetric(2));
    TraceStatistics statistics;
    const uint64_t occluded = tracer->Occluded(traced.world, *rays, &statistics);
    HitPacket hits;
    tracer->Intersect(traced.world, rays, &hits, &statistics);
    for (int i = 0; i < rays->count; ++i) {
        EXPECT_EQ(occluded >> i & 1, hits.patch[i] != kNoHit);
    }
    return hits;
}

class CurvesTest : public testing::TestWithParam<TracerKind> {};

INSTANTIATE_TEST_SUITE_P(Kinds, CurvesTest, testing::ValuesIn(kKinds), [](const auto& info) {
    return "Kind" + std::to_string(static_cast<int>(info.param));
});

TEST_P(CurvesTest, LinesAreCylindersThatAreOpenAtTheirEnds) {
    const TracedCurves traced({Line({-1, 0, 0}, {1, 0, 0}, 0.5f)});
    RayPacket rays;
    rays.count = 0;
    for (int x = -12; x <= 12; x += 3) {
        for (int y = -6; y <= 6; y += 2) {
            SetRay(rays.count++, {0.0999f * x, 0.0999f * y, 7}, {0, 0, -2}, &rays);
        }
    }
    const RayPacket from = rays;
    const HitPacket hits = Trace(GetParam(), traced, &rays);
    for (int i = 0; i < rays.count; ++i) {
        const float x = from.originX[i], y = from.originY[i];
        const bool isHit = std::fabs(x) < 1 && std::fabs(y) < 0.5f;
        ASSERT_EQ(hits.patch[i] == 0, isHit) << x << " " << y;
        if (!isHit) {
            continue;
        }
        const float z = std::sqrt(0.25f - y * y);
        EXPECT_NEAR(rays.tMax[i], (7 - z) / 2, 1e-6f);
        EXPECT_NEAR(hits.u[i], (x + 1) / 2, 1e-6f);
        const GeometryPoint point = traced.At(rays, hits, i);
        EXPECT_LT(Length(point.normal - Vec3f{0, 2 * y, 2 * z}), 1e-5f);
        EXPECT_LT(Length(point.position - Vec3f{x, y, z}), 1e-5f);
        EXPECT_FALSE(point.isBehind);
    }
    // Along the tube, in at one end: through, or the inner side.
    rays.count = 3;
    SetRay(0, {-5, 0.1f, 0}, {1, 0, 0}, &rays);
    SetRay(1, {-5, 0, 0}, {5, 0.2f, 0}, &rays);
    SetRay(2, {0, 0, 0}, {0, 1, 0}, &rays);
    const HitPacket inside = Trace(GetParam(), traced, &rays);
    EXPECT_EQ(inside.patch[0], kNoHit);
    EXPECT_EQ(inside.patch[1], kNoHit) << "it leaves by the other end";
    ASSERT_EQ(inside.patch[2], 0u);
    EXPECT_NEAR(rays.tMax[2], 0.5f, 1e-6f);
    EXPECT_TRUE(traced.At(rays, inside, 2).isBehind);
}

TEST_P(CurvesTest, LinesWhoseWidthChangesAreCones) {
    CurveSegment segment = Line({0, 0, 0}, {0, 3, 0}, 0);
    for (int i = 0; i < 4; ++i) {
        segment.radii[i] = 0.3f * static_cast<float>(3 - i);
    }
    const TracedCurves traced({segment});
    RayPacket rays;
    rays.count = kPacketSize;
    for (int i = 0; i < kPacketSize; ++i) {
        SetRay(i, {0.02f * static_cast<float>(i % 8), 0.4f * static_cast<float>(i / 8), 9},
               {0, 0, -1}, &rays);
    }
    const RayPacket from = rays;
    const HitPacket hits = Trace(GetParam(), traced, &rays);
    for (int i = 0; i < kPacketSize; ++i) {
        const float x = from.originX[i], y = from.originY[i], radius = 0.3f * (3 - y);
        ASSERT_EQ(hits.patch[i] == 0, x < radius) << i;
        if (x >= radius) {
            continue;
        }
        const float z = std::sqrt(radius * radius - x * x);
        EXPECT_NEAR(rays.tMax[i], 9 - z, 1e-5f);
        const Vec3f normal = Normalize({x, 0.3f * radius, z});
        EXPECT_LT(Length(traced.At(rays, hits, i).normal - normal), 1e-4f);
    }
}

/// A quarter of the unit circle, as near as a cubic comes: 2.7e-4.
CurveSegment QuarterCircle(float radius) {
    const float k = 0.5522847f;
    return Segment({1, 0, 0}, {1, k, 0}, {k, 1, 0}, {0, 1, 0}, radius);
}

TEST_P(CurvesTest, BentOnesStayWithinATenthOfTheirWidth) {
    for (const float radius : {0.3f, 0.03f, 0.003f}) {
        const TracedCurves traced({QuarterCircle(radius)});
        std::mt19937 random(5);
        std::uniform_real_distribution<float> unit(0, 1);
        int hitCount = 0;
        for (int packet = 0; packet < 40; ++packet) {
            RayPacket rays;
            rays.count = kPacketSize;
            for (int i = 0; i < kPacketSize; ++i) {
                const float angle = 0.05f + 1.47f * unit(random);
                const float away = 1 + 1.6f * radius * (2 * unit(random) - 1);
                SetRay(i, {away * std::cos(angle), away * std::sin(angle), 5}, {0, 0, -1}, &rays);
            }
            const RayPacket from = rays;
            const HitPacket hits = Trace(GetParam(), traced, &rays);
            for (int i = 0; i < kPacketSize; ++i) {
                const float across = std::hypot(from.originX[i], from.originY[i]) - 1;
                const float tolerance = 0.1f * radius + 3e-4f;
                if (hits.patch[i] == kNoHit) {
                    EXPECT_GT(std::fabs(across), radius - tolerance);
                    continue;
                }
                ++hitCount;
                EXPECT_LT(std::fabs(across), radius + tolerance);
                // From the middle of the tube.
                const float distance = std::hypot(across, 5 - rays.tMax[i]);
                EXPECT_NEAR(distance, radius, tolerance);
                const GeometryPoint point = traced.At(rays, hits, i);
                // What the cubic is off from the circle, and as much from the foot of the normal.
                EXPECT_NEAR(std::hypot(std::hypot(point.position.x, point.position.y) - 1,
                                       point.position.z),
                            radius, 5e-4f);
            }
        }
        EXPECT_GT(hitCount, 1000);
    }
}

TEST_P(CurvesTest, LeaveNoGapWherePiecesAndSegmentsMeet) {
    // A zigzag, and a bend that is cut into many pieces: nothing passes near their middle.
    std::vector<CurveSegment> segments{Line({0, 0, 0}, {1, 1, 0}, 0.2f),
                                       Line({1, 1, 0}, {2, 0, 0}, 0.2f),
                                       Line({2, 0, 0}, {2.2f, 1, 0.4f}, 0.2f), QuarterCircle(0.1f)};
    for (uint32_t i = 0; i < 3; ++i) {
        segments[i].previous = i == 0 ? CurveSegment::kNone : i - 1;
        segments[i].next = i == 2 ? CurveSegment::kNone : i + 1;
    }
    for (Vec3f& p : segments[3].points) {
        p = p + Vec3f{0, 5, 0};
    }
    const TracedCurves traced(segments);
    std::mt19937 random(9);
    std::uniform_real_distribution<float> unit(0, 1);
    for (int packet = 0; packet < 60; ++packet) {
        RayPacket rays;
        rays.count = kPacketSize;
        for (int i = 0; i < kPacketSize; ++i) {
            const CurveSegment& segment = segments[i % 4];
            // Near the ends of segments that are joined, and anywhere on the bend.
            const float u = i % 4 == 3   ? 0.05f + 0.9f * unit(random)
                            : i % 4 == 0 ? 1 - 0.05f * unit(random)
                                         : 0.05f * unit(random);
            const Vec3f direction =
                Normalize({unit(random) - 0.5f, unit(random) - 0.5f, unit(random) - 0.5f});
            const Vec3f shift =
                Vec3f{unit(random) - 0.5f, unit(random) - 0.5f, unit(random) - 0.5f} * 0.05f;
            SetRay(i, segment.PointAt(u) + shift - direction * 9, direction, &rays);
            const Vec3f along = Normalize(segment.DerivativeAt(u));
            // Not in at an open end.
            if (std::fabs(Dot(along, direction)) > 0.8f) {
                SetRay(i, segment.PointAt(u) + Vec3f{0, 0, 9}, {0, 0, -1}, &rays);
            }
        }
        const HitPacket hits = Trace(GetParam(), traced, &rays);
        for (int i = 0; i < kPacketSize; ++i) {
            EXPECT_NE(hits.patch[i], kNoHit) << i;
        }
    }
}

TEST_P(CurvesTest, JointsAreRoundOutside) {
    std::vector<CurveSegment> segments{Line({-2, 0, 0}, {0, 0, 0}, 0.5f),
                                       Line({0, 0, 0}, {0, 2, 0}, 0.5f)};
    segments[0].next = 1;
    segments[1].previous = 0;
    const TracedCurves traced(segments);
    RayPacket rays;
    rays.count = 2;
    SetRay(0, {0.3f, -0.3f, 5}, {0, 0, -1}, &rays);
    SetRay(1, {0.4f, -0.4f, 5}, {0, 0, -1}, &rays);
    const HitPacket hits = Trace(GetParam(), traced, &rays);
    ASSERT_EQ(hits.patch[0], 0u);
    EXPECT_NEAR(rays.tMax[0], 5 - std::sqrt(0.25 - 0.18), 1e-5);
    const Vec3f normal = Normalize({0.3f, -0.3f, std::sqrt(0.07f)});
    EXPECT_LT(Length(traced.At(rays, hits, 0).normal - normal), 1e-5f);
    EXPECT_EQ(hits.patch[1], kNoHit);
}

TEST_P(CurvesTest, RibbonsAreFlatAndFaceTheirNormals) {
    const TracedCurves traced({Line({0, -2, 0}, {0, 2, 0}, 0.5f)}, {{{0, 0, 1}, {0, 0, 1}}});
    RayPacket rays;
    rays.count = 4;
    SetRay(0, {0.4f, 1, 5}, {0, 0, -1}, &rays);
    SetRay(1, {0.6f, 1, 5}, {0, 0, -1}, &rays);
    SetRay(2, {-0.4f, -1, -5}, {0, 0, 1}, &rays);
    SetRay(3, {5, 0.3f, 0.1f}, {-1, 0, 0}, &rays);
    const HitPacket hits = Trace(GetParam(), traced, &rays);
    ASSERT_EQ(hits.patch[0], 0u);
    EXPECT_NEAR(rays.tMax[0], 5, 1e-6f);
    EXPECT_NEAR(hits.u[0], 0.75f, 1e-6f);
    EXPECT_NEAR(hits.v[0], 0.9f, 1e-6f);
    const GeometryPoint point = traced.At(rays, hits, 0);
    EXPECT_LT(Length(point.normal - Vec3f{0, 0, 1}), 1e-6f);
    EXPECT_LT(Length(point.position - Vec3f{0.4f, 1, 0}), 1e-6f);
    EXPECT_EQ(hits.patch[1], kNoHit);
    ASSERT_EQ(hits.patch[2], 0u);
    EXPECT_TRUE(traced.At(rays, hits, 2).isBehind);
    EXPECT_EQ(hits.patch[3], kNoHit) << "it passes in front of the flat side";
}

TEST_P(CurvesTest, RibbonsThatTurnAreGaplessHelicoids) {
    // A quarter turn about the y axis.
    const TracedCurves traced({Line({0, -2, 0}, {0, 2, 0}, 0.5f)}, {{{0, 0, 1}, {1, 0, 0}}});
    RayPacket rays;
    rays.count = kPacketSize;
    for (int i = 0; i < kPacketSize; ++i) {
        SetRay(i, {0.02f, -1.99f + 2.8f * static_cast<float>(i) / kPacketSize, 5}, {0, 0, -1},
               &rays);
    }
    const RayPacket from = rays;
    const HitPacket hits = Trace(GetParam(), traced, &rays);
    for (int i = 0; i < kPacketSize; ++i) {
        ASSERT_EQ(hits.patch[i], 0u) << i;
        const float u = (from.originY[i] + 2) / 4;
        const Vec3f across = Normalize({1 - u, 0, -u});
        // How far the hit is from the ruling that the ray passes.
        const float t = 5 - 0.02f * across.z / across.x;
        EXPECT_LT(std::fabs(rays.tMax[i] - t) * across.x, 0.03f) << i;
    }
}

TEST(Curves, WithoutWidthAreNotHit) {
    CurveSegment none = Line({0, -2, 0}, {0, 2, 0}, 0.5f);
    none.pieces = 0;
    const TracedCurves traced({Line({-2, 0, 0}, {2, 0, 0}, 0), none});
    EXPECT_TRUE(traced.curves.PrimitiveBvh().IsEmpty());
}

}  // namespace
}  // namespace cc::test
