#include "core/subdiv/controlMesh.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "core/subdiv/patchBuilder.h"
#include "tests/unit/subdiv/testCages.h"

namespace cc::test {
namespace {

TEST(ControlMesh, RefusesCountsThatDoNotAddUp) {
    Cage cage = Cube();
    cage.mesh.faceVertexCounts.back() = 5;
    const ControlMeshReport report = ValidateControlMesh(&cage.mesh, cage.points.size());
    EXPECT_FALSE(report.IsValid());
    EXPECT_NE(report.error.find("add up to 25"), std::string::npos) << report.error;
}

TEST(ControlMesh, RefusesNegativeCounts) {
    Cage cage = Cube();
    cage.mesh.faceVertexCounts[2] = -4;
    EXPECT_NE(ValidateControlMesh(&cage.mesh, cage.points.size()).error.find("face 2"),
              std::string::npos);
}

TEST(ControlMesh, RefusesIndicesOutOfRange) {
    for (int bad : {-1, 8, 1 << 30}) {
        Cage cage = Cube();
        cage.mesh.faceVertexIndices[5] = bad;
        const std::string error = ValidateControlMesh(&cage.mesh, cage.points.size()).error;
        EXPECT_NE(error.find("[5] is " + std::to_string(bad)), std::string::npos) << error;
    }
}

TEST(ControlMesh, RefusesLoopFacesThatAreNoTriangles) {
    Cage cage = TriangleSheet(2);
    EXPECT_TRUE(ValidateControlMesh(&cage.mesh, cage.points.size()).IsValid());
    for (const int count : {3, 4, 5}) {
        cage.mesh.faceVertexCounts.push_back(count);
        cage.mesh.faceVertexIndices.insert(cage.mesh.faceVertexIndices.end(), count, 0);
    }
    const ControlMeshReport report = ValidateControlMesh(&cage.mesh, cage.points.size());
    EXPECT_NE(report.error.find("2 of 11 faces are no triangles"), std::string::npos)
        << report.error;
    EXPECT_NE(report.error.find("face 9"), std::string::npos) << report.error;
}

TEST(ControlMesh, LeavesOutLoopFacesOfFewerVertices) {
    Cage cage = TriangleSheet(2);
    cage.mesh.faceVertexCounts.insert(cage.mesh.faceVertexCounts.end(), {2, 3});
    cage.mesh.faceVertexIndices.insert(cage.mesh.faceVertexIndices.end(), {0, 1, 4, 4, 5});
    const ControlMeshReport report = ValidateControlMesh(&cage.mesh, cage.points.size());
    EXPECT_TRUE(report.IsValid()) << report.error;
    ASSERT_EQ(report.warnings.size(), 1u);
    EXPECT_NE(report.warnings[0].find("2 faces"), std::string::npos) << report.warnings[0];
    std::string error;
    EXPECT_EQ(BuildPatchTable(cage.mesh, cage.points.size(), &error).Count(), 8u);
    EXPECT_EQ(error, "");
}

TEST(ControlMesh, RefusesValencesThatTakeTooLong) {
    for (const int valence : {kMaxValence, kMaxValence + 1}) {
        const bool isValid = valence == kMaxValence;
        Cage polygon;
        polygon.points.resize(valence);
        polygon.mesh.faceVertexCounts = {valence};
        for (int i = 0; i < valence; ++i) {
            polygon.mesh.faceVertexIndices.push_back(i);
        }
        Cage fan = Fan(valence);
        EXPECT_EQ(ValidateControlMesh(&polygon.mesh, polygon.points.size()).IsValid(), isValid);
        EXPECT_EQ(ValidateControlMesh(&fan.mesh, fan.points.size()).IsValid(), isValid);
        polygon.mesh.scheme = fan.mesh.scheme = Scheme::None;
        EXPECT_TRUE(ValidateControlMesh(&polygon.mesh, polygon.points.size()).IsValid());
        EXPECT_TRUE(ValidateControlMesh(&fan.mesh, fan.points.size()).IsValid());
    }
    Cage fan = Fan(kMaxValence + 1);
    EXPECT_EQ(ValidateControlMesh(&fan.mesh, fan.points.size()).error,
              "vertex 0 has 16385 faces; the limit is 16384");
    Cage triangles = TriangleFan(kMaxLoopValence + 1);
    EXPECT_EQ(ValidateControlMesh(&triangles.mesh, triangles.points.size()).error,
              "vertex 0 has 4097 faces; the limit is 4096");
}

TEST(ControlMesh, MendsHoles) {
    Cage cage = Cube();
    cage.mesh.holeIndices = {3, 1, 3, -1, 6};
    const ControlMeshReport report = ValidateControlMesh(&cage.mesh, cage.points.size());
    EXPECT_TRUE(report.IsValid());
    EXPECT_EQ(report.warnings.size(), 1u);
    EXPECT_EQ(cage.mesh.holeIndices, (std::vector<int>{1, 3}));
}

TEST(ControlMesh, MendsCreases) {
    Cage cage = Cube();
    cage.mesh.creaseIndices = {0, 1, 5, 0, 3, 99, 4};
    cage.mesh.creaseLengths = {3, 2, 2};
    cage.mesh.creaseSharpnesses = {25, NAN, 2};
    const ControlMeshReport report = ValidateControlMesh(&cage.mesh, cage.points.size());
    EXPECT_TRUE(report.IsValid());
    EXPECT_EQ(report.warnings.size(), 2u) << "two edges that are none, one NaN";
    EXPECT_EQ(cage.mesh.creaseIndices, (std::vector<int>{0, 1, 1, 5}));
    EXPECT_EQ(cage.mesh.creaseSharpnesses, (std::vector<float>{10, 10}));
}

TEST(ControlMesh, TakesSharpnessesByEdge) {
    Cage cage = Cube();
    cage.mesh.creaseIndices = {0, 1, 5, 4};
    cage.mesh.creaseLengths = {4};
    cage.mesh.creaseSharpnesses = {1, 2, 3};
    EXPECT_TRUE(ValidateControlMesh(&cage.mesh, cage.points.size()).warnings.empty());
    EXPECT_EQ(cage.mesh.creaseSharpnesses, (std::vector<float>{1, 2, 3}));
}

TEST(ControlMesh, IgnoresCreasesThatContradictThemselves) {
    for (int length : {1, 0, -3, 9}) {
        Cage cage = Cube();
        cage.mesh.creaseIndices = {0, 1, 5};
        cage.mesh.creaseLengths = {length};
        cage.mesh.creaseSharpnesses = {1};
        const ControlMeshReport report = ValidateControlMesh(&cage.mesh, cage.points.size());
        EXPECT_TRUE(report.IsValid());
        EXPECT_EQ(report.warnings.size(), 1u);
        EXPECT_TRUE(cage.mesh.creaseIndices.empty());
    }
}

TEST(ControlMesh, MendsCorners) {
    Cage cage = Cube();
    cage.mesh.cornerIndices = {0, 8, 3};
    cage.mesh.cornerSharpnesses = {-1, 2, 30};
    const ControlMeshReport report = ValidateControlMesh(&cage.mesh, cage.points.size());
    EXPECT_EQ(report.warnings.size(), 2u);
    EXPECT_EQ(cage.mesh.cornerIndices, (std::vector<int>{3}));
    EXPECT_EQ(cage.mesh.cornerSharpnesses, (std::vector<float>{10}));
}

TEST(ControlMesh, MergesCornersThatShareAVertex) {
    const auto kept = [](const std::vector<int>& face) {
        return KeptCorners(face.data(), static_cast<int>(face.size()));
    };
    EXPECT_EQ(kept({5, 6, 7, 8}), (std::vector<int>{0, 1, 2, 3}));
    EXPECT_EQ(kept({5, 6, 7, 7}), (std::vector<int>{0, 1, 2}));
    EXPECT_EQ(kept({5, 6, 7, 5}), (std::vector<int>{1, 2, 3}));
    EXPECT_TRUE(kept({5, 5, 7, 7}).empty());
    EXPECT_TRUE(kept({5, 6, 5, 7}).empty());
    EXPECT_TRUE(kept({}).empty());
}

TEST(ControlMesh, KnowsFacesThatKeepAllCorners) {
    std::mt19937 random(3);
    int keptAll = 0;
    for (int i = 0; i < 20000; ++i) {
        std::vector<int> face(random() % 12);
        for (int& vertex : face) {
            vertex = static_cast<int>(random() % 40);
        }
        const int count = static_cast<int>(face.size());
        const size_t kept = KeptCorners(face.data(), count).size();
        const bool keepsAll = count > 0 && kept == face.size();
        EXPECT_EQ(KeepsAllCorners(face.data(), count), keepsAll);
        keptAll += keepsAll;
    }
    EXPECT_GT(keptAll, 5000);
}

TEST(PatchBuilder, TakesQuadsWithACollapsedEdgeForTriangles) {
    ControlMesh quad, triangle;
    quad.faceVertexCounts = {4};
    quad.faceVertexIndices = {0, 1, 2, 2};
    triangle.faceVertexCounts = {3};
    triangle.faceVertexIndices = {0, 1, 2};
    EXPECT_EQ(ValidateControlMesh(&quad, 3).warnings.size(), 1u);
    std::string error;
    const PatchTable a = BuildPatchTable(quad, 3, &error), b = BuildPatchTable(triangle, 3, &error);
    const std::vector<Vec3f> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    ASSERT_EQ(a.Count(), 3u);
    ASSERT_EQ(b.Count(), 3u);
    EXPECT_EQ(a.PatchPoints(points), b.PatchPoints(points));
}

TEST(PatchBuilder, SurvivesTopologyNobodyShouldWrite) {
    struct Case {
        std::vector<int> counts, indices;
    };
    const Case cases[] = {
        {{4}, {0, 0, 0, 0}},                                // one point
        {{4, 4}, {0, 1, 2, 2, 2, 2, 3, 4}},                 // repeated vertices
        {{4, 4}, {0, 1, 2, 3, 0, 1, 2, 3}},                 // the same face twice
        {{4, 4, 4}, {0, 1, 2, 3, 0, 1, 5, 4, 0, 1, 6, 7}},  // three faces on an edge
        {{4, 4}, {0, 1, 2, 3, 0, 4, 5, 6}},                 // a bow tie
        {{4, 4}, {0, 1, 2, 3, 0, 1, 5, 4}},                 // neighbours that disagree
        {{2, 1, 0, 4}, {0, 1, 0, 0, 1, 2, 3}},              // faces without an inside
        {{3, 3}, {0, 1, 2, 2, 1, 0}},                       // two sides of one triangle
        {{4, 4}, {0, 1, 2, 3, 3, 2, 1, 0}},                 // two sides of one quad
        {{5}, {0, 1, 2, 1, 3}},                             // a face that touches itself
        {{}, {}},
    };
    for (const Case& c : cases) {
        ControlMesh mesh;
        mesh.faceVertexCounts = c.counts;
        mesh.faceVertexIndices = c.indices;
        ASSERT_TRUE(ValidateControlMesh(&mesh, 8).IsValid());
        std::string error;
        const PatchTable patches = BuildPatchTable(mesh, 8, &error);
        const std::vector<Vec3f> points = patches.PatchPoints(Cube().points);
        for (const Vec3f& p : points) {
            EXPECT_TRUE(IsFinite(p));
        }
    }
}

}  // namespace
}  // namespace cc::test
