#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <utility>

#include <gtest/gtest.h>

#include "core/subdiv/faceVaryingChannel.h"
#include "core/subdiv/faceVaryingMesh.h"
#include "core/subdiv/patchBuilder.h"
#include "tests/repeats.h"
#include "tests/unit/subdiv/cageKit.h"
#include "tests/unit/subdiv/faceVaryingOracle.h"
#include "tests/unit/subdiv/generatedCage.h"
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

/// How far apart two opinions are at worst, and where.
struct Difference {
    double worst = 0;
    FaceParameter at{};

    void Note(const SurfaceValue& value, double x, double y, const FaceParameter& where) {
        const double distance = std::hypot(value.value[0] - x, value.value[1] - y);
        if (!(distance <= worst)) {
            worst = distance;
            at = where;
        }
    }
};

/// A few places on each patch.
std::vector<FaceParameter> Places(const PatchTable& patches) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> unit(0.01f, 0.99f);
    std::vector<FaceParameter> places;
    for (uint32_t patch = 0; patch < patches.Count(); ++patch) {
        for (int i = 0; i < Repeats(4); ++i) {
            const float u = unit(random), v = unit(random);
            places.push_back(patches.ToFace(patch, u, patches.IsTriangle(patch) ? (1 - u) * v : v));
        }
    }
    return places;
}

Difference FromBfr(const Cage& cage, const PatchTable& patches, const Primvar& primvar,
                   const FaceVaryingChannel& channel) {
    PrimvarOracle oracle(cage.mesh, cage.points.size(), primvar);
    Difference difference;
    for (const FaceParameter& at : Places(patches)) {
        SurfaceValue expected;
        EXPECT_TRUE(oracle.Evaluate(at, &expected));
        difference.Note(channel.Evaluate(at), expected.value[0], expected.value[1], at);
    }
    return difference;
}

Difference FromFar(const Cage& cage, const PatchTable& patches, const Primvar& primvar,
                   const FaceVaryingChannel& channel) {
    const FaceVaryingOracle oracle(cage.mesh, cage.points.size(), primvar);
    Difference difference;
    for (const FaceParameter& at : Places(patches)) {
        SurfaceValue expected;
        EXPECT_TRUE(oracle.Evaluate(at, &expected));
        difference.Note(channel.Evaluate(at), expected.value[0], expected.value[1], at);
    }
    return difference;
}

Primvar RandomPrimvar(const Cage& cage, const Split& split) {
    Primvar primvar{Interpolation::FaceVarying, 2, {}, {}};
    primvar.indices = ValueIndices(cage.mesh, cage.points.size(), split);
    primvar.values =
        RandomValues(cage.points.size() * static_cast<size_t>(cage.mesh.FaceCount() + 2));
    return primvar;
}

/// Far has the last word: its values are those that refinement of the mesh comes to. Bfr, which
/// looks at the faces around one only, has others in places: at edges of three faces, at ends of
/// seams amid creases, and beside creases that follow Chaikin's rule.
void ExpectAgreement(const Cage& cage, const PatchTable& patches, const Split& split) {
    const Primvar primvar = RandomPrimvar(cage, split);
    std::string warning;
    const FaceVaryingChannel channel(cage.mesh, cage.points.size(), 2, primvar.values,
                                     primvar.indices, &warning);
    Difference difference = FromBfr(cage, patches, primvar, channel);
    if (difference.worst >= 1e-5) {
        difference = FromFar(cage, patches, primvar, channel);
    }
    EXPECT_EQ(warning, "");
    EXPECT_LT(difference.worst, 1e-5)
        << split.name << ", rule " << int(cage.mesh.faceVaryingRule) << ", face "
        << difference.at.face << " at " << difference.at.u << " " << difference.at.v;
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

/// Why face-varying values on a cage are not Far's, under a rule and a split that differ from cage
/// to cage; empty if they are.
std::string DifferenceFromFar(Cage cage) {
    std::string error;
    ValidateControlMesh(&cage.mesh, cage.points.size());
    const PatchTable patches = BuildPatchTable(cage.mesh, cage.points.size(), &error);
    const size_t kind = cage.points.size() + cage.mesh.faceVertexCounts.size();
    cage.mesh.faceVaryingRule = kRules[kind % 5];
    const Split& split = kSplits[cage.points.size() % std::size(kSplits)];
    const Primvar primvar = RandomPrimvar(cage, split);
    const FaceVaryingChannel channel(cage.mesh, cage.points.size(), 2, primvar.values,
                                     primvar.indices, &error);
    const Difference difference = FromFar(cage, patches, primvar, channel);
    if (!error.empty() || difference.worst >= 1e-5) {
        return error + "off by " + std::to_string(difference.worst) + " with " + split.name +
               ", rule " + std::to_string(kind % 5) + ", on face " +
               std::to_string(difference.at.face);
    }
    return {};
}

TEST(FaceVarying, AgreesWithRefinementOnGeneratedCages) {
    ExpectForGeneratedCages("face-varying values are OpenSubdiv's", DifferenceFromFar);
}

TEST(FaceVarying, AgreesWithRefinementOnGeneratedCagesUnderLoop) {
    ExpectForGeneratedCages("face-varying values under Loop's scheme are OpenSubdiv's",
                            [](const Cage& cage) { return DifferenceFromFar(Triangulated(cage)); });
}

/// True if an edge has more than two faces.
bool HasJoints(const ControlMesh& mesh) {
    std::map<std::pair<int, int>, int> faceCounts;
    const int* face = mesh.faceVertexIndices.data();
    for (int count : mesh.faceVertexCounts) {
        for (int i = 0; i < count; ++i) {
            ++faceCounts[std::minmax({face[i], face[(i + 1) % count]})];
        }
        face += count;
    }
    return std::any_of(faceCounts.begin(), faceCounts.end(),
                       [](const auto& edge) { return edge.second > 2; });
}

/// Values that do not split are those of vertices: Far refines them so, and so does our channel.
/// But Bfr, whose surface of vertices is the same as ours there, takes the faces at an edge of
/// three for parts that have nothing to do with each other.
TEST(FaceVarying, AgreesWithRefinementWhereBfrContradictsIt) {
    int count = 0;
    for (Cage cage : Catalogue()) {
        if (!HasJoints(cage.mesh) || cage.name.find("wings") == std::string::npos) {
            continue;
        }
        ++count;
        ASSERT_TRUE(ValidateControlMesh(&cage.mesh, cage.points.size()).IsValid());
        const Primvar primvar{Interpolation::FaceVarying, 2, RandomValues(cage.points.size()),
                              cage.mesh.faceVertexIndices};
        std::string warning, error;
        const FaceVaryingChannel channel(cage.mesh, cage.points.size(), 2, primvar.values,
                                         primvar.indices, &warning);
        const PatchTable patches = BuildPatchTable(cage.mesh, cage.points.size(), &error);
        EXPECT_LT(FromFar(cage, patches, primvar, channel).worst, 1e-5) << cage.name;
        const PatchValues vertexValues(patches, 2, primvar.values);
        Difference fromVertices;
        for (uint32_t patch = 0; patch < patches.Count(); ++patch) {
            const SurfaceValue value = vertexValues.Evaluate(patches, patch, 0.3f, 0.4f);
            const FaceParameter at = patches.ToFace(patch, 0.3f, 0.4f);
            fromVertices.Note(channel.Evaluate(at), value.value[0], value.value[1], at);
        }
        // Other boundary rules leave corners round that the face-varying rule makes sharp.
        if (cage.mesh.boundaryRule == BoundaryRule::EdgeAndCorner) {
            EXPECT_LT(fromVertices.worst, 1e-6) << cage.name;
        }
        if (cage.name == "three wings") {
            EXPECT_GT(FromBfr(cage, patches, primvar, channel).worst, 0.01);
        }
    }
    EXPECT_GE(count, 3);
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

INSTANTIATE_TEST_SUITE_P(Catalogue, FaceVaryingTest, testing::ValuesIn(Sample(Catalogue())),
                         TestName);

}  // namespace
}  // namespace cc::test
