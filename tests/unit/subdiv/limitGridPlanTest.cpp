#include "core/subdiv/limitGridPlan.h"

#include <gtest/gtest.h>

#include "core/subdiv/limitPoint.h"
#include "core/subdiv/patchBuilder.h"
#include "tests/repeats.h"
#include "tests/unit/subdiv/cageKit.h"
#include "tests/unit/subdiv/testCages.h"

namespace cc::test {
namespace {

struct BuiltCage {
    explicit BuiltCage(Cage cage) : name(cage.name) {
        ValidateControlMesh(&cage.mesh, cage.points.size());
        std::string error;
        patches = BuildPatchTable(cage.mesh, cage.points.size(), &error);
        points = patches.PatchPoints(cage.points);
    }

    std::string name;
    PatchTable patches;
    std::vector<Vec3f> points;
};

/// A point of the finest grid by the patch's plan.
Vec3f PlannedPoint(const BuiltCage& built, uint32_t patch, const LimitGridPlan& plan, int row,
                   int column) {
    ControlPoints indices;
    GatherControlPoints(built.patches, patch, &indices);
    const int at =
        column < kPlanSide ? kPlanSide * row + column : kPlanSide * (kPlanSide + 1) + row;
    Vec3f sum;
    for (size_t i = 0; i < plan.Picks().size(); ++i) {
        sum += built.points[indices[plan.Picks()[i]]] * plan.Weights(i)[at];
    }
    return sum;
}

class LimitGridPlanTest : public testing::TestWithParam<Cage> {};

void ExpectPointsOfTheLimitSurface(const BuiltCage& built) {
    const LimitGridPlans plans(built.patches);
    for (uint32_t patch = 0; patch < built.patches.Count(); ++patch) {
        const LimitGridPlan* plan = plans.Of(patch);
        const PatchKind kind = built.patches.At(patch).kind;
        if (kind != PatchKind::Extraordinary && kind != PatchKind::Irregular) {
            EXPECT_EQ(plan, nullptr);
            continue;
        }
        if (!plan) {
            continue;  // too rare or too large to plan for
        }
        for (const auto& [row, column] : {std::pair{0, 0},
                                          {0, 16},
                                          {16, 16},
                                          {16, 0},
                                          {3, 7},
                                          {8, 8},
                                          {15, 1},
                                          {16, 5},
                                          {11, 16}}) {
            const Vec3f expected = EvaluateLimitValue(built.patches, patch, built.points.data(),
                                                      column / 16.0f, row / 16.0f);
            EXPECT_LT(Length(PlannedPoint(built, patch, *plan, row, column) - expected), 1e-5f)
                << built.name << ", patch " << patch << " at " << column << ", " << row;
        }
    }
}

TEST_P(LimitGridPlanTest, GivesThePointsOfTheLimitSurface) {
    ExpectPointsOfTheLimitSurface(BuiltCage(GetParam()));
}

INSTANTIATE_TEST_SUITE_P(Catalogue, LimitGridPlanTest, testing::ValuesIn(Sample(AllCages())),
                         TestName);

TEST(LimitGridPlans, ShareThePlansOfEqualRings) {
    // All faces around the vertex look alike.
    const BuiltCage built(Fan(5));
    const LimitGridPlans plans(built.patches);
    const BuiltCage again(Fan(5));
    const LimitGridPlans others(again.patches);
    for (uint32_t patch = 0; patch < built.patches.Count(); ++patch) {
        ASSERT_NE(plans.Of(patch), nullptr);
        EXPECT_EQ(plans.Of(patch), others.Of(patch));
    }
}

/// Sheets whose patches beside vertex 24 differ in nothing but what the crease there meets at its
/// other end.
TEST(LimitGridPlans, AreNotSharedWhereChaikinCreasesMeetOthersFurtherOn) {
    Cage cage = WithCrease(Sheet(6), {24, 25}, 1.2f, "sheet, Chaikin crease");
    cage.mesh.creaseRule = CreaseRule::Chaikin;
    const BuiltCage alone(cage);
    const LimitGridPlans plans(alone.patches);
    ExpectPointsOfTheLimitSurface(
        BuiltCage(WithCrease(cage, {25, 26}, 0.1f, "sheet, Chaikin creases that meet")));
}

TEST(LimitGridPlans, LeaveWithTheirLastTable) {
    const size_t before = LimitGridPlans::SharedBytes();
    {
        const BuiltCage built(Fan(11));
        const LimitGridPlans plans(built.patches);
        EXPECT_GT(LimitGridPlans::SharedBytes(), before);
    }
    EXPECT_EQ(LimitGridPlans::SharedBytes(), before);
}

}  // namespace
}  // namespace cc::test
