#include <cmath>

#include <gtest/gtest.h>

#include "core/subdiv/bezierTriangle.h"
#include "core/subdiv/limitPoint.h"
#include "core/subdiv/patchBuilder.h"
#include "tests/unit/subdiv/testCages.h"

namespace cc::test {
namespace {

struct LoopPatches {
    explicit LoopPatches(const Cage& cage) {
        std::string error;
        patches = BuildPatchTable(cage.mesh, cage.points.size(), &error);
        EXPECT_EQ(error, "") << cage.name;
        points = patches.PatchPoints(cage.points);
    }

    int CountOf(PatchKind kind) const {
        int count = 0;
        for (uint32_t patch = 0; patch < patches.Count(); ++patch) {
            count += patches.At(patch).kind == kind;
        }
        return count;
    }

    PatchTable patches;
    std::vector<Vec3f> points;
};

TEST(LoopPatch, EveryFaceIsOnePatchOfTheCage) {
    const struct {
        Cage cage;
        int regular, irregular;
    } cases[] = {{TriangleTorus(8, 6), 96, 0},
                 // All but the two corners of two faces, where a B-spline boundary has one too few.
                 {TriangleSheet(4), 28, 4},
                 {LoopIcosahedron(), 0, 20},
                 // The centre's ten faces, and twenty along a boundary whose vertices have four or
                 // three.
                 {TriangleFan(10), 0, 30}};
    for (const auto& c : cases) {
        const LoopPatches loop(c.cage);
        EXPECT_EQ(loop.patches.Count(), c.cage.mesh.faceVertexCounts.size()) << c.cage.name;
        EXPECT_EQ(loop.CountOf(PatchKind::RegularTriangle), c.regular) << c.cage.name;
        EXPECT_EQ(loop.CountOf(PatchKind::IrregularTriangle), c.irregular) << c.cage.name;
        EXPECT_EQ(loop.patches.MaxDepth(), 0);
    }
    const LoopPatches closed(TriangleTorus(8, 6));
    EXPECT_EQ(closed.patches.PointCount(), 48u) << "no point but the cage's";
}

TEST(LoopPatch, ParametersAreThoseOfTheAuthoredFace) {
    const LoopPatches loop(TriangleSheet(4));
    for (uint32_t patch = 0; patch < loop.patches.Count(); ++patch) {
        ASSERT_TRUE(loop.patches.IsTriangle(patch));
        const FaceParameter at = loop.patches.ToFace(patch, 0.25f, 0.5f);
        EXPECT_EQ(at.face, loop.patches.AuthoredFace(patch));
        EXPECT_EQ(at.corner, 0u);
        EXPECT_EQ(at.u, 0.25f);
        EXPECT_EQ(at.v, 0.5f);
        EXPECT_TRUE(at.isTriangle);
    }
}

TEST(LoopPatch, TangentsAreTheDerivatives) {
    for (const Cage& cage : {TriangleTorus(8, 6), LoopIcosahedron(), TriangleFan(9)}) {
        const LoopPatches loop(cage);
        const auto at = [&](uint32_t patch, float u, float v) {
            return EvaluateLimit(loop.patches, patch, loop.points.data(), u, v);
        };
        constexpr float kStep = 1 / 256.0f;
        for (uint32_t patch = 0; patch < loop.patches.Count(); ++patch) {
            for (const Vec2f& p : {Vec2f{0.3f, 0.3f}, Vec2f{0.1f, 0.7f}, Vec2f{0.75f, 0.15f}}) {
                const LimitPoint point = at(patch, p.x, p.y);
                const Vec3f du =
                    (at(patch, p.x + kStep, p.y).position - at(patch, p.x - kStep, p.y).position) *
                    (0.5f / kStep);
                const Vec3f dv =
                    (at(patch, p.x, p.y + kStep).position - at(patch, p.x, p.y - kStep).position) *
                    (0.5f / kStep);
                EXPECT_LT(Length(point.du - du), 2e-3f) << cage.name << " patch " << patch;
                EXPECT_LT(Length(point.dv - dv), 2e-3f) << cage.name << " patch " << patch;
            }
        }
    }
}

TEST(LoopPatch, IsContinuousIntoItsCorners) {
    for (const Cage& cage : {LoopIcosahedron(), TriangleFan(3), TriangleFan(12), LoopOctahedron(),
                             OpenTriangleFan(7)}) {
        const LoopPatches loop(cage);
        for (uint32_t patch = 0; patch < loop.patches.Count(); ++patch) {
            for (int corner = 0; corner < 3; ++corner) {
                const auto at = [&](float t) {
                    const float u = corner == 1 ? 1 - 2 * t : t, v = corner == 2 ? 1 - 2 * t : t;
                    return EvaluateLimit(loop.patches, patch, loop.points.data(), u, v);
                };
                EXPECT_LT(Length(at(0).position - at(1e-4f).position), 2e-3f) << cage.name;
                EXPECT_GT(Dot(at(0).normal, at(1e-4f).normal), 0.999f)
                    << cage.name << " patch " << patch << " corner " << corner;
            }
        }
    }
}

TEST(BezierTriangle, PartsMeetTheWhole) {
    BezierTriangle patch;
    for (int i = 0; i < BezierTriangle::kPointCount; ++i) {
        patch.points[i] = {std::sin(1.3f * i), std::cos(2.1f * i), std::sin(0.7f * i * i)};
    }
    const Box3f bounds = patch.SplitBounds();
    for (int i = 0; i < 4; ++i) {
        const SubTriangle at = SubTriangle().Split(i);
        BezierTriangle part;
        for (int j = 0; j < BezierTriangle::kPointCount; ++j) {
            const BezierTriangleWeights weights = SubTriangleWeights(at, j);
            part.points[j] = {};
            for (int k = 0; k < BezierTriangle::kPointCount; ++k) {
                part.points[j] += patch.points[k] * weights[k];
            }
        }
        for (const Vec2f& p : {Vec2f{0, 0}, Vec2f{1, 0}, Vec2f{0, 1}, Vec2f{0.2f, 0.5f}}) {
            const Vec3f expected = patch.Position(at.u + at.size * p.x, at.v + at.size * p.y);
            EXPECT_LT(Length(part.Position(p.x, p.y) - expected), 1e-6f) << i;
            for (int axis = 0; axis < 3; ++axis) {
                EXPECT_LE(bounds.lower[axis], expected[axis]);
                EXPECT_GE(bounds.upper[axis], expected[axis]);
            }
        }
    }
}

}  // namespace
}  // namespace cc::test
