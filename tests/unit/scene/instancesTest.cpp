#include <cmath>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "core/scene/scene.h"
#include "core/trace/tracer.h"
#include "tests/unit/render/renderTestKit.h"
#include "tests/unit/subdiv/cageKit.h"

namespace cc::test {
namespace {

AffineTransform Moved(double x, double y, double z, double scale = 1) {
    return AffineTransform({{{scale, 0, 0, x}, {0, scale, 0, y}, {0, 0, scale, z}}});
}

/// Turned about z by so many quarters and then moved: exact, whatever the order of operations.
AffineTransform Turned(int quarters, double x, double y, double z) {
    const double c[] = {1, 0, -1, 0}, s[] = {0, 1, 0, -1};
    const int q = quarters % 4;
    return AffineTransform({{{c[q], -s[q], 0, x}, {s[q], c[q], 0, y}, {0, 0, 1, z}}});
}

/// Rays from random points around a box of this size to others.
RayPacket RandomRays(float size, std::mt19937* random) {
    std::uniform_real_distribution<float> place(-size, size);
    RayPacket rays;
    rays.count = kPacketSize;
    for (int i = 0; i < kPacketSize; ++i) {
        const Vec3f from{place(*random), place(*random), place(*random)};
        const Vec3f to{place(*random), place(*random), place(*random)};
        rays.originX[i] = from.x;
        rays.originY[i] = from.y;
        rays.originZ[i] = from.z;
        rays.directionX[i] = to.x - from.x;
        rays.directionY[i] = to.y - from.y;
        rays.directionZ[i] = to.z - from.z;
        rays.tMin[i] = 0;
        rays.tMax[i] = 10;
    }
    return rays;
}

std::vector<AffineTransform> Places() {
    std::vector<AffineTransform> places;
    for (int i = 0; i < 27; ++i) {
        places.push_back(Turned(i, 4 * (i % 3) - 4, 4 * (i / 3 % 3) - 4, 4 * (i / 9) - 4));
    }
    return places;
}

TEST(Instances, AreHitAsCopiesOfTheMeshAre) {
    Scene copies, instances;
    const std::vector<AffineTransform> places = Places();
    for (size_t i = 0; i < places.size(); ++i) {
        AddCage(&copies, "/mesh" + std::to_string(100 + i),
                WithCrease(Cube(), {0, 1}, 2, "creased"))
            ->SetTransform(places[i] * Moved(0.5, 0, 0));
    }
    Mesh* prototype = AddCage(&instances, "/mesh", WithCrease(Cube(), {0, 1}, 2, "creased"));
    prototype->SetTransform(Moved(0.5, 0, 0));
    prototype->SetInstances(places);
    EXPECT_TRUE(copies.Build({"geometry"}).empty());
    EXPECT_TRUE(instances.Build({"geometry"}).empty());
    EXPECT_EQ(instances.GetStatistics().instances, places.size());
    EXPECT_EQ(instances.GetStatistics().faces, copies.GetStatistics().faces / places.size());

    std::mt19937 random(1);
    for (const TracerKind kind : {TracerKind::Packet, TracerKind::Single, TracerKind::Algorithm1,
                                  TracerKind::Tessellated}) {
        const auto tracer = MakeTracer(kind, 3);
        std::set<uint32_t> seen;
        for (int i = 0; i < 30; ++i) {
            RayPacket a = RandomRays(7, &random), b = a;
            HitPacket hitsOfCopies, hits;
            TraceStatistics statistics;
            tracer->Intersect(copies.Instances(), &a, &hitsOfCopies, &statistics);
            tracer->Intersect(instances.Instances(), &b, &hits, &statistics);
            for (int lane = 0; lane < kPacketSize; ++lane) {
                ASSERT_EQ(hits.patch[lane], hitsOfCopies.patch[lane]);
                if (hits.instance[lane] == kNoHit) {
                    continue;
                }
                ASSERT_EQ(b.tMax[lane], a.tMax[lane]);
                ASSERT_EQ(&instances.InstanceShape(hits.instance[lane]), prototype);
                ASSERT_EQ(instances.InstanceIndex(hits.instance[lane]),
                          hitsOfCopies.instance[lane]);
                ASSERT_EQ(copies.InstanceIndex(hitsOfCopies.instance[lane]), 0u);
                seen.insert(instances.InstanceIndex(hits.instance[lane]));
            }
        }
        EXPECT_GT(seen.size(), 20u);
    }
}

/// A scene of one cube with instances, and what builds say.
struct Prototype {
    Prototype() : mesh(AddCage(&scene, "/mesh", Cube())) {}

    std::vector<std::string> Build() { return scene.Build({"geometry"}); }
    size_t Shown() const { return scene.Instances().Instances().size(); }

    Scene scene;
    Mesh* mesh;
};

TEST(Instances, ComeAndGo) {
    Prototype one;
    one.Build();
    EXPECT_EQ(one.Shown(), 1u);
    one.mesh->SetInstances(Places());
    one.Build();
    EXPECT_EQ(one.Shown(), 27u);
    one.mesh->SetInstances({});
    EXPECT_TRUE(one.Build().empty());
    EXPECT_EQ(one.Shown(), 0u);
    EXPECT_TRUE(one.scene.Instances().Bounds().IsEmpty());
    one.mesh->ClearInstances();
    one.Build();
    EXPECT_EQ(one.Shown(), 1u);
    EXPECT_EQ(one.scene.GetStatistics().surfacesBuilt, 1u);
    EXPECT_EQ(one.scene.GetStatistics().topLevelsBuilt, 4u);
    one.Build();
    EXPECT_EQ(one.scene.GetStatistics().topLevelsBuilt, 4u);
}

TEST(Instances, ThatHaveNoPlaceAreLeftOutWithALine) {
    Prototype one;
    Cage large = Cube();
    for (Vec3f& p : large.points) {
        p = p * 4;
    }
    one.mesh->SetPoints(large.points);
    one.mesh->SetInstances({Moved(1, 0, 0), Moved(2, 0, 0, 0), Moved(3, 0, 0), Moved(NAN, 0, 0),
                            Moved(5, 0, 0, 9e17)});
    const std::vector<std::string> lines = one.Build();
    ASSERT_EQ(lines.size(), 2u);
    EXPECT_EQ(lines[0],
              "</mesh>: 2 of 5 instances have a singular or non-finite transform; they "
              "are left out");
    EXPECT_EQ(lines[1],
              "</mesh>: 1 of 5 instances are too large once transformed; they are left out");
    ASSERT_EQ(one.Shown(), 2u);
    EXPECT_EQ(one.scene.InstanceIndex(0), 0u);
    EXPECT_EQ(one.scene.InstanceIndex(1), 2u);
    EXPECT_TRUE(one.Build().empty());
    // Said again only when they are set again.
    one.mesh->SetInstances({Moved(1, 0, 0)});
    EXPECT_TRUE(one.Build().empty());
    EXPECT_EQ(one.Shown(), 1u);
}

TEST(Instances, HavePrimvarsOfTheirOwn) {
    Prototype one;
    const Primvar colors{Interpolation::Instance, 3, {1, 0, 0, 0, 1, 0}, {1, 0, 1}};
    one.mesh->SetInstances({Moved(0, 0, 0), Moved(4, 0, 0), Moved(8, 0, 0)});
    one.mesh->SetPrimvar("displayColor", colors);
    EXPECT_TRUE(one.Build().empty());
    EXPECT_EQ(one.mesh->DisplayColor({0, 0, 0.5f, 0.5f}), (Vec3f{0, 1, 0}));
    EXPECT_EQ(one.mesh->DisplayColor({1, 0, 0.5f, 0.5f}), (Vec3f{1, 0, 0}));

    // Fewer instances than values, until there are as many again.
    one.mesh->SetInstances({Moved(0, 0, 0), Moved(4, 0, 0)});
    const std::vector<std::string> lines = one.Build();
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_EQ(lines[0],
              "</mesh>: displayColor is instance and has 3 elements where 2 belong; the "
              "mesh is shown in grey");
    EXPECT_EQ(one.mesh->DisplayColor({1, 0, 0.5f, 0.5f}), kDefaultDisplayColor);
    one.mesh->SetInstances({Moved(0, 0, 0), Moved(4, 0, 0), Moved(8, 1, 0)});
    EXPECT_TRUE(one.Build().empty());
    EXPECT_EQ(one.mesh->DisplayColor({1, 0, 0.5f, 0.5f}), (Vec3f{1, 0, 0}));

    // A new surface keeps them.
    one.mesh->SetTopology(Drum(5).mesh);
    one.mesh->SetPoints(Drum(5).points);
    EXPECT_TRUE(one.Build().empty());
    EXPECT_EQ(one.mesh->DisplayColor({2, 0, 0.5f, 0.5f}), (Vec3f{0, 1, 0}));
}

}  // namespace
}  // namespace cc::test
