#include "core/scene/mesh.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/scene/scene.h"
#include "tests/unit/render/renderTestKit.h"

namespace cc::test {
namespace {

/// A scene with one mesh, and what its builds say and did.
struct OneMesh {
    explicit OneMesh(const Cage& cage) : mesh(AddCage(&scene, "/mesh", cage)) {}

    std::vector<std::string> Build() { return scene.Build({"geometry"}); }
    /// The only line that a build says, which must name the mesh.
    std::string BuildLine() {
        const std::vector<std::string> lines = Build();
        EXPECT_EQ(lines.size(), 1u);
        const std::string line = lines.empty() ? "" : lines[0];
        EXPECT_EQ(line.rfind("</mesh>: ", 0), 0u) << line;
        EXPECT_EQ(line.find('\n'), std::string::npos);
        return line;
    }
    void ExpectSilent() {
        for (const std::string& line : Build()) {
            ADD_FAILURE() << line;
        }
    }
    size_t Shown() const { return scene.Instances().Instances().size(); }
    Vec3f Color() const { return mesh->DisplayColor({0, 0, 0.5f, 0.5f}); }

    Scene scene;
    Mesh* mesh;
};

bool Says(const std::string& line, const std::string& what) {
    return line.find(what) != std::string::npos;
}

TEST(Mesh, PointsMoveTheSurfaceAndKeepThePatches) {
    Cage cage = Cube();
    OneMesh one(cage);
    one.ExpectSilent();
    const Surface* surface = one.mesh->BuiltSurface();
    ASSERT_NE(surface, nullptr);
    const float width = surface->Bounds().Size().x;
    for (Vec3f& p : cage.points) {
        p.x *= 3;
    }
    one.mesh->SetPoints(cage.points);
    one.ExpectSilent();
    EXPECT_EQ(one.mesh->BuiltSurface(), surface);
    EXPECT_NEAR(surface->Bounds().Size().x, 3 * width, 0.1f);
    EXPECT_EQ(one.scene.GetStatistics().surfacesBuilt, 1u);
    EXPECT_EQ(one.scene.GetStatistics().surfacesMoved, 1u);
}

TEST(Mesh, TopologyAloneKeepsThePoints) {
    OneMesh one(Cube());
    one.ExpectSilent();
    const float smooth = one.mesh->BuiltSurface()->Bounds().Size().x;
    ControlMesh topology = Cube().mesh;
    topology.scheme = Scheme::Bilinear;
    one.mesh->SetTopology(topology);
    one.ExpectSilent();
    EXPECT_EQ(one.scene.GetStatistics().surfacesBuilt, 2u);
    EXPECT_GT(one.mesh->BuiltSurface()->Bounds().Size().x, smooth);
    EXPECT_NEAR(one.mesh->BuiltSurface()->Bounds().Size().x, 2, 1e-3f);
}

TEST(Mesh, ColorOutlivesTopologyAndPoints) {
    OneMesh one(Cube());
    one.mesh->SetPrimvar("displayColor",
                         Primvar3(Interpolation::Vertex, std::vector<Vec3f>(8, {1, 0.5f, 0})));
    one.ExpectSilent();
    one.mesh->SetPoints(Cube().points);
    one.ExpectSilent();
    EXPECT_NEAR(one.Color().y, 0.5f, 1e-6f);
    one.mesh->SetTopology(Cube().mesh);
    one.ExpectSilent();
    EXPECT_NEAR(one.Color().y, 0.5f, 1e-6f);
}

TEST(Mesh, ColorIsSpreadWithoutTheTopologyThatIsGone) {
    OneMesh one(Cube());
    one.ExpectSilent();
    for (const Interpolation interpolation :
         {Interpolation::Uniform, Interpolation::Varying, Interpolation::FaceVarying}) {
        const size_t count = interpolation == Interpolation::Uniform   ? 6
                             : interpolation == Interpolation::Varying ? 8
                                                                       : 24;
        one.mesh->SetPrimvar("displayColor",
                             Primvar3(interpolation, std::vector<Vec3f>(count, {0, 1, 0})));
        one.ExpectSilent();
        EXPECT_NEAR(one.Color().y, 1, 1e-6f);
        EXPECT_NEAR(one.Color().x, 0, 1e-6f);
    }
    EXPECT_EQ(one.scene.GetStatistics().surfacesBuilt, 1u);
    EXPECT_EQ(one.scene.GetStatistics().topLevelsBuilt, 1u);
}

TEST(Mesh, WrongColorIsSaidOnceAndShownGrey) {
    OneMesh one(Cube());
    one.mesh->SetPrimvar("displayColor",
                         Primvar3(Interpolation::Uniform, std::vector<Vec3f>(5, {1, 0, 0})));
    EXPECT_TRUE(Says(one.BuildLine(), "displayColor"));
    one.ExpectSilent();
    EXPECT_EQ(one.Shown(), 1u);
    EXPECT_EQ(one.Color(), kDefaultDisplayColor);
    // It belonged to a topology that comes later.
    Cage five = Cube();
    five.mesh.faceVertexCounts.pop_back();
    five.mesh.faceVertexIndices.resize(20);
    one.mesh->SetTopology(five.mesh);
    one.ExpectSilent();
    EXPECT_EQ(one.Color(), (Vec3f{1, 0, 0}));
}

TEST(Mesh, AnEditedPrimvarIsBuiltAlone) {
    OneMesh one(Cube());
    const Primvar color = Primvar3(Interpolation::Vertex, Cube().points);
    const Primvar st{Interpolation::FaceVarying, 2, std::vector<float>(48, 0.5f), {}};
    one.mesh->SetPrimvar("displayColor", color);
    one.mesh->SetPrimvar("st", st);
    one.ExpectSilent();
    EXPECT_EQ(one.scene.GetStatistics().primvarsBuilt, 2u);
    one.mesh->SetPrimvar("displayColor", color);
    one.mesh->SetPrimvar("st", st);
    one.ExpectSilent();
    EXPECT_EQ(one.scene.GetStatistics().primvarsBuilt, 2u);
    one.mesh->SetPrimvar("displayColor", Primvar3(Interpolation::Constant, {{1, 0, 0}}));
    one.mesh->SetPrimvar("st", st);
    one.mesh->SetPoints(Cube().points);
    one.ExpectSilent();
    EXPECT_EQ(one.scene.GetStatistics().primvarsBuilt, 3u);
    EXPECT_EQ(one.Color(), (Vec3f{1, 0, 0}));
    one.mesh->SetTopology(Cube().mesh);
    one.ExpectSilent();
    EXPECT_EQ(one.scene.GetStatistics().primvarsBuilt, 5u);
    one.mesh->SetPrimvar("st", {});
    one.mesh->SetPrimvar("displayColor", {});
    one.ExpectSilent();
    EXPECT_EQ(one.mesh->FindPrimvar("st"), nullptr);
    EXPECT_EQ(one.Color(), kDefaultDisplayColor);
}

TEST(Mesh, ColorsHaveThreeNumbers) {
    OneMesh one(Cube());
    one.mesh->SetPrimvar("displayColor", {Interpolation::Constant, 2, {1, 0}, {}});
    EXPECT_TRUE(Says(one.BuildLine(), "displayColor has 2 numbers"));
    EXPECT_EQ(one.Color(), kDefaultDisplayColor);
}

TEST(Mesh, WaitsForItsPoints) {
    OneMesh one(Cube());
    one.mesh->SetPoints({});
    EXPECT_TRUE(Says(one.BuildLine(), "no points"));
    one.ExpectSilent();
    EXPECT_EQ(one.mesh->BuiltSurface(), nullptr);
    EXPECT_EQ(one.Shown(), 0u);
    one.mesh->SetPoints(Cube().points);
    one.ExpectSilent();
    EXPECT_EQ(one.Shown(), 1u);
}

TEST(Mesh, AnEmptyMeshIsNoError) {
    OneMesh one(Cage{});
    one.ExpectSilent();
    EXPECT_EQ(one.mesh->BuiltSurface(), nullptr);
}

TEST(Mesh, BadPointsLeaveItOutUntilGoodOnesCome) {
    for (const bool wasShown : {false, true}) {
        for (const float bad : {NAN, INFINITY, -INFINITY, 2e18f}) {
            Cage cage = Cube();
            OneMesh one(cage);
            if (wasShown) {
                one.ExpectSilent();
            }
            cage.points[5].y = bad;
            one.mesh->SetPoints(cage.points);
            EXPECT_TRUE(Says(one.BuildLine(), "point 5"));
            EXPECT_EQ(one.Shown(), 0u);
            one.ExpectSilent();
            one.mesh->SetPoints(Cube().points);
            one.ExpectSilent();
            EXPECT_EQ(one.Shown(), 1u);
        }
    }
}

TEST(Mesh, TheNumberOfPointsMayChange) {
    Cage cage = Cube();
    OneMesh one(cage);
    one.ExpectSilent();
    const Box3f bounds = one.mesh->BuiltSurface()->Bounds();
    cage.points.push_back({100, 100, 100});
    one.mesh->SetPoints(cage.points);
    one.ExpectSilent();
    EXPECT_EQ(one.mesh->BuiltSurface()->Bounds().upper, bounds.upper);
    cage.points.resize(7);
    one.mesh->SetPoints(cage.points);
    EXPECT_TRUE(Says(one.BuildLine(), "7 points"));
    EXPECT_EQ(one.Shown(), 0u);
    one.mesh->SetPoints(Cube().points);
    one.ExpectSilent();
    EXPECT_EQ(one.Shown(), 1u);
}

TEST(Mesh, BadTopologyLeavesItOutUntilGoodOneComes) {
    OneMesh one(Cube());
    one.ExpectSilent();
    ControlMesh bad = Cube().mesh;
    bad.faceVertexIndices[3] = 8;
    one.mesh->SetTopology(bad);
    one.BuildLine();
    EXPECT_EQ(one.Shown(), 0u);
    one.ExpectSilent();
    one.mesh->SetTransform(Placed(1, 2, 3, 4));
    one.ExpectSilent();
    one.mesh->SetTopology(Cube().mesh);
    one.ExpectSilent();
    EXPECT_EQ(one.Shown(), 1u);
}

TEST(Mesh, BadTransformsLeaveItOutUntilGoodOnesCome) {
    for (const AffineTransform& bad :
         {Placed(0, 0, 0, 0), Placed(NAN, 0, 0, 0), Placed(1, 0, INFINITY, 0),
          Placed(1e-30, 0, 0, 0), Placed(1, 3e18, 0, 0), Placed(9e17, 5e17, 0, 0)}) {
        OneMesh one(Cube());
        one.mesh->SetTransform(bad);
        one.BuildLine();
        one.ExpectSilent();
        EXPECT_EQ(one.Shown(), 0u);
        one.mesh->SetTransform(Placed(1, 0, 0, 0));
        one.ExpectSilent();
        EXPECT_EQ(one.Shown(), 1u);
        EXPECT_EQ(one.scene.GetStatistics().surfacesBuilt, 1u);
    }
}

TEST(Mesh, MemoryFollowsTheCage) {
    OneMesh one(Sheet(40));
    one.ExpectSilent();
    const Scene::Statistics statistics = one.scene.GetStatistics();
    EXPECT_EQ(statistics.faces, 1600u);
    EXPECT_LT(statistics.bytes / statistics.faces, 500u);
}

}  // namespace
}  // namespace cc::test
