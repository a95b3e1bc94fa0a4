#include "core/trace/instanceLevels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <utility>

#include <gtest/gtest.h>

#include "core/subdiv/limitPoint.h"
#include "core/trace/tracer.h"
#include "tests/repeats.h"
#include "tests/unit/subdiv/testCages.h"
#include "tests/unit/trace/rayAnswer.h"
#include "tests/unit/trace/traceKit.h"

namespace cc::test {
namespace {

/// A camera somewhere around a box, that looks at a point of it.
LevelView RandomView(const Box3f& bounds, std::mt19937* random) {
    std::uniform_real_distribution<float> unit(0, 1);
    const auto somewhere = [&](float size) {
        return bounds.Center() + size * Vec3f{(unit(*random) - 0.5f) * bounds.Size().x,
                                              (unit(*random) - 0.5f) * bounds.Size().y,
                                              (unit(*random) - 0.5f) * bounds.Size().z};
    };
    const Vec3f eye = somewhere(1.5f), target = somewhere(1);
    LevelView view{};
    view.eye = {eye.x, eye.y, eye.z};
    view.forward = Normalize(target - eye + Vec3f{1e-6f, 0, 0});
    view.pixels = 500;
    view.leastCosine = 0.8f;
    return view;
}

LevelMetric RandomMetric(const Box3f& bounds, bool isByDistance, std::mt19937* random) {
    const LevelView view = RandomView(bounds, random);
    if (!isByDistance) {
        return PixelErrorMetric{view, 0.25f, 8};
    }
    std::uniform_real_distribution<float> unit(0, 1);
    return DistanceMetric{view.eye, bounds.Diagonal() * std::exp2(6 + 3 * unit(*random)), 8};
}

class InstanceLevelsTest : public testing::TestWithParam<Cage> {};

using EdgePart = std::array<std::array<int, 3>, 2>;

/// The place of a point of the surface, coarse enough for all patches to find the same.
std::array<int, 3> PlaceOf(const Surface& surface, uint32_t patch, const Vec2f& at) {
    const Vec3f p =
        EvaluateLimitValue(surface.Patches(), patch, surface.PatchPoints().data(), at.x, at.y) -
        surface.Bounds().lower;
    const float scale = 1e4f / surface.Bounds().Diagonal();
    return {static_cast<int>(std::lround(scale * p.x + 0.123f)),
            static_cast<int>(std::lround(scale * p.y + 0.123f)),
            static_cast<int>(std::lround(scale * p.z + 0.123f))};
}

/// Cages with patches of several sizes side by side are what this is about.
TEST_P(InstanceLevelsTest, AnEdgeHasOneLevelFromAllSides) {
    const TracedCage traced(GetParam());
    const Surface& surface = *traced.surface;
    const PatchTable& patches = surface.Patches();
    if (patches.IsCutAlike()) {
        return;  // has one level
    }
    constexpr Vec2f kCorners[4] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    const int finest = patches.MaxDepth();
    std::mt19937 random(5);
    for (int round = 0; round < 40; ++round) {
        const LevelMetric metric = RandomMetric(traced.world.Bounds(), round % 2 == 0, &random);
        const InstanceLevels levels(metric, traced.world.Instances()[0]);
        std::map<EdgePart, int> found;
        for (uint32_t patch = 0; patch < patches.Count(); ++patch) {
            const PatchLevels of = levels.Of(patch);
            const int parts = 1 << (finest - patches.At(patch).depth);
            for (int edge = 0; edge < 4; ++edge) {
                const Vec2f a = kCorners[edge], b = kCorners[(edge + 1) & 3];
                for (int i = 0; i < parts; ++i) {
                    const float s = static_cast<float>(i) / static_cast<float>(parts);
                    const float e = static_cast<float>(i + 1) / static_cast<float>(parts);
                    EdgePart part{
                        PlaceOf(surface, patch, {a.x + s * (b.x - a.x), a.y + s * (b.y - a.y)}),
                        PlaceOf(surface, patch, {a.x + e * (b.x - a.x), a.y + e * (b.y - a.y)})};
                    std::sort(part.begin(), part.end());
                    const int level = found.try_emplace(part, of.edges[edge]).first->second;
                    ASSERT_EQ(level, of.edges[edge]) << "patch " << patch << ", edge " << edge;
                }
                EXPECT_GE(of.edges[edge], finest);
            }
        }
    }
}

/// The middle of a patch is coarse, medium or fine by where its distance is among powers of two.
TEST_P(InstanceLevelsTest, DistanceChoosesOneOfThreeLevels) {
    const TracedCage traced(GetParam());
    const PatchTable& patches = traced.surface->Patches();
    if (patches.IsCutAlike()) {
        return;  // has one level
    }
    std::mt19937 random(7);
    for (int round = 0; round < 20; ++round) {
        const LevelView view = RandomView(traced.world.Bounds(), &random);
        const DistanceMetric metric{view.eye, 20 * traced.world.Bounds().Diagonal(), 6};
        const InstanceLevels levels(metric, traced.world.Instances()[0]);
        for (uint32_t patch = 0; patch < patches.Count(); ++patch) {
            EdgePoints ends[4];
            patches.EdgeEnds(patch, ends);
            std::array<double, 3> middle{};
            for (int axis = 0; axis < 3; ++axis) {
                for (const EdgePoints& edge : ends) {
                    middle[axis] += (traced.surface->PatchPoints()[edge.a][axis] +
                                     traced.surface->PatchPoints()[edge.b][axis]) /
                                    8.0;
                }
                middle[axis] -= view.eye[axis];
            }
            const double level =
                std::log2(metric.reach / std::hypot(middle[0], middle[1], middle[2]));
            const auto expected = [&](double slack) {
                return std::clamp(static_cast<int>(std::floor(level + slack)), 4, 6);
            };
            EXPECT_GE(levels.Of(patch).interior, expected(-1e-4)) << patch;
            EXPECT_LE(levels.Of(patch).interior, expected(1e-4)) << patch;
        }
    }
}

/// Grids can be stitched over five levels. Control points, which edges are placed by, may be at the
/// eye while the surface is not.
TEST_P(InstanceLevelsTest, SpanFiveLevelsAtMost) {
    const TracedCage traced(GetParam());
    const PatchTable& patches = traced.surface->Patches();
    if (patches.IsCutAlike()) {
        return;  // has one level
    }
    std::mt19937 random(11);
    std::uniform_real_distribution<float> unit(0, 1);
    for (int round = 0; round < 50; ++round) {
        LevelView view = RandomView(traced.world.Bounds(), &random);
        const std::vector<Vec3f>& points = traced.surface->PatchPoints();
        const Vec3f eye = points[random() % points.size()];
        view.eye = {eye.x, eye.y, eye.z};
        const PixelErrorMetric metric{view, 100 * std::exp2(-20 * unit(random)), 8};
        const InstanceLevels levels(metric, traced.world.Instances()[0]);
        int finest = 0, coarsest = kFinestLevel;
        for (uint32_t patch = 0; patch < patches.Count(); ++patch) {
            finest = std::max(finest, levels.Of(patch).Finest());
            coarsest = std::min(coarsest, levels.Of(patch).Coarsest());
        }
        EXPECT_LE(finest - coarsest, 5);
    }
}

/// Where neighbours differ the finer one ends in no fans, but where quads are long and thin.
TEST(InstanceLevels, FansAreOnTheCoarserSide) {
    const TracedCage traced(Cube());
    const PatchTable& patches = traced.surface->Patches();
    std::mt19937 random(9);
    int fanned = 0;
    for (int round = 0; round < 200; ++round) {
        const LevelMetric metric = RandomMetric(traced.world.Bounds(), true, &random);
        const InstanceLevels levels(metric, traced.world.Instances()[0]);
        for (uint32_t patch = 0; patch < patches.Count(); ++patch) {
            const PatchLevels of = levels.Of(patch);
            EXPECT_EQ(of.Coarsest(), of.interior);
            fanned += of.Finest() > of.interior;
        }
    }
    EXPECT_GT(fanned, 100);
}

/// The point of a level's quads at parameters of a quad patch.
Vec3f OnQuads(const Surface& surface, uint32_t patch, int splits, float u, float v) {
    const auto side = static_cast<float>(1 << splits);
    const float column = std::min(std::floor(u * side), side - 1);
    const float row = std::min(std::floor(v * side), side - 1);
    const float across = u * side - column, along = v * side - row;
    const auto at = [&](float i, float j) {
        return EvaluateLimitValue(surface.Patches(), patch, surface.PatchPoints().data(),
                                  (column + i) / side, (row + j) / side);
    };
    const float most = std::max(across, along), least = std::min(across, along);
    return (1 - most) * at(0, 0) + (most - least) * (across > along ? at(1, 0) : at(0, 1)) +
           least * at(1, 1);
}

TEST_P(InstanceLevelsTest, QuadsAreNoFurtherFromTheSurfaceThanErrorsSay) {
    const TracedCage traced(GetParam());
    const Surface& surface = *traced.surface;
    const PatchTable& patches = surface.Patches();
    if (patches.IsCutAlike()) {
        return;  // has one level
    }
    std::mt19937 random(5);
    std::uniform_real_distribution<float> unit(0, 1);
    for (uint32_t patch = 0; patch < patches.Count(); ++patch) {
        EdgePoints edges[4];
        patches.EdgeEnds(patch, edges);
        float error = 1e30f;
        for (const EdgePoints& edge : edges) {
            error = std::min({error, surface.Errors().At(edge.a), surface.Errors().At(edge.b)});
        }
        for (int n = 0; n < 20; ++n) {
            const int level = patches.At(patch).depth + n % 5;
            const float u = unit(random), v = unit(random);
            const Vec3f off =
                EvaluateLimitValue(patches, patch, surface.PatchPoints().data(), u, v) -
                OnQuads(surface, patch, n % 5, u, v);
            EXPECT_LE(Length(off), error / static_cast<float>(1 << (2 * level)) +
                                       2e-6f * surface.Bounds().Diagonal())
                << "patch " << patch << ", level " << level << ", kind "
                << static_cast<int>(patches.At(patch).kind) << ", error " << error;
        }
    }
}

/// Rays from the eye hit what they hit on the finest quads, but for the error that is allowed.
TEST_P(InstanceLevelsTest, HitsAreWithinTheErrorInThePicture) {
    const TracedCage traced(GetParam());
    const Box3f bounds = traced.world.Bounds();
    std::mt19937 random(9);
    const auto reference = MakeTracer(TracerKind::Packet, 6);
    for (int n = 0; n < Repeats(8); ++n) {
        const Vec3f from[] = {{1, 0.2f, 0.3f}, {-0.4f, 1, 0.1f}, {0.2f, -0.3f, 1}};
        RayPacket rays = CameraPacket(bounds, from[n % 3], 0.3f, &random);
        LevelView view{};
        view.eye = {rays.originX[0], rays.originY[0], rays.originZ[0]};
        view.forward =
            Normalize(bounds.Center() - Vec3f{rays.originX[0], rays.originY[0], rays.originZ[0]});
        view.pixels = 400;
        view.leastCosine = 0.5f;
        const float pixelError = n % 2 == 0 ? 0.25f : 2;
        const PixelErrorMetric metric{view, pixelError, 6};
        const auto tracer = MakeTracer(TracerKind::Packet, metric);
        const InstanceLevels levels(metric, traced.world.Instances()[0]);
        RayPacket expectedRays = rays;
        HitPacket hits, expected;
        TraceStatistics statistics;
        tracer->Intersect(traced.world, &rays, &hits, &statistics);
        reference->Intersect(traced.world, &expectedRays, &expected, &statistics);
        for (int i = 0; i < rays.count; ++i) {
            if (hits.instance[i] == kNoHit || expected.instance[i] == kNoHit ||
                hits.patch[i] != expected.patch[i]) {
                continue;  // by a silhouette or an edge
            }
            const Surface& surface = *traced.surface;
            if ((levels.IsUniform() ? levels.Uniform() : levels.Of(hits.patch[i]).interior) == 6) {
                continue;  // as fine as may be
            }
            const LimitPoint limit =
                EvaluateLimit(surface.Patches(), hits.patch[i], surface.PatchPoints().data(),
                              hits.u[i], hits.v[i]);
            const Vec3f at = PointOf(rays, i);
            const float depth =
                Dot(view.forward, at - Vec3f{rays.originX[i], rays.originY[i], rays.originZ[i]});
            // What is said of a hit is where it is, as far as the picture can tell.
            EXPECT_LE(Length(limit.position - at) * view.pixels / depth, pixelError)
                << "patch " << hits.patch[i] << " at " << hits.u[i] << ", " << hits.v[i];
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Catalogue, InstanceLevelsTest, testing::ValuesIn(Sample(AllCages())),
                         TestName);

}  // namespace
}  // namespace cc::test
