#include "core/bvh/lookAheadBounds.h"

#include <string>

#include <gtest/gtest.h>

#include "core/subdiv/irregularTriangle.h"
#include "core/subdiv/limitPoint.h"
#include "core/subdiv/patchBuilder.h"
#include "core/trace/simdTargets.h"
#include "tests/repeats.h"
#include "tests/unit/subdiv/testCages.h"

namespace cc::test {
namespace {

struct BuiltCage {
    /// @param by  moves the cage
    explicit BuiltCage(Cage cage, const Vec3f& by = {}) {
        ValidateControlMesh(&cage.mesh, cage.points.size());
        std::string error;
        for (Vec3f& p : cage.points) {
            p += by;
        }
        patches = BuildPatchTable(cage.mesh, cage.points.size(), &error);
        points = patches.PatchPoints(cage.points);
        plans = LimitGridPlans(patches);
    }

    std::vector<Box3f> Bounds() const { return LookAheadBounds(patches, plans, points.data()); }
    std::vector<Box3f> BoundsWithoutPlans() const {
        return LookAheadBounds(patches, LimitGridPlans(), points.data());
    }

    /// Box of points of a patch's surface, its corners among them.
    Box3f SurfaceBox(uint32_t patch) const {
        Box3f box;
        for (int i = 0; i < 289; i += 289 / Repeats(289)) {
            if (!patches.IsTriangle(patch) || i % 17 + i / 17 <= 16) {
                box.Extend(EvaluateLimitValue(patches, patch, points.data(), (i % 17) / 16.0f,
                                              (i / 17) / 16.0f));
            }
        }
        return box;
    }

    /// Box of the points that shape a patch.
    Box3f RingBox(uint32_t patch) const {
        if (patches.At(patch).kind == PatchKind::IrregularTriangle) {
            return GatherIrregularTriangle(patches, patch, points.data()).HullBox();
        }
        ControlPoints indices;
        GatherControlPoints(patches, patch, &indices);
        Box3f box;
        for (const uint32_t index : indices) {
            box.Extend(points[index]);
        }
        return box;
    }

    PatchTable patches;
    std::vector<Vec3f> points;
    LimitGridPlans plans;
};

bool Holds(const Box3f& outer, const Box3f& inner) {
    Box3f both = outer;
    both.Extend(inner);
    return both.lower == outer.lower && both.upper == outer.upper;
}

class LookAheadBoundsTest : public testing::TestWithParam<Cage> {
  protected:
    void TearDown() override { EXPECT_TRUE(UseSimdTarget("").empty()); }
};

TEST_P(LookAheadBoundsTest, HoldTheSurface) {
    for (const Vec3f& by : {Vec3f{}, Vec3f{1000, -300, 20}}) {
        const BuiltCage built(GetParam(), by);
        std::vector<Box3f> surface;
        for (uint32_t patch = 0; patch < built.patches.Count(); ++patch) {
            surface.push_back(built.SurfaceBox(patch));
        }
        const auto expectHeld = [&](const std::vector<Box3f>& bounds, const std::string& how) {
            for (size_t patch = 0; patch < surface.size(); ++patch) {
                EXPECT_TRUE(Holds(bounds[patch], surface[patch])) << how << ", patch " << patch;
            }
        };
        for (const std::string& target : SimdTargets()) {
            ASSERT_EQ(UseSimdTarget(target), "");
            expectHeld(built.Bounds(), target);
        }
        expectHeld(built.BoundsWithoutPlans(), "without plans");
    }
}

TEST_P(LookAheadBoundsTest, AreTighterThanRings) {
    const BuiltCage built(GetParam());
    const std::vector<Box3f> bounds = built.Bounds();
    for (uint32_t patch = 0; patch < built.patches.Count(); ++patch) {
        const PatchKind kind = built.patches.At(patch).kind;
        const float ring = built.RingBox(patch).Diagonal();
        if (kind == PatchKind::Regular || kind == PatchKind::RegularTriangle) {
            EXPECT_LT(bounds[patch].Diagonal(), 0.75f * ring) << "patch " << patch;
        } else if (kind == PatchKind::Extraordinary) {
            EXPECT_LT(bounds[patch].Diagonal(), 0.9f * ring) << "patch " << patch;
        }
    }
}

TEST_P(LookAheadBoundsTest, AreTheSameWithAndWithoutPlans) {
    const BuiltCage built(GetParam());
    const std::vector<Box3f> planned = built.Bounds(), stepped = built.BoundsWithoutPlans();
    for (uint32_t patch = 0; patch < built.patches.Count(); ++patch) {
        const float bound = 1e-5f * built.RingBox(patch).Diagonal();
        EXPECT_LT(Length(planned[patch].lower - stepped[patch].lower), bound) << "patch " << patch;
        EXPECT_LT(Length(planned[patch].upper - stepped[patch].upper), bound) << "patch " << patch;
    }
}

INSTANTIATE_TEST_SUITE_P(Catalogue, LookAheadBoundsTest, testing::ValuesIn(Sample(AllCages())),
                         TestName);

/// Regular patches are bounded many at a time: none may take another's box.
TEST(LookAheadBounds, DependOnTheirPatchAlone) {
    const BuiltCage built(Torus(40, 25));
    const std::vector<Box3f> bounds = built.Bounds();
    for (uint32_t patch = 0; patch < built.patches.Count(); ++patch) {
        EXPECT_TRUE(Holds(bounds[patch], built.SurfaceBox(patch))) << "patch " << patch;
        EXPECT_LT(bounds[patch].Diagonal(), 0.75f * built.RingBox(patch).Diagonal());
    }
}

}  // namespace
}  // namespace cc::test
