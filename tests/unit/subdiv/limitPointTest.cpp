#include "core/subdiv/limitPoint.h"

#include <random>

#include <gtest/gtest.h>

#include "core/math/box.h"
#include "core/subdiv/patchBuilder.h"
#include "tests/unit/subdiv/limitOracle.h"
#include "tests/unit/subdiv/testCages.h"

namespace cc::test {
namespace {

class LimitPointTest : public testing::TestWithParam<Cage> {};

/// A patch whose surface we know only between limit positions: of features isolated to the end.
bool IsApproximate(const PatchTable& patches, uint32_t patch) {
    return patches.At(patch).kind == PatchKind::Bilinear;
}

TEST_P(LimitPointTest, AgreesWithOpenSubdiv) {
    Cage cage = GetParam();
    const LimitOracle oracle(cage.mesh, cage.points);
    ASSERT_TRUE(ValidateControlMesh(&cage.mesh, cage.points.size()).IsValid());
    std::string error;
    const PatchTable patches = BuildPatchTable(cage.mesh, cage.points.size(), &error);
    ASSERT_EQ(error, "");
    ASSERT_GT(patches.Count(), 0u);
    const std::vector<Vec3f> points = patches.PatchPoints(cage.points);
    Box3f box;
    for (const Vec3f& p : cage.points) {
        box.Extend(p);
    }
    std::mt19937 random(7);
    std::uniform_real_distribution<float> unit(0.01f, 0.99f);
    for (uint32_t patch = 0; patch < patches.Count(); ++patch) {
        const float tolerance = (IsApproximate(patches, patch) ? 1e-3f : 1e-5f) * box.Diagonal();
        for (int i = 0; i < 8; ++i) {
            const float u = unit(random), v = unit(random);
            const FaceParameter at = patches.ToFace(patch, u, v);
            const LimitOracle::Sample expected = oracle.Evaluate(at);
            ASSERT_TRUE(expected.exists);
            const LimitPoint actual = EvaluateLimit(patches, patch, points.data(), u, v);
            EXPECT_LT(Length(actual.position - expected.position), tolerance)
                << "patch " << patch << " of face " << at.face << " depth "
                << int(patches.At(patch).depth) << " at " << at.u << " " << at.v;
            if (!IsApproximate(patches, patch)) {
                const float sign = cage.mesh.leftHanded ? -1 : 1;
                EXPECT_GT(Dot(actual.normal, expected.normal) * sign, 0.9999f)
                    << "patch " << patch << " of face " << at.face << " at " << at.u << " "
                    << at.v;
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Catalogue, LimitPointTest, testing::ValuesIn(Catalogue()), TestName);

TEST(LimitPoint, IsTheLimitAtAnExtraordinaryVertex) {
    Cage cage = Fan(5);
    std::string error;
    const PatchTable patches = BuildPatchTable(cage.mesh, cage.points.size(), &error);
    const std::vector<Vec3f> points = patches.PatchPoints(cage.points);
    int found = 0;
    for (uint32_t patch = 0; patch < patches.Count(); ++patch) {
        if (patches.At(patch).kind == PatchKind::Extraordinary) {
            const LimitPoint at = EvaluateLimit(patches, patch, points.data(), 0, 0);
            const LimitPoint near = EvaluateLimit(patches, patch, points.data(), 1e-4f, 1e-4f);
            EXPECT_LT(Length(at.position - near.position), 1e-3f);
            EXPECT_GT(Dot(at.normal, near.normal), 0.9999f);
            ++found;
        }
    }
    // The centre of valence 5, and the vertices of valence 3 around it.
    EXPECT_EQ(found, 5 + 5 * 3);
}

}  // namespace
}  // namespace cc::test
