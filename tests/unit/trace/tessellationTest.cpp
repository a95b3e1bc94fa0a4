#include "core/trace/tessellation.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include "core/subdiv/limitPoint.h"
#include "core/trace/tracer.h"
#include "tests/repeats.h"
#include "tests/unit/subdiv/testCages.h"
#include "tests/unit/trace/traceKit.h"

namespace cc::test {
namespace {

class TessellationTest : public testing::TestWithParam<Cage> {};

TEST_P(TessellationTest, PointsAreThoseOfTheLimitSurface) {
    const TracedCage traced(GetParam());
    const Surface& surface = *traced.surface;
    const PatchTable& patches = surface.Patches();
    const float bound = 1e-6f * surface.Bounds().Diagonal();
    for (const int level : {0, 3, 5}) {
        const Tessellation tessellation(patches, surface.PatchPoints(), level);
        EXPECT_EQ(tessellation.Level(), std::max(level, patches.MaxDepth()));
        for (uint32_t patch = 0; patch < patches.Count(); ++patch) {
            const Tessellation::Grid& grid = tessellation.PatchGrid(patch);
            ASSERT_EQ(grid.side << patches.At(patch).depth, 1 << tessellation.Level());
            const float side = static_cast<float>(grid.side);
            const int count = (grid.side + 1) * (grid.side + 1);
            for (int n = 0; n < Repeats(count); ++n) {
                const int i = n * count / Repeats(count);
                const int row = i / (grid.side + 1), column = i % (grid.side + 1);
                if (column >= grid.RowSize(row)) {
                    continue;
                }
                const LimitPoint limit = EvaluateLimit(patches, patch, surface.PatchPoints().data(),
                                                       static_cast<float>(column) / side,
                                                       static_cast<float>(row) / side);
                EXPECT_LT(Length(tessellation.PointAt(grid, column, row) - limit.position), bound);
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Catalogue, TessellationTest, testing::ValuesIn(Sample(AllCages())),
                         TestName);

TEST(Tessellation, MemoryIsThatOfQuads) {
    const TracedCage traced(Torus(12, 8));
    for (int level = 2; level < 7; ++level) {
        const Tessellation tessellation(traced.surface->Patches(), traced.surface->PatchPoints(),
                                        level);
        const double bytes =
            static_cast<double>(tessellation.Bytes()) / static_cast<double>(96 << (2 * level));
        // A point and its share of a block and of boxes; the paper counts on 40 bytes a triangle.
        EXPECT_GT(bytes, sizeof(Vec3f) + sizeof(Tessellation::Block) / 4.0);
        EXPECT_LT(bytes, 60);
        const Tessellation::Need need = Tessellation::NeedOf(traced.surface->Patches(), level);
        EXPECT_TRUE(need.isPossible);
        EXPECT_GE(need.kept, tessellation.Bytes());
        EXPECT_LT(need.kept, tessellation.Bytes() * 4 / 3);
    }
}

/// The distance at which a ray down the z axis meets a sheet.
float HeightOfRay(const TracedCage& traced, const Tracer& tracer) {
    RayPacket rays;
    rays.count = 1;
    rays.originX[0] = rays.originY[0] = 1.3f;
    rays.originZ[0] = 10;
    rays.directionX[0] = rays.directionY[0] = 0;
    rays.directionZ[0] = -1;
    rays.tMin[0] = 0;
    rays.tMax[0] = 100;
    HitPacket hits;
    TraceStatistics statistics;
    tracer.Intersect(traced.world, &rays, &hits, &statistics);
    EXPECT_EQ(hits.instance[0], 0u);
    return 10 - rays.tMax[0];
}

TEST(Tessellation, FollowsThePoints) {
    Cage cage = Sheet(3);
    TracedCage traced(cage);
    const std::unique_ptr<Tracer> tracer = MakeTracer(TracerKind::Tessellated, 4);
    const float before = HeightOfRay(traced, *tracer);
    for (Vec3f& p : cage.points) {
        p.z += 0.5f;
    }
    traced.surface->SetPoints(cage.points);
    EXPECT_EQ(traced.surface->TessellationBytes(), 0u);
    traced.world = InstanceBvh(traced.world.Instances());
    EXPECT_NEAR(HeightOfRay(traced, *tracer), before + 0.5f, 1e-5f);
}

TEST(Tessellation, IsMadeOnceHoweverManyThreadsAsk) {
    for (int round = 0; round < 20; ++round) {
        const TracedCage traced(Torus(9, 6));
        std::vector<const Tessellation*> found(64);
        tbb::parallel_for(size_t(0), found.size(),
                          [&](size_t i) { found[i] = &traced.surface->TessellationAt(4); });
        for (const Tessellation* one : found) {
            EXPECT_EQ(one, found[0]);
        }
    }
}

TEST(Tessellation, OneLevelIsKeptAtATime) {
    const TracedCage traced(Torus(9, 6));
    const size_t coarse = traced.surface->TessellationAt(2).Bytes();
    EXPECT_EQ(traced.surface->TessellationBytes(), coarse);
    EXPECT_EQ(traced.surface->TessellationAt(4).Level(), 4);
    EXPECT_GT(traced.surface->TessellationBytes(), 10 * coarse);
    EXPECT_EQ(traced.surface->Bytes() - traced.surface->TessellationBytes(),
              TracedCage(Torus(9, 6)).surface->Bytes());
    traced.surface->DropTessellation();
    EXPECT_EQ(traced.surface->TessellationBytes(), 0u);
}

}  // namespace
}  // namespace cc::test
