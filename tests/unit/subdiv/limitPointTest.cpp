#include "core/subdiv/limitPoint.h"

#include <gtest/gtest.h>

#include "core/subdiv/irregularPatch.h"
#include "core/subdiv/irregularTriangle.h"
#include "core/subdiv/oneRing.h"
#include "core/subdiv/patchBuilder.h"
#include "tests/repeats.h"
#include "tests/unit/subdiv/cageKit.h"
#include "tests/unit/subdiv/limitOracle.h"
#include "tests/unit/subdiv/surfaceComparison.h"
#include "tests/unit/subdiv/testCages.h"

namespace cc::test {
namespace {

class LimitPointTest : public testing::TestWithParam<Cage> {};

void ExpectWithinTolerance(const SurfaceDifference& difference) {
    EXPECT_EQ(difference.error, "");
    EXPECT_GT(difference.sampleCount, 0);
    EXPECT_LT(difference.position, kPositionTolerance) << difference.worstPosition;
    EXPECT_LT(difference.primvar, kPositionTolerance) << difference.worstPrimvar;
    EXPECT_LT(difference.normal, kNormalTolerance) << difference.worstNormal;
}

TEST_P(LimitPointTest, AgreesWithBfr) {
    ExpectWithinTolerance(CompareWithOracle(GetParam(), OracleKind::Bfr));
}

TEST_P(LimitPointTest, AgreesWithFar) {
    ExpectWithinTolerance(CompareWithOracle(GetParam(), OracleKind::Far));
}

TEST(LimitPoint, AgreesWithFarWhereBfrContradictsIt) {
    for (const Cage& cage : KnownDifferences()) {
        SCOPED_TRACE(cage.name);
        EXPECT_FALSE(CompareWithOracle(cage, OracleKind::Bfr).IsWithinTolerance());
        ExpectWithinTolerance(CompareWithOracle(cage, OracleKind::Far));
    }
}

/// Around a vertex of too many faces, the innermost sixteenth of each is flat between limit points.
TEST(LimitPoint, IsExactBesideVerticesOfTooManyFaces) {
    constexpr int kValence = kMaxRingFaces + 1;
    const Cage cage = Fan(kValence);
    std::string error;
    const PatchTable patches = BuildPatchTable(cage.mesh, cage.points.size(), &error);
    const std::vector<Vec3f> points = patches.PatchPoints(cage.points);
    const auto oracle = MakeFarOracle(cage.mesh, cage.points, cage.points);
    int flatCount = 0;
    for (uint32_t patch = 0; patch < patches.Count(); ++patch) {
        const bool isFlat = patches.At(patch).kind == PatchKind::Bilinear;
        flatCount += isFlat;
        for (const float u : {0.0f, 0.3f, 1.0f}) {
            for (const float v : {0.0f, 0.7f, 1.0f}) {
                if (isFlat && (u == 0.3f || v == 0.7f)) {
                    continue;
                }
                const LimitOracle::Sample expected = oracle->Evaluate(patches.ToFace(patch, u, v));
                const LimitPoint point = EvaluateLimit(patches, patch, points.data(), u, v);
                EXPECT_LT(Length(point.position - expected.position), 4e-5f)
                    << "patch " << patch << " (" << u << ", " << v << ")";
            }
        }
    }
    EXPECT_EQ(flatCount, kValence);
}

INSTANTIATE_TEST_SUITE_P(Catalogue, LimitPointTest, testing::ValuesIn(Sample(Catalogue())),
                         TestName);

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

/// Calls check(patch, u, v) at the regular corners of patches that are not.
template <typename Check>
void ForEachRegularCorner(const PatchTable& patches, const std::vector<Vec3f>& points,
                          const Check& check) {
    for (uint32_t patch = 0; patch < patches.Count(); ++patch) {
        if (patches.At(patch).kind == PatchKind::Irregular) {
            const IrregularPatch irregular = GatherIrregular(patches, patch, points.data());
            for (int corner = 0; corner < 4; ++corner) {
                if (irregular.rings[corner].IsRegular()) {
                    check(patch, corner == 1 || corner == 2 ? 1.0f : 0.0f,
                          corner >= 2 ? 1.0f : 0.0f);
                }
            }
        } else if (patches.At(patch).kind == PatchKind::IrregularTriangle) {
            const IrregularTriangle irregular =
                GatherIrregularTriangle(patches, patch, points.data());
            for (int corner = 0; corner < 3; ++corner) {
                if (irregular.rings[corner].IsRegular()) {
                    check(patch, corner == 1 ? 1.0f : 0.0f, corner == 2 ? 1.0f : 0.0f);
                }
            }
        }
    }
}

/// Where the parameterization has derivatives, corners must not have mere tangents.
TEST(LimitPoint, DerivativesRunOnIntoRegularCorners) {
    Cage creased = WithCrease(Sheet(4), {6, 7, 8}, 1.5f, "creased sheet");
    for (const Cage& cage : {creased, Triangulated(creased), TriangleFan(5), TriangleFan(9)}) {
        std::string error;
        const PatchTable patches = BuildPatchTable(cage.mesh, cage.points.size(), &error);
        const std::vector<Vec3f> points = patches.PatchPoints(cage.points);
        int count = 0;
        ForEachRegularCorner(patches, points, [&](uint32_t patch, float u, float v) {
            constexpr float kStep = 1e-3f;
            const float inside = patches.IsTriangle(patch) ? 1 / 3.0f : 0.5f;
            const LimitPoint at = EvaluateLimit(patches, patch, points.data(), u, v);
            const LimitPoint near = EvaluateLimit(
                patches, patch, points.data(), u + (inside - u) * kStep, v + (inside - v) * kStep);
            EXPECT_LT(Length(at.du - near.du), 0.01f) << cage.name << " patch " << patch;
            EXPECT_LT(Length(at.dv - near.dv), 0.01f) << cage.name << " patch " << patch;
            ++count;
        });
        EXPECT_GT(count, 0) << cage.name;
    }
}

}  // namespace
}  // namespace cc::test
