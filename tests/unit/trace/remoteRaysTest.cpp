#include "core/trace/remoteRays.h"

#include <random>

#include <gtest/gtest.h>

#include "core/trace/instanceLevels.h"
#include "core/trace/tracer.h"
#include "tests/unit/subdiv/testCages.h"
#include "tests/unit/trace/traceKit.h"

namespace cc::test {
namespace {

PixelErrorMetric Metric(float remoteError) {
    LevelView view{};
    view.eye = {0, 0, 6};
    view.forward = {0, 0, -1};
    view.pixels = 500;
    view.leastCosine = 0.8f;
    return {view, 0.25f, 8, remoteError};
}

/// Rays that start at a distance from the middle and go through points near it.
RayPacket RaysFrom(float distance, int count, std::mt19937* random) {
    std::uniform_real_distribution<float> unit(-1, 1);
    RayPacket rays;
    rays.count = count;
    for (int i = 0; i < count; ++i) {
        const Vec3f origin =
            distance * Normalize(Vec3f{unit(*random), unit(*random), unit(*random)});
        const Vec3f target{unit(*random), unit(*random), unit(*random)};
        rays.originX[i] = origin.x;
        rays.originY[i] = origin.y;
        rays.originZ[i] = origin.z;
        rays.directionX[i] = target.x - origin.x;
        rays.directionY[i] = target.y - origin.y;
        rays.directionZ[i] = target.z - origin.z;
        rays.tMin[i] = 0;
        rays.tMax[i] = 100;
    }
    return rays;
}

/// The distances of hits, or what the rays had where there are none.
std::vector<float> Distances(const LevelMetric& metric, TracerKind kind, const InstanceBvh& world,
                             RayPacket rays) {
    HitPacket hits;
    TraceStatistics statistics;
    SharedGrids grids;
    MakeTracer(kind, metric)->Intersect(world, &rays, &hits, &statistics, &grids);
    return {rays.tMax, rays.tMax + rays.count};
}

TEST(RemoteRays, SeeWhatCoarserLevelsShow) {
    const TracedCage traced(Drum(7));
    const LevelMetric mixed = Metric(20);
    PixelErrorMetric coarse = Metric(0);
    coarse.pixelError = 20;
    std::mt19937 random(3);
    for (const TracerKind kind : {TracerKind::Packet, TracerKind::Single}) {
        int differences = 0;
        for (int i = 0; i < 20; ++i) {
            const RayPacket rays = RaysFrom(9, kPacketSize, &random);
            const auto fine = Distances(Metric(0), kind, traced.world, rays);
            const auto seen = Distances(mixed, kind, traced.world, rays);
            EXPECT_EQ(seen, Distances(coarse, kind, traced.world, rays));
            differences += seen != fine;
        }
        EXPECT_EQ(differences, 20);
    }
}

TEST(RemoteRays, OfWhichOneStartsInsideSeeWhatTheCameraSees) {
    const TracedCage traced(Drum(7));
    std::mt19937 random(4);
    for (int i = 0; i < 20; ++i) {
        RayPacket rays = RaysFrom(9, kPacketSize, &random);
        const Vec3f inside = traced.surface->Bounds().Center();
        rays.originX[17] = inside.x;
        rays.originY[17] = inside.y;
        rays.originZ[17] = inside.z;
        EXPECT_EQ(Distances(Metric(20), TracerKind::Packet, traced.world, rays),
                  Distances(Metric(0), TracerKind::Packet, traced.world, rays));
        // A ray that is done counts as well: all parts of a surface must agree.
        rays.tMax[17] = -1;
        EXPECT_EQ(Distances(Metric(20), TracerKind::Packet, traced.world, rays),
                  Distances(Metric(0), TracerKind::Packet, traced.world, rays));
    }
}

TEST(RemoteRays, DoNotStartBeneathQuadsOfAnyLevel) {
    const TracedCage traced(Drum(7));
    const Surface& surface = *traced.surface;
    std::mt19937 random(5);
    int hits = 0;
    for (int level = 0; level <= 6; ++level) {
        for (int i = 0; i < 50; ++i) {
            const RayPacket rays = RaysFrom(9, kPacketSize, &random);
            const auto t = Distances(level, TracerKind::Packet, traced.world, rays);
            for (int lane = 0; lane < kPacketSize; ++lane) {
                ObjectRays from;
                from.count = 1;
                from.originX[0] = rays.originX[lane] + t[lane] * rays.directionX[lane];
                from.originY[0] = rays.originY[lane] + t[lane] * rays.directionY[lane];
                from.originZ[0] = rays.originZ[lane] + t[lane] * rays.directionZ[lane];
                if (t[lane] < 100) {
                    EXPECT_FALSE(IsRemote(surface, from));
                    ++hits;
                }
            }
        }
    }
    EXPECT_GT(hits, 1000);
}

TEST(RemoteRays, AreOfNoConcernWithoutALargerError) {
    EXPECT_FALSE(LevelMetric(4).HasRemote());
    EXPECT_FALSE(LevelMetric(Metric(0)).HasRemote());
    EXPECT_FALSE(LevelMetric(Metric(0.25f)).HasRemote());
    EXPECT_TRUE(LevelMetric(Metric(0.5f)).HasRemote());
}

}  // namespace
}  // namespace cc::test
