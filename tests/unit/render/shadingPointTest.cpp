#include "core/render/shadingPoint.h"

#include <random>
#include <utility>

#include <gtest/gtest.h>

#include "core/subdiv/limitPoint.h"
#include "core/trace/tracer.h"
#include "tests/unit/render/renderTestKit.h"

namespace cc::test {
namespace {

struct Traced {
    RayPacket rays;
    HitPacket hits;
    TraceStatistics statistics;

    void Trace(const Scene& scene, int level) {
        MakeTracer(TracerKind::Packet, level)
            ->Intersect(scene.Instances(), &rays, &hits, &statistics);
    }
    bool IsHit(int lane) const { return hits.instance[lane] != kNoHit; }
    Vec3f Direction(int lane) const {
        return {rays.directionX[lane], rays.directionY[lane], rays.directionZ[lane]};
    }
};

/// Parallel rays along -z over a square around a centre.
Traced RaysDown(const Vec3f& center, float size, std::mt19937* random) {
    Traced traced;
    traced.rays.count = kPacketSize;
    std::uniform_real_distribution<float> jitter(-0.5f, 0.5f);
    for (int i = 0; i < kPacketSize; ++i) {
        traced.rays.originX[i] = center.x + size * jitter(*random);
        traced.rays.originY[i] = center.y + size * jitter(*random);
        traced.rays.originZ[i] = center.z + 10;
        traced.rays.directionX[i] = traced.rays.directionY[i] = 0;
        traced.rays.directionZ[i] = -1;
        traced.rays.tMin[i] = 0;
        traced.rays.tMax[i] = 100;
    }
    return traced;
}

/// Share of points whose light is blocked although it shines on the convex limit surface.
double BlockedShare(const Scene& scene, const Vec3f& center, float size, int level,
                    const Vec3f& towardsLight) {
    std::mt19937 random(1);
    int lit = 0, blocked = 0;
    for (int packet = 0; packet < 50; ++packet) {
        Traced traced = RaysDown(center, size, &random);
        traced.Trace(scene, level);
        RayPacket shadow;
        for (int i = 0; i < kPacketSize; ++i) {
            if (!traced.IsHit(i)) {
                continue;
            }
            const Instance& instance = scene.Instances().Instances()[traced.hits.instance[i]];
            const ShadingPoint point =
                MakeShadingPoint(instance, {}, traced.rays, traced.hits, i, level);
            if (Dot(point.normal, towardsLight) > 0) {
                const int lane = shadow.count++;
                shadow.originX[lane] = point.rayOrigin.x;
                shadow.originY[lane] = point.rayOrigin.y;
                shadow.originZ[lane] = point.rayOrigin.z;
                shadow.directionX[lane] = towardsLight.x;
                shadow.directionY[lane] = towardsLight.y;
                shadow.directionZ[lane] = towardsLight.z;
                shadow.tMin[lane] = 0;
                shadow.tMax[lane] = 1e4f;
            }
        }
        const uint64_t occluded = MakeTracer(TracerKind::Packet, level)
                                      ->Occluded(scene.Instances(), shadow, &traced.statistics);
        lit += shadow.count;
        for (int i = 0; i < shadow.count; ++i) {
            blocked += occluded >> i & 1;
        }
    }
    EXPECT_GT(lit, 100);
    return blocked / double(lit);
}

TEST(ShadingPoint, TangentsAreInTheWorldAndByTheFace) {
    for (const bool isTriangulated : {false, true}) {
        Scene scene;
        Cage square = Square();
        square.mesh.scheme = isTriangulated ? Scheme::None : Scheme::Bilinear;
        AddCage(&scene, "/square", square)->SetTransform(Placed(2, 1, 0, 0));
        scene.Build({"geometry"});
        std::mt19937 random(1);
        Traced traced = RaysDown({1, 0, 0}, 3, &random);
        traced.Trace(scene, 2);
        for (int i = 0; i < kPacketSize; ++i) {
            ASSERT_TRUE(traced.IsHit(i));
            const ShadingPoint point = MakeShadingPoint(scene.Instances().Instances()[0], {},
                                                        traced.rays, traced.hits, i, 2);
            // The second triangle's u runs along the diagonal.
            const bool isSecond = isTriangulated && traced.hits.patch[i] == 1;
            EXPECT_LT(Length(point.du - Vec3f{4, isSecond ? 4.0f : 0.0f, 0}), 1e-4f);
            const bool isFirst = isTriangulated && !isSecond;
            EXPECT_LT(Length(point.dv - Vec3f{isFirst ? 4.0f : 0.0f, 4, 0}), 1e-4f);
            EXPECT_EQ(point.shadingNormal, point.normal);
        }
    }
}

TEST(ShadingPoint, ConvexSurfacesDoNotShadowThemselves) {
    for (const double offset : {0.0, 1000.0}) {
        Scene scene;
        AddCage(&scene, "/cube", Cube())->SetTransform(Placed(1, offset, 0, -offset));
        scene.Build({"geometry"});
        const Vec3f center{float(offset), 0, float(-offset)};
        for (const int level : {0, 2, 4, 6}) {
            for (const Vec3f& light :
                 {Vec3f{0.3f, 0.2f, 1}, Vec3f{1, 0.3f, 0.1f}, Vec3f{-1, 0.5f, -0.4f}}) {
                EXPECT_LT(BlockedShare(scene, center, 2, level, Normalize(light)), 1e-3)
                    << "level " << level << " offset " << offset << " light " << light.x;
            }
        }
    }
}

TEST(ShadingPoint, HollowSurfacesAreLitFromAbove) {
    // A bowl: the inner side of the lower half of a cube, seen and lit from above.
    Scene scene;
    Cage bowl = Cube();
    for (int face = 0; face < 6; ++face) {
        float z = 0;
        for (int i = 0; i < 4; ++i) {
            z += bowl.points[bowl.mesh.faceVertexIndices[4 * face + i]].z;
        }
        if (z > 3) {
            bowl.mesh.holeIndices = {face};
        }
    }
    AddCage(&scene, "/bowl", bowl);
    scene.Build({"geometry"});
    for (const int level : {0, 2, 4, 6}) {
        EXPECT_EQ(BlockedShare(scene, {}, 0.6f, level, Vec3f{0, 0, 1}), 0) << level;
    }
}

TEST(ShadingPoint, ThereAreStillShadows) {
    Scene scene;
    AddCage(&scene, "/floor", Square())->SetTransform(Placed(4, 0, 0, 0));
    AddCage(&scene, "/roof", Square())->SetTransform(Placed(1, 3, 0, 1e-3));
    scene.Build({"geometry"});
    // The light comes over the roof, which lies close above the floor.
    EXPECT_GT(BlockedShare(scene, {0, 0, 0}, 2, 3, Normalize({3, 0, 1e-3f})), 0.7);
    EXPECT_EQ(BlockedShare(scene, {0, 0, 0}, 2, 3, Normalize({-3, 0, 1e-2f})), 0);
}

TEST(ShadingPoint, NormalsFaceTheViewer) {
    std::mt19937 random(2);
    for (const bool reversed : {false, true}) {
        for (const double mirror : {1.0, -1.0}) {
            Scene scene;
            AddCage(&scene, "/square", reversed ? Reversed(Square()) : Square())
                ->SetTransform(AffineTransform({{{mirror, 0, 0, 0}, {0, 2, 0, 0}, {0, 0, 1, 3}}}));
            scene.Build({"geometry"});
            Traced traced = RaysDown({}, 1, &random);
            traced.Trace(scene, 2);
            for (int i = 0; i < kPacketSize; ++i) {
                ASSERT_TRUE(traced.IsHit(i));
                const Instance& instance = scene.Instances().Instances()[0];
                const ShadingPoint point =
                    MakeShadingPoint(instance, {}, traced.rays, traced.hits, i, 2);
                EXPECT_NEAR(point.normal.z, 1, 1e-6f);
                EXPECT_NEAR(point.position.z, 3, 1e-6f);
                EXPECT_EQ(IsHitFromBehind(instance, traced.rays, traced.hits, i, 2), reversed);
            }
        }
    }
}

TEST(ShadingPoint, ClosedSurfacesAreNeverHitFromBehind) {
    const std::pair<Cage, float> cases[] = {
        {Torus(7, 5), 6}, {TriangleTorus(7, 5), 6}, {LoopIcosahedron(), 1.6f}};
    for (const auto& [cage, size] : cases) {
        Scene scene;
        // Tilted, so that some triangles face the viewer where the limit surface turns away
        // already.
        AddCage(&scene, "/closed", cage)
            ->SetTransform(AffineTransform(
                {{{0.8, 0, 0.6, 0}, {-0.36, 0.8, 0.48, 0}, {-0.48, -0.6, 0.64, 0}}}));
        scene.Build({"geometry"});
        std::mt19937 random(3);
        for (const int level : {0, 1, 3}) {
            int hits = 0;
            for (int packet = 0; packet < 100; ++packet) {
                Traced traced = RaysDown(scene.Instances().Bounds().Center(), size, &random);
                traced.Trace(scene, level);
                for (int i = 0; i < kPacketSize; ++i) {
                    if (traced.IsHit(i)) {
                        ++hits;
                        EXPECT_FALSE(IsHitFromBehind(scene.Instances().Instances()[0], traced.rays,
                                                     traced.hits, i, level))
                            << cage.name << " level " << level;
                    }
                }
            }
            EXPECT_GT(hits, 500) << cage.name;
        }
    }
}

TEST(ShadingPoint, TrianglesUpToTheLongEdgeOfAPatchTellTheSide) {
    Scene scene;
    AddCage(&scene, "/closed", LoopIcosahedron());
    scene.Build({"geometry"});
    const Instance& instance = scene.Instances().Instances()[0];
    const Surface& surface = SurfaceOf(instance);
    constexpr int kLevel = 4, kSegments = 1 << kLevel;
    for (uint32_t patch = 0; patch < surface.Patches().Count(); ++patch) {
        for (int i = 0; i <= kSegments; ++i) {
            const float u = static_cast<float>(i) / kSegments;
            const LimitPoint limit =
                EvaluateLimit(surface.Patches(), patch, surface.PatchPoints().data(), u, 1 - u);
            const Vec3f along = Normalize(limit.du);
            // So nearly along the surface that the triangle decides, whose normal is close.
            for (const float side : {-0.2f, 0.2f}) {
                Traced traced;
                const Vec3f d = along + limit.normal * side;
                traced.rays.directionX[0] = d.x;
                traced.rays.directionY[0] = d.y;
                traced.rays.directionZ[0] = d.z;
                traced.hits.patch[0] = patch;
                traced.hits.u[0] = u;
                traced.hits.v[0] = 1 - u;
                EXPECT_EQ(IsHitFromBehind(instance, traced.rays, traced.hits, 0, kLevel), side > 0)
                    << "patch " << patch << " at " << u;
            }
        }
    }
}

}  // namespace
}  // namespace cc::test
