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
        const float tolerance = 1e-5f * box.Diagonal();
        for (int i = 0; i < 8; ++i) {
            const float u = unit(random), v = unit(random);
            const FaceParameter at = patches.ToFace(patch, u, v);
            const LimitOracle::Sample expected = oracle.Evaluate(at);
            ASSERT_TRUE(expected.exists);
            const LimitPoint actual = EvaluateLimit(patches, patch, points.data(), u, v);
            EXPECT_LT(Length(actual.position - expected.position), tolerance)
                << "patch " << patch << " of face " << at.face << " depth "
                << int(patches.At(patch).depth) << " at " << at.u << " " << at.v;
            const float sign = cage.mesh.leftHanded ? -1 : 1;
            EXPECT_GT(Dot(actual.normal, expected.normal) * sign, 0.99999f)
                << "patch " << patch << " of face " << at.face << " at " << at.u << " " << at.v;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Catalogue, LimitPointTest, testing::ValuesIn(Catalogue()), TestName);

/// Position and normal must run on into the corners, where the patches' own limits stand in.
void ExpectContinuousCorners(const Cage& cage, PatchKind kind, int expectedCount) {
    std::string error;
    const PatchTable patches = BuildPatchTable(cage.mesh, cage.points.size(), &error);
    const std::vector<Vec3f> points = patches.PatchPoints(cage.points);
    int count = 0;
    for (uint32_t patch = 0; patch < patches.Count(); ++patch) {
        if (patches.At(patch).kind != kind) {
            continue;
        }
        ++count;
        for (int corner = 0; corner < 4; ++corner) {
            const float u = corner == 1 || corner == 2 ? 1 : 0, v = corner >= 2 ? 1 : 0;
            const float nearU = std::abs(u - 1e-4f), nearV = std::abs(v - 1e-4f);
            const LimitPoint at = EvaluateLimit(patches, patch, points.data(), u, v);
            const LimitPoint near = EvaluateLimit(patches, patch, points.data(), nearU, nearV);
            EXPECT_LT(Length(at.position - near.position), 1e-3f) << cage.name;
            EXPECT_GT(Dot(at.normal, near.normal), 0.9999f) << cage.name << " corner " << corner;
        }
    }
    EXPECT_EQ(count, expectedCount) << cage.name;
}

TEST(LimitPoint, IsContinuousIntoExtraordinaryVertices) {
    // The outer quads of a fan have a vertex of valence 3 each, the inner ones another in the
    // centre.
    ExpectContinuousCorners(Fan(5), PatchKind::Extraordinary, 10);
    ExpectContinuousCorners(Fan(5), PatchKind::Irregular, 5);
    ExpectContinuousCorners(Fan(3), PatchKind::Irregular, 3);
    ExpectContinuousCorners(Cube(), PatchKind::Irregular, 6);
}

}  // namespace
}  // namespace cc::test
