#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>
#include "core/subdiv/faceVaryingChannel.h"
#include "core/subdiv/faceVaryingMesh.h"
#include "core/subdiv/patchBuilder.h"
#include "tests/unit/subdiv/primvarOracle.h"
#include "tests/unit/subdiv/testCages.h"

namespace cc::test {
namespace {

constexpr FaceVaryingRule kRules[] = {FaceVaryingRule::None,         FaceVaryingRule::CornersOnly,
                                      FaceVaryingRule::CornersPlus1, FaceVaryingRule::CornersPlus2,
                                      FaceVaryingRule::Boundaries,   FaceVaryingRule::All};

/// A way to give face-vertices their values.
struct Split {
    const char* name;
    /// The value's group at a vertex, given its face and a coin.
    int (*group)(int face, int faceVertex, int coin);
};

constexpr Split kSplits[] = {
    {"whole", [](int, int, int) { return 0; }},
    {"stripes", [](int face, int, int) { return face % 2; }},
    {"halves", [](int face, int, int) { return static_cast<int>(face > 2); }},
    {"thirds", [](int face, int, int) { return face % 3; }},
    {"one corner", [](int, int faceVertex, int) { return static_cast<int>(faceVertex == 5); }},
    {"coins", [](int, int, int coin) { return static_cast<int>(coin % 4 == 0); }},
    {"islands", [](int face, int, int) { return face; }},
};

std::vector<int> ValueIndices(const ControlMesh& mesh, size_t pointCount, const Split& split) {
    std::vector<int> indices;
    std::mt19937 random(5);
    for (int face = 0, at = 0; face < mesh.FaceCount(); ++face) {
        for (int i = 0; i < mesh.faceVertexCounts[face]; ++i, ++at) {
            const int group = split.group(face, at, static_cast<int>(random() & 255));
            indices.push_back(mesh.faceVertexIndices[at] + group * static_cast<int>(pointCount));
        }
    }
    return indices;
}

/// Values of two numbers in 0..1.
std::vector<float> RandomValues(size_t count) {
    std::mt19937 random(11);
    std::uniform_real_distribution<float> unit(0, 1);
    std::vector<float> values(2 * count);
    std::generate(values.begin(), values.end(), [&] { return unit(random); });
    return values;
}

class FaceVaryingTest : public testing::TestWithParam<Cage> {};

void ExpectAgreement(const Cage& cage, const PatchTable& patches, const Split& split) {
    Primvar primvar{Interpolation::FaceVarying, 2, {}, {}};
    primvar.indices = ValueIndices(cage.mesh, cage.points.size(), split);
    primvar.values =
        RandomValues(cage.points.size() * static_cast<size_t>(cage.mesh.FaceCount() + 2));
    PrimvarOracle oracle(cage.mesh, cage.points.size(), primvar);
    std::string warning;
    const FaceVaryingChannel channel(cage.mesh, cage.points.size(), 2, primvar.values,
                                     primvar.indices, &warning);
    if (!warning.empty()) {
        return;  // said to be approximate
    }
    std::mt19937 random(7);
    std::uniform_real_distribution<float> unit(0.01f, 0.99f);
    float worst = 0;
    FaceParameter worstAt{};
    for (uint32_t patch = 0; patch < patches.Count(); ++patch) {
        for (int i = 0; i < 4; ++i) {
            const float u = unit(random), v = unit(random);
            const FaceParameter at =
                patches.ToFace(patch, u, patches.IsTriangle(patch) ? (1 - u) * v : v);
            SurfaceValue expected;
            ASSERT_TRUE(oracle.Evaluate(at, &expected));
            const SurfaceValue value = channel.Evaluate(at);
            const float difference =
                std::hypot(value.value[0] - expected.value[0], value.value[1] - expected.value[1]);
            if (!(difference <= worst)) {
                worst = difference;
                worstAt = at;
            }
        }
    }
    EXPECT_LT(worst, 1e-5f) << split.name << ", rule " << int(cage.mesh.faceVaryingRule)
                            << ", face " << worstAt.face << " at " << worstAt.u << " " << worstAt.v;
}

TEST_P(FaceVaryingTest, AgreesWithOpenSubdiv) {
    Cage cage = GetParam();
    ASSERT_TRUE(ValidateControlMesh(&cage.mesh, cage.points.size()).IsValid());
    std::string error;
    const PatchTable patches = BuildPatchTable(cage.mesh, cage.points.size(), &error);
    for (FaceVaryingRule rule : kRules) {
        cage.mesh.faceVaryingRule = rule;
        for (const Split& split : kSplits) {
            if (rule != FaceVaryingRule::All) {
                ExpectAgreement(cage, patches, split);
            }
        }
    }
}

TEST(FaceVarying, NeedsNoPatchesWhereItIsBilinear) {
    ControlMesh mesh = Cube().mesh;
    for (FaceVaryingRule rule : kRules) {
        mesh.faceVaryingRule = rule;
        EXPECT_EQ(IsFaceVaryingBilinear(mesh, true), rule == FaceVaryingRule::All);
        EXPECT_EQ(IsFaceVaryingBilinear(mesh, false), rule != FaceVaryingRule::None);
    }
    mesh.scheme = Scheme::Bilinear;
    EXPECT_TRUE(IsFaceVaryingBilinear(mesh, true));
    // Each triangle is a smooth surface between its sharp corners.
    EXPECT_FALSE(IsFaceVaryingBilinear(Tetrahedron().mesh, false));
}

TEST(FaceVarying, ValuesAreTakenAtTheirVertices) {
    // One value for all points of the cage is the same everywhere, and not one vertex.
    const Cage cage = Cube();
    std::string warning;
    const FaceVaryingChannel channel(cage.mesh, cage.points.size(), 4, {3, 4, 5, 6},
                                     std::vector<int>(24, 0), &warning);
    EXPECT_EQ(warning, "");
    for (uint32_t face = 0; face < 6; ++face) {
        const SurfaceValue value = channel.Evaluate({face, 0, 0.3f, 1});
        for (int i = 0; i < 4; ++i) {
            EXPECT_NEAR(value.value[i], 3 + i, 1e-5f);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Catalogue, FaceVaryingTest, testing::ValuesIn(Catalogue()), TestName);

}  // namespace
}  // namespace cc::test
