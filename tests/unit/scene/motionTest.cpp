#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "core/scene/scene.h"
#include "core/trace/tracer.h"
#include "tests/repeats.h"
#include "tests/unit/render/renderTestKit.h"
#include "tests/unit/subdiv/cageKit.h"

namespace cc::test {
namespace {

using Points = std::vector<Vec3f>;

AffineTransform Turned(double angle, double x, double y) {
    const double c = std::cos(angle), s = std::sin(angle);
    return AffineTransform({{{c, -s, 0, x}, {s, c, 0, y}, {0, 0, 1, 0}}});
}

RayPacket RaysThrough(const Box3f& box, std::mt19937* random) {
    std::uniform_real_distribution<float> unit(0, 1);
    RayPacket rays;
    rays.count = kPacketSize;
    float* const origins[3] = {rays.originX, rays.originY, rays.originZ};
    float* const directions[3] = {rays.directionX, rays.directionY, rays.directionZ};
    for (int lane = 0; lane < kPacketSize; ++lane) {
        for (int axis = 0; axis < 3; ++axis) {
            const float size = box.upper[axis] - box.lower[axis];
            origins[axis][lane] = box.lower[axis] + size * (3 * unit(*random) - 1);
            directions[axis][lane] = box.lower[axis] + size * unit(*random) - origins[axis][lane];
        }
        rays.tMin[lane] = 0;
        rays.tMax[lane] = 10;
    }
    return rays;
}

/// Expects rays to hit the same in two scenes of as many instances. Returns how many hit.
int ExpectSameHits(const Scene& scene, const Scene& expected, const LevelMetric& levels,
                   std::mt19937* random) {
    const Box3f bounds = expected.Instances().Bounds();
    int hitCount = 0;
    for (const TracerKind kind : {TracerKind::Packet, TracerKind::Single, TracerKind::Algorithm1}) {
        const auto tracer = MakeTracer(kind, levels);
        for (int i = 0; i < 4; ++i) {
            RayPacket rays = RaysThrough(bounds, random), expectedRays = rays;
            HitPacket hits, expectedHits;
            TraceStatistics statistics;
            EXPECT_EQ(tracer->Occluded(scene.Instances(), rays, &statistics),
                      tracer->Occluded(expected.Instances(), rays, &statistics));
            tracer->Intersect(scene.Instances(), &rays, &hits, &statistics);
            tracer->Intersect(expected.Instances(), &expectedRays, &expectedHits, &statistics);
            for (int lane = 0; lane < kPacketSize; ++lane) {
                EXPECT_EQ(hits.instance[lane], expectedHits.instance[lane]);
                EXPECT_EQ(hits.patch[lane], expectedHits.patch[lane]);
                EXPECT_EQ(rays.tMax[lane], expectedRays.tMax[lane]);
                hitCount += hits.instance[lane] != kNoHit;
            }
        }
    }
    return hitCount;
}

Points Bent(const Points& points, float by) {
    Points bent = points;
    for (Vec3f& p : bent) {
        p = {p.x + by * p.y * p.y, p.y - by, p.z * (1 + by * p.x)};
    }
    return bent;
}

Points Between(const Points& a, const Points& b, double weight) {
    Points points = a;
    for (size_t i = 0; i < points.size(); ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            points[i][axis] = static_cast<float>((1 - weight) * a[i][axis] + weight * b[i][axis]);
        }
    }
    return points;
}

class MovingCage : public testing::TestWithParam<Cage> {};

TEST_P(MovingCage, IsHitAsTheSameAtRest) {
    const Cage& cage = GetParam();
    const std::vector<Points> poses = {Bent(cage.points, -2), cage.points, Bent(cage.points, 1.5f)};
    Scene moving;
    AddCage(&moving, "/mesh", cage)->SetMovingPoints({{-1, 0, 1}, poses});
    ASSERT_TRUE(moving.Build({"geometry"}).empty());
    EXPECT_TRUE(moving.IsMoving());
    std::mt19937 random(5);
    int hits = 0;
    for (const float time : {-1.0f, -0.75f, 0.0f, 0.5f, 1.0f, 3.0f}) {
        const double weight = std::fabs(time) > 1 ? 1 : std::fabs(time);
        Scene rest;
        AddCage(&rest, "/mesh", cage)
            ->SetPoints(Between(poses[1], poses[time < 0 ? 0 : 2], weight));
        ASSERT_TRUE(rest.Build({"geometry"}).empty());
        moving.SetTime(time);
        hits += ExpectSameHits(moving, rest, 3, &random);
    }
    EXPECT_GT(hits, 300);
}

INSTANTIATE_TEST_SUITE_P(Motion, MovingCage,
                         testing::Values(Cube(), Torus(8, 5), Fan(7),
                                         WithCrease(Cube(), {0, 1}, 2, "creased"),
                                         LoopIcosahedron(),
                                         WithScheme(Cube(), Scheme::Bilinear, "bilinear")),
                         [](const auto& info) { return "cage" + std::to_string(info.index); });

/// Points of random curves or spheres, a unit or so apart.
Points RandomPoints(int count, std::mt19937* random) {
    std::uniform_real_distribution<float> unit(-1, 1);
    Points points;
    for (int i = 0; i < count; ++i) {
        points.push_back({unit(*random), unit(*random), unit(*random)});
    }
    return points;
}

const Primvar kWidths{Interpolation::Constant, 1, {0.2f}, {}};

cc::Points* AddSpheres(Scene* scene) {
    cc::Points* const spheres = scene->AddPoints("/spheres");
    spheres->SetWidths(kWidths);
    return spheres;
}

Curves* AddTubes(Scene* scene) {
    Curves* const tubes = scene->AddCurves("/tubes");
    tubes->SetTopology({CurveBasis::CatmullRom, CurveWrap::Pinned, {6, 6, 6, 6}});
    tubes->SetWidths(kWidths);
    return tubes;
}

/// Expects a shape whose points move to be hit as one whose points rest where they are then.
template <class Shape>
void ExpectMotionOfPoints(Shape* (*add)(Scene*), std::mt19937* random) {
    const Points begin = RandomPoints(24, random), end = Bent(begin, 1.5f);
    Scene moving;
    add(&moving)->SetMovingPoints({{0, 1}, {begin, end}});
    ASSERT_TRUE(moving.Build({"geometry"}).empty());
    EXPECT_TRUE(moving.IsMoving());
    int hits = 0;
    for (const float time : {0.0f, 0.25f, 1.0f, 0.5f}) {
        Scene rest;
        add(&rest)->SetPoints(Between(begin, end, time));
        ASSERT_TRUE(rest.Build({"geometry"}).empty());
        moving.SetTime(time);
        hits += ExpectSameHits(moving, rest, 3, random);
    }
    EXPECT_GT(hits, 100);
}

TEST(Motion, OfSpheresIsThatOfTheirCentres) {
    std::mt19937 random(7);
    ExpectMotionOfPoints(AddSpheres, &random);
}

TEST(Motion, OfCurvesIsThatOfTheirPoints) {
    std::mt19937 random(8);
    ExpectMotionOfPoints(AddTubes, &random);
}

TEST(Motion, OfSpheresOutlivesAnEditOfWidths) {
    std::mt19937 random(9);
    const Points begin = RandomPoints(24, &random), end = Bent(begin, 1);
    Scene moving, rest;
    cc::Points* const spheres = AddSpheres(&moving);
    spheres->SetMovingPoints({{0, 1}, {begin, end}});
    moving.Build({"geometry"});
    moving.SetTime(1);
    const Primvar wide{Interpolation::Constant, 1, {0.5f}, {}};
    spheres->SetWidths(wide);
    moving.Build({"geometry"});
    cc::Points* const resting = rest.AddPoints("/spheres");
    resting->SetWidths(wide);
    resting->SetPoints(begin);
    rest.Build({"geometry"});
    EXPECT_GT(ExpectSameHits(moving, rest, 3, &random), 100);
    moving.SetTime(0.5f);
    resting->SetPoints(Between(begin, end, 0.5));
    rest.Build({"geometry"});
    EXPECT_GT(ExpectSameHits(moving, rest, 3, &random), 100);
}

template <class Shape>
void ExpectRestWithAWarning(Shape* (*add)(Scene*), std::mt19937* random) {
    const Points points = RandomPoints(24, random);
    Scene scene;
    add(&scene)->SetMovingPoints({{0, 1}, {points, Points(3)}});
    const std::vector<std::string> lines = scene.Build({"geometry"});
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_NE(lines[0].find(": pose 1 of its motion has 3 points, and the first 24; it is shown "
                            "at rest"),
              std::string::npos)
        << lines[0];
    EXPECT_FALSE(scene.IsMoving());
    EXPECT_TRUE(scene.Build({"geometry"}).empty());
}

TEST(Motion, OfAnotherNumberOfSpheresOrCurvePointsIsNone) {
    std::mt19937 random(10);
    ExpectRestWithAWarning(AddSpheres, &random);
    ExpectRestWithAWarning(AddTubes, &random);
}

TEST(Motion, OfPlacesIsThatOfTheirNumbers) {
    const std::vector<AffineTransform> own = {Turned(0, 0, 0), Turned(0.7, 1, 0)};
    const std::vector<std::vector<AffineTransform>> places = {
        {Turned(0, -4, 0), Turned(0, 4, 0)}, {Turned(0.3, -4, 2), Turned(-0.4, 9, 0)}};
    Scene moving;
    Mesh* const mesh = AddCage(&moving, "/mesh", Cube());
    mesh->SetMovingTransform({{0, 1}, own});
    mesh->SetMovingInstances({{0, 0.5f}, places});
    ASSERT_TRUE(moving.Build({"geometry"}).empty());
    std::mt19937 random(6);
    int hits = 0;
    for (const float time : {0.0f, 0.25f, 0.5f, 0.75f, 1.0f}) {
        const double ofPlaces = std::min(time / 0.5f, 1.0f);
        Scene rest;
        Mesh* const resting = AddCage(&rest, "/mesh", Cube());
        resting->SetTransform(AffineTransform::Lerp(own[0], own[1], time));
        resting->SetInstances({AffineTransform::Lerp(places[0][0], places[1][0], ofPlaces),
                               AffineTransform::Lerp(places[0][1], places[1][1], ofPlaces)});
        ASSERT_TRUE(rest.Build({"geometry"}).empty());
        moving.SetTime(time);
        hits += ExpectSameHits(moving, rest, 3, &random);
    }
    EXPECT_GT(hits, 100);
}

TEST(Motion, EndsWhereBuildBegins) {
    Scene scene;
    Mesh* const mesh = AddCage(&scene, "/mesh", Cube());
    mesh->SetMovingPoints({{0, 1}, {Cube().points, Bent(Cube().points, 1)}});
    scene.Build({"geometry"});
    const std::vector<Vec3f> begin = mesh->BuiltSurface()->PatchPoints();
    scene.SetTime(1);
    EXPECT_NE(mesh->BuiltSurface()->PatchPoints(), begin);
    scene.Build({"geometry"});
    EXPECT_EQ(mesh->BuiltSurface()->PatchPoints(), begin);
    scene.SetTime(1);
    mesh->SetTopology(WithCrease(Cube(), {0, 1}, 2, "creased").mesh);
    scene.Build({"geometry"});
    EXPECT_EQ(mesh->BuiltSurface()->PatchPoints()[0], Cube().points[0]);
    EXPECT_TRUE(scene.IsMoving());
    mesh->SetPoints(Cube().points);
    scene.Build({"geometry"});
    EXPECT_FALSE(scene.IsMoving());
    EXPECT_EQ(mesh->BuiltSurface()->PatchPoints()[0], Cube().points[0]);
}

TEST(Motion, MayBeginWhereTheMeshRested) {
    Scene scene;
    Mesh* const mesh = AddCage(&scene, "/mesh", Cube());
    scene.Build({"geometry"});
    mesh->SetMovingPoints({{0, 1}, {Cube().points, Bent(Cube().points, 1)}});
    scene.Build({"geometry"});
    EXPECT_TRUE(scene.IsMoving());
    const std::vector<Vec3f> begin = mesh->BuiltSurface()->PatchPoints();
    scene.SetTime(1);
    EXPECT_NE(mesh->BuiltSurface()->PatchPoints(), begin);
    mesh->SetPoints(Cube().points);
    scene.Build({"geometry"});
    EXPECT_FALSE(scene.IsMoving());
    EXPECT_EQ(mesh->BuiltSurface()->PatchPoints(), begin);
}

TEST(Motion, ThatDoesNotFitLeavesTheMeshAtRest) {
    const Points few(3), nan(8, Vec3f{std::numeric_limits<float>::quiet_NaN(), 0, 0});
    for (const Points& bad : {few, nan, Points()}) {
        Scene scene;
        Mesh* const mesh = AddCage(&scene, "/mesh", Cube());
        mesh->SetMovingPoints({{0, 1}, {Cube().points, bad}});
        const std::vector<std::string> lines = scene.Build({"geometry"});
        ASSERT_EQ(lines.size(), 1u);
        EXPECT_EQ(lines[0].find("</mesh>: pose 1 of its motion has "), 0u) << lines[0];
        EXPECT_NE(lines[0].find("; it is shown at rest"), std::string::npos) << lines[0];
        EXPECT_FALSE(scene.IsMoving());
        EXPECT_EQ(scene.Instances().Instances().size(), 1u);
        EXPECT_TRUE(scene.Build({"geometry"}).empty());
    }
}

TEST(Motion, ThroughNothingIsShownAsAtTheBeginning) {
    Scene scene;
    Mesh* const mesh = AddCage(&scene, "/mesh", Cube());
    // Half a turn: in the middle the numbers are those of no transform.
    mesh->SetMovingTransform({{0, 1}, {Turned(0, 0, 0), Placed(-1, 0, 0, 0)}});
    EXPECT_TRUE(scene.Build({"geometry"}).empty());
    scene.SetTime(0.5f);
    EXPECT_EQ(scene.Instances().Instances()[0].objectToWorld, Turned(0, 0, 0));
    scene.SetTime(0.75f);
    EXPECT_EQ(scene.Instances().Instances()[0].objectToWorld, Placed(-0.5, 0, 0, 0));
}

TEST(Motion, OfInstancesWithoutATransformIsWarnedOf) {
    Scene scene;
    Mesh* const mesh = AddCage(&scene, "/mesh", Cube());
    mesh->SetMovingInstances(
        {{0, 1},
         {{Placed(1, 0, 0, 0), Placed(1, 3, 0, 0)}, {Placed(1, 1, 0, 0), Placed(0, 3, 0, 0)}}});
    const std::vector<std::string> lines = scene.Build({"geometry"});
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_NE(lines[0].find("1 of 2 instances"), std::string::npos) << lines[0];
    EXPECT_EQ(scene.Instances().Instances().size(), 1u);
}

}  // namespace
}  // namespace cc::test
