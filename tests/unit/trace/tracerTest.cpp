#include "core/trace/tracer.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include <gtest/gtest.h>

#include "core/subdiv/limitPoint.h"
#include "tests/repeats.h"
#include "tests/unit/subdiv/cageKit.h"
#include "tests/unit/subdiv/testCages.h"
#include "tests/unit/trace/traceKit.h"

namespace cc::test {
namespace {

class TracerTest : public testing::TestWithParam<Cage> {};

struct Triangle {
    Vec3f a, b, c;
    float weightB, weightC;

    Vec3f Point() const { return a + (b - a) * weightB + (c - a) * weightC; }
    /// The sine of the angle between it and a direction.
    float Steepness(const Vec3f& direction) const {
        return std::fabs(Dot(Normalize(Cross(b - a, c - a)), Normalize(direction)));
    }
};

/// Where a hit must be: on one of the triangles into which a level cuts the unit square of a patch,
/// or its triangle, between points of the limit surface.
Triangle TriangleAt(const Surface& surface, int level, uint32_t patch, float u, float v) {
    const PatchTable& patches = surface.Patches();
    const Patch& p = patches.At(patch);
    const int splits = std::max(level, patches.MaxDepth()) - p.depth;
    const auto side = static_cast<float>(p.kind == PatchKind::FlatTriangle ? 1 : 1 << splits);
    const auto cellOf = [side](float x) { return std::min(std::floor(x * side), side - 1); };
    const float column = cellOf(u), row = cellOf(v);
    const float across = u * side - column, along = v * side - row;
    const auto at = [&](int right, int up) {
        const float cornerU = (column + static_cast<float>(right)) / side;
        const float cornerV = (row + static_cast<float>(up)) / side;
        return EvaluateLimit(patches, patch, surface.PatchPoints().data(), cornerU, cornerV)
            .position;
    };
    if (patches.IsTriangle(patch)) {
        return across + along <= 1 ? Triangle{at(0, 0), at(1, 0), at(0, 1), across, along}
                                   : Triangle{at(1, 1), at(0, 1), at(1, 0), 1 - across, 1 - along};
    }
    return across >= along ? Triangle{at(0, 0), at(1, 0), at(1, 1), across - along, along}
                           : Triangle{at(0, 0), at(0, 1), at(1, 1), along - across, across};
}

/// Rounding moves grazing hits far along rays.
void ExpectOnTriangle(const Surface& surface, int level, const RayPacket& rays,
                      const HitPacket& hits, int i) {
    const Triangle triangle = TriangleAt(surface, level, hits.patch[i], hits.u[i], hits.v[i]);
    const Vec3f direction{rays.directionX[i], rays.directionY[i], rays.directionZ[i]};
    const Vec3f difference = triangle.Point() - PointOf(rays, i);
    EXPECT_LT(Length(difference) * triangle.Steepness(direction),
              5e-6f * surface.Bounds().Diagonal())
        << "level " << level;
}

/// Hits lie on triangles between limit points. How far those are from the surface is a matter of
/// its curvature and of the level, not of the tracer; and so, however slowly patches shrink around
/// a vertex of high valence, only rounding is to be allowed for.
TEST_P(TracerTest, HitsLieOnTheTrianglesOfTheLimitSurface) {
    const TracedCage traced(GetParam());
    const Surface& surface = *traced.surface;
    std::mt19937 random(3);
    TraceStatistics statistics;
    int hitCount = 0;
    const Vec3f directions[] = {{1, 0.2f, 0.3f},
                                {-0.4f, 1, 0.1f},
                                {0.2f, -0.3f, 1},
                                {0.1f, 0.2f, -1},
                                {-0.7f, -0.6f, 0.5f}};
    for (const Vec3f& from : directions) {
        for (int n = 0; n < 6; ++n) {
            const int level = 3 * (n % 3);
            RayPacket rays = CameraPacket(surface.Bounds(), from, 0.2f, &random);
            HitPacket hits;
            MakeTracer(TracerKind::Packet, level)
                ->Intersect(traced.world, &rays, &hits, &statistics);
            for (int i = 0; i < rays.count; ++i) {
                if (hits.instance[i] != kNoHit) {
                    ++hitCount;
                    ExpectOnTriangle(surface, level, rays, hits, i);
                }
            }
        }
    }
    EXPECT_GT(hitCount, 200);
}

TEST_P(TracerTest, SingleRaysAgreeWithPackets) {
    const TracedCage traced(GetParam());
    const std::unique_ptr<Tracer> packet = MakeTracer(TracerKind::Packet, 4);
    const std::unique_ptr<Tracer> single = MakeTracer(TracerKind::Single, 4);
    std::mt19937 random(5);
    TraceStatistics statistics;
    for (int n = 0; n < Repeats(40); ++n) {
        RayPacket rays = CameraPacket(traced.surface->Bounds(), {0.9f, -0.5f, 0.7f}, 0.3f, &random);
        rays.count = n % 3 == 0 ? 37 : kPacketSize;
        RayPacket again = rays;
        HitPacket hits, hitsAgain;
        const uint64_t occluded = packet->Occluded(traced.world, rays, &statistics);
        EXPECT_EQ(occluded, single->Occluded(traced.world, rays, &statistics));
        packet->Intersect(traced.world, &rays, &hits, &statistics);
        single->Intersect(traced.world, &again, &hitsAgain, &statistics);
        for (int i = 0; i < rays.count; ++i) {
            EXPECT_EQ(hits.instance[i], hitsAgain.instance[i]);
            EXPECT_EQ((occluded >> i & 1) != 0, hits.instance[i] != kNoHit);
            EXPECT_EQ(rays.tMax[i], again.tMax[i]);
        }
    }
}

TEST_P(TracerTest, SharingGridsChangesNoHit) {
    const TracedCage traced(GetParam());
    SharedGrids grids;
    std::mt19937 random(6);
    TraceStatistics statistics;
    for (int level : {0, 2, 5}) {
        // Grids of one level are not those of another.
        grids.Clear();
        const std::unique_ptr<Tracer> tracer = MakeTracer(TracerKind::Packet, level);
        for (int n = 0; n < Repeats(10); ++n) {
            RayPacket rays =
                CameraPacket(traced.surface->Bounds(), {0.9f, -0.5f, 0.7f}, 0.3f, &random);
            RayPacket again = rays;
            HitPacket hits, hitsAgain;
            EXPECT_EQ(tracer->Occluded(traced.world, rays, &statistics),
                      tracer->Occluded(traced.world, rays, &statistics, &grids));
            tracer->Intersect(traced.world, &rays, &hits, &statistics);
            tracer->Intersect(traced.world, &again, &hitsAgain, &statistics, &grids);
            for (int i = 0; i < rays.count; ++i) {
                EXPECT_EQ(hits.patch[i], hitsAgain.patch[i]);
                EXPECT_EQ(hits.u[i], hitsAgain.u[i]);
                EXPECT_EQ(hits.v[i], hitsAgain.v[i]);
                EXPECT_EQ(rays.tMax[i], again.tMax[i]);
            }
        }
    }
}

/// Points on a wave that runs through them.
std::vector<Vec3f> Rippled(std::vector<Vec3f> points, float height) {
    for (Vec3f& p : points) {
        p.y += height * std::sin(3 * (p.x + p.z));
    }
    return points;
}

TEST_P(TracerTest, HitsAfterAnEditAreThoseOfAFreshBuild) {
    for (float height : {0.02f, 0.7f}) {
        Cage cage = GetParam();
        TracedCage edited(cage);
        cage.points = Rippled(cage.points, height);
        edited.surface->SetPoints(cage.points);
        edited.world = InstanceBvh(edited.world.Instances());
        const TracedCage fresh(cage);
        const std::unique_ptr<Tracer> tracer = MakeTracer(TracerKind::Packet, 4);
        std::mt19937 random(7);
        TraceStatistics statistics;
        for (int n = 0; n < Repeats(20); ++n) {
            RayPacket rays =
                CameraPacket(fresh.surface->Bounds(), {0.9f, -0.5f, 0.7f}, 0.3f, &random);
            RayPacket again = rays;
            HitPacket hits, hitsAgain;
            tracer->Intersect(edited.world, &rays, &hits, &statistics);
            tracer->Intersect(fresh.world, &again, &hitsAgain, &statistics);
            for (int i = 0; i < rays.count; ++i) {
                EXPECT_EQ(hits.instance[i], hitsAgain.instance[i]);
                EXPECT_EQ(rays.tMax[i], again.tMax[i]);
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Catalogue, TracerTest, testing::ValuesIn(Sample(AllCages())), TestName);

/// Triangles of the Loop scheme, regular and irregular, with tags that part them.
Cage CreasedIcosahedron() {
    Cage cage = LoopIcosahedron();
    AddCrease(&cage, {2, 4, 6, 8, 10, 2}, 10);
    AddCrease(&cage, {3, 5, 7}, 1.7f);
    AddCorner(&cage, 1, 2.4f);
    return Named(cage, "creased icosahedron");
}

/// A grid of few quads fills its window with copies of its last points, which are nearer to a ray
/// through its last corner than what rounding is allowed.
TEST_P(TracerTest, HitsAtCornersAreOnTheirPatch) {
    const TracedCage traced(GetParam());
    const Surface& surface = *traced.surface;
    const PatchTable& patches = surface.Patches();
    TraceStatistics statistics;
    for (uint32_t patch = 0; patch < patches.Count(); ++patch) {
        const float last = patches.IsTriangle(patch) ? 0 : 1;
        const LimitPoint corner =
            EvaluateLimit(patches, patch, surface.PatchPoints().data(), 1, last);
        RayPacket rays = PacketThrough(corner.position, traced.world.Bounds().Diagonal());
        HitPacket hits;
        MakeTracer(TracerKind::Packet, 0)->Intersect(traced.world, &rays, &hits, &statistics);
        for (int i = 0; i < rays.count; ++i) {
            if (hits.instance[i] == kNoHit) {
                continue;
            }
            EXPECT_TRUE(hits.u[i] >= 0 && hits.u[i] <= 1 && hits.v[i] >= 0 && hits.v[i] <= 1)
                << "patch " << hits.patch[i] << " at " << hits.u[i] << ", " << hits.v[i];
        }
    }
}

TEST(Tracer, NothingEscapesAClosedMesh) {
    const std::pair<TracerKind, int> tracers[] = {
        {TracerKind::Packet, 1},      {TracerKind::Packet, 3},     {TracerKind::Packet, 4},
        {TracerKind::Algorithm1, 1},  {TracerKind::Algorithm1, 4}, {TracerKind::Algorithm1, 6},
        {TracerKind::Tessellated, 1}, {TracerKind::Tessellated, 4}};
    for (const Cage& cage :
         {Torus(8, 6), Cube(), Drum(5), Tetrahedron(), TriangleTorus(8, 6), TriangleTorus(3, 4),
          LoopOctahedron(), LoopIcosahedron(), CreasedIcosahedron()}) {
        const TracedCage traced(cage);
        // A point inside, below a vertex of the quads of every level.
        const Surface& surface = *traced.surface;
        const LimitPoint start =
            EvaluateLimit(surface.Patches(), 0, surface.PatchPoints().data(), 0, 0);
        const Vec3f inside = start.position - start.normal * (0.05f * surface.Bounds().Diagonal());
        std::mt19937 random(11);
        std::normal_distribution<float> normal;
        TraceStatistics statistics;
        for (const auto& [kind, level] : tracers) {
            const std::unique_ptr<Tracer> tracer = MakeTracer(kind, level);
            for (int n = 0; n < 50; ++n) {
                RayPacket rays;
                rays.count = kPacketSize;
                for (int i = 0; i < kPacketSize; ++i) {
                    rays.originX[i] = inside.x;
                    rays.originY[i] = inside.y;
                    rays.originZ[i] = inside.z;
                    rays.directionX[i] = normal(random);
                    rays.directionY[i] = normal(random);
                    rays.directionZ[i] = normal(random);
                    rays.tMin[i] = 0;
                    rays.tMax[i] = 1e30f;
                }
                EXPECT_EQ(tracer->Occluded(traced.world, rays, &statistics), ~uint64_t(0))
                    << cage.name << " level " << level;
            }
        }
    }
}

TEST(Tracer, HolesAreNeverHit) {
    Cage cage = Sheet(3);
    cage.mesh.holeIndices = {4};
    const TracedCage withHole(cage);
    const TracedCage whole(Sheet(3));
    TraceStatistics statistics;
    RayPacket rays;
    rays.count = kPacketSize;
    for (int i = 0; i < kPacketSize; ++i) {
        rays.originX[i] = 0.5f + 2.0f * (i % 8) / 7;
        rays.originY[i] = 0.5f + 2.0f * (i / 8) / 7;
        rays.originZ[i] = 5;
        rays.directionX[i] = rays.directionY[i] = 0;
        rays.directionZ[i] = -1;
        rays.tMin[i] = 0;
        rays.tMax[i] = 100;
    }
    RayPacket again = rays;
    HitPacket hits, wholeHits;
    const std::unique_ptr<Tracer> tracer = MakeTracer(TracerKind::Packet, 4);
    tracer->Intersect(withHole.world, &rays, &hits, &statistics);
    tracer->Intersect(whole.world, &again, &wholeHits, &statistics);
    int inHole = 0;
    for (int i = 0; i < kPacketSize; ++i) {
        ASSERT_NE(wholeHits.instance[i], kNoHit);
        const uint32_t face = whole.surface->Patches().AuthoredFace(wholeHits.patch[i]);
        if (face == 4) {
            ++inHole;
            EXPECT_EQ(hits.instance[i], kNoHit);
        } else {
            EXPECT_EQ(rays.tMax[i], again.tMax[i]) << "the neighbours keep their shape";
        }
    }
    EXPECT_GT(inHole, 4);
}

TEST(Tracer, DistancesAreThoseOfTheWorld) {
    // Stretched, mirrored and moved far away.
    const AffineTransform place({{{-2, 0, 0, 1000}, {0, 0.5, 0, -500}, {0, 0, 3, 20}}});
    const TracedCage traced(Cube(), place);
    RayPacket rays;
    rays.count = 1;
    rays.originX[0] = 1000;
    rays.originY[0] = -500;
    rays.originZ[0] = 120;
    rays.directionX[0] = rays.directionY[0] = 0;
    rays.directionZ[0] = -2;
    rays.tMin[0] = 0;
    rays.tMax[0] = 1000;
    HitPacket hits;
    TraceStatistics statistics;
    MakeTracer(TracerKind::Packet, 4)->Intersect(traced.world, &rays, &hits, &statistics);
    ASSERT_EQ(hits.instance[0], 0u);
    // The middle of the face, by the limit rules.
    const LimitPoint middle =
        EvaluateLimit(traced.surface->Patches(), hits.patch[0],
                      traced.surface->PatchPoints().data(), hits.u[0], hits.v[0]);
    EXPECT_NEAR(120 - 2 * rays.tMax[0], place.Point(middle.position).z, 1e-2f);
    EXPECT_NEAR(place.Point(middle.position).x, 1000, 1e-2f);
}

}  // namespace
}  // namespace cc::test
