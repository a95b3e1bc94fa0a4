#include "core/scene/colorField.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/subdiv/limitPoint.h"
#include "core/trace/surface.h"
#include "tests/unit/subdiv/testCages.h"

namespace cc::test {
namespace {

/// A quad and a triangle side by side, in the plane, not smoothed.
Cage QuadAndTriangle() {
    Cage cage;
    cage.name = "quadAndTriangle";
    cage.mesh.scheme = Scheme::Bilinear;
    cage.mesh.faceVertexCounts = {4, 3};
    cage.mesh.faceVertexIndices = {0, 1, 2, 3, 1, 4, 2};
    cage.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}};
    return cage;
}

struct Colored {
    Colored(Cage cage, Primvar3f color)
        : report(ValidateControlMesh(&cage.mesh, cage.points.size())),
          surface(cage.mesh, cage.points),
          faces(cage.mesh.faceVertexCounts, cage.mesh.faceVertexIndices),
          error(CheckColor(color, faces, cage.points.size())),
          field(error.empty() ? ColorField(std::move(color), surface.Patches()) : ColorField()) {}

    Vec3f At(uint32_t patch, float u, float v) const {
        return field.Evaluate(surface.Patches(), faces, patch, u, v);
    }

    ControlMeshReport report;
    Surface surface;
    FaceVertices faces;
    std::string error;
    ColorField field;
};

/// Calls check(patch, u, v) all over a surface.
template <typename Check>
void ForEachParameter(const Surface& surface, const Check& check) {
    for (uint32_t patch = 0; patch < surface.Patches().Count(); ++patch) {
        for (const float u : {0.0f, 0.3f, 0.75f, 1.0f}) {
            for (const float v : {0.0f, 0.4f, 1.0f}) {
                check(patch, u, v);
            }
        }
    }
}

Primvar3f Color(Interpolation interpolation, std::vector<Vec3f> values,
                std::vector<int> indices = {}) {
    return {interpolation, std::move(values), std::move(indices)};
}

TEST(ColorField, IsGreyWithoutValues) {
    const Colored none(Cube(), {});
    EXPECT_EQ(none.error, "");
    EXPECT_EQ(none.At(0, 0.5f, 0.5f), kDefaultDisplayColor);
}

TEST(ColorField, ConstantIsTheSameEverywhere) {
    const Colored red(Cube(), Color(Interpolation::Constant, {{0, 1, 0}, {1, 0, 0}}, {1}));
    ForEachParameter(red.surface, [&](uint32_t patch, float u, float v) {
        EXPECT_EQ(red.At(patch, u, v), (Vec3f{1, 0, 0}));
    });
}

TEST(ColorField, UniformGoesByTheAuthoredFace) {
    const Colored faces(QuadAndTriangle(), Color(Interpolation::Uniform, {{7, 0, 0}, {8, 0, 0}}));
    ForEachParameter(faces.surface, [&](uint32_t patch, float u, float v) {
        EXPECT_EQ(faces.At(patch, u, v).x, 7 + faces.surface.Patches().AuthoredFace(patch));
    });
}

/// What a colour that equals the position is compared with.
Vec3f LimitPosition(const Surface& surface, uint32_t patch, float u, float v) {
    return EvaluateLimitValue(surface.Patches(), patch, surface.PatchPoints().data(), u, v);
}

void ExpectNear(const Vec3f& a, const Vec3f& b) {
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(a[axis], b[axis], 1e-5f);
    }
}

TEST(ColorField, VertexIsRefinedLikeThePoints) {
    for (const Cage& cage : {Cube(), Fan(5), Drum(7), QuadAndTriangle()}) {
        const Colored field(cage, Color(Interpolation::Vertex, cage.points));
        ASSERT_EQ(field.error, "") << cage.name;
        ForEachParameter(field.surface, [&](uint32_t patch, float u, float v) {
            ExpectNear(field.At(patch, u, v), LimitPosition(field.surface, patch, u, v));
        });
    }
}

TEST(ColorField, VertexTakesIndices) {
    const Cage cage = Cube();
    std::vector<Vec3f> reversed(cage.points.rbegin(), cage.points.rend());
    const Colored field(cage, Color(Interpolation::Vertex, reversed, {7, 6, 5, 4, 3, 2, 1, 0}));
    ExpectNear(field.At(0, 0.3f, 0.6f), LimitPosition(field.surface, 0, 0.3f, 0.6f));
}

TEST(ColorField, VaryingIsLinearOnTheCage) {
    // The faces are flat and not smoothed, so that position is bilinear over them.
    const Cage cage = QuadAndTriangle();
    const Colored field(cage, Color(Interpolation::Varying, cage.points));
    ForEachParameter(field.surface, [&](uint32_t patch, float u, float v) {
        ExpectNear(field.At(patch, u, v), LimitPosition(field.surface, patch, u, v));
    });
}

TEST(ColorField, FaceVaryingGoesByTheFacesCorners) {
    const Cage cage = QuadAndTriangle();
    std::vector<Vec3f> corners;
    for (size_t i = 0; i < cage.mesh.faceVertexIndices.size(); ++i) {
        // The triangle is told apart from the quad, though they share points.
        corners.push_back(cage.points[cage.mesh.faceVertexIndices[i]] +
                          Vec3f{0, 0, i < 4 ? 0.0f : 5.0f});
    }
    const Colored field(cage, Color(Interpolation::FaceVarying, corners));
    ForEachParameter(field.surface, [&](uint32_t patch, float u, float v) {
        const bool isTriangle = field.surface.Patches().AuthoredFace(patch) == 1;
        ExpectNear(field.At(patch, u, v), LimitPosition(field.surface, patch, u, v) +
                                              Vec3f{0, 0, isTriangle ? 5.0f : 0.0f});
    });
}

TEST(ColorField, IsLinearOnTrianglesOfTheLoopScheme) {
    const Cage cage = LoopIcosahedron();
    std::vector<Vec3f> corners;
    for (int vertex : cage.mesh.faceVertexIndices) {
        corners.push_back(cage.points[vertex]);
    }
    const Colored varying(cage, Color(Interpolation::Varying, cage.points));
    const Colored faceVarying(cage, Color(Interpolation::FaceVarying, corners));
    const PatchTable& patches = varying.surface.Patches();
    ASSERT_EQ(patches.Count(), 20u);
    for (uint32_t patch = 0; patch < patches.Count(); ++patch) {
        const Vec3f* c = &corners[3 * patches.AuthoredFace(patch)];
        for (const Vec2f& at : {Vec2f{0, 0}, Vec2f{1, 0}, Vec2f{0, 1}, Vec2f{0.3f, 0.5f}}) {
            const Vec3f expected = c[0] * (1 - at.x - at.y) + c[1] * at.x + c[2] * at.y;
            ExpectNear(varying.At(patch, at.x, at.y), expected);
            ExpectNear(faceVarying.At(patch, at.x, at.y), expected);
        }
    }
}

TEST(ColorField, LeftHandedMeshesKeepTheirCorners) {
    Cage cage = QuadAndTriangle();
    cage.mesh.leftHanded = true;
    const Colored field(cage, Color(Interpolation::Varying, cage.points));
    ForEachParameter(field.surface, [&](uint32_t patch, float u, float v) {
        ExpectNear(field.At(patch, u, v), LimitPosition(field.surface, patch, u, v));
    });
}

TEST(ColorField, GivesThePrimvarBack) {
    const Cage cage = Fan(5);
    Colored field(cage, Color(Interpolation::Vertex, cage.points));
    const Primvar3f back = field.field.TakePrimvar(cage.points.size());
    EXPECT_EQ(back.interpolation, Interpolation::Vertex);
    EXPECT_EQ(back.values, cage.points);
    EXPECT_EQ(field.At(0, 0.5f, 0.5f), kDefaultDisplayColor);
}

TEST(CheckColor, FindsWrongElementCounts) {
    const FaceVertices faces({4, 3}, {0, 1, 2, 3, 1, 4, 2});
    const struct {
        Interpolation interpolation;
        size_t count;
    } cases[] = {{Interpolation::Constant, 1},
                 {Interpolation::Uniform, 2},
                 {Interpolation::Varying, 5},
                 {Interpolation::Vertex, 5},
                 {Interpolation::FaceVarying, 7}};
    for (const auto& c : cases) {
        EXPECT_EQ(CheckColor(Color(c.interpolation, std::vector<Vec3f>(c.count)), faces, 5), "");
        for (const size_t wrong : {c.count + 1, c.count + 40}) {
            EXPECT_NE(CheckColor(Color(c.interpolation, std::vector<Vec3f>(wrong)), faces, 5), "");
        }
        // Indices count, if there are any.
        const std::vector<int> indices(c.count, 0);
        EXPECT_EQ(CheckColor(Color(c.interpolation, {{1, 1, 1}}, indices), faces, 5), "");
    }
}

TEST(CheckColor, FindsWrongIndicesAndValues) {
    const FaceVertices faces({4}, {0, 1, 2, 3});
    for (const int index : {-1, 2, std::numeric_limits<int>::max()}) {
        EXPECT_NE(CheckColor(Color(Interpolation::Constant, {{}, {}}, {index}), faces, 4), "");
    }
    EXPECT_NE(CheckColor(Color(Interpolation::Constant, {}, {0}), faces, 4), "");
    EXPECT_NE(CheckColor(Color(Interpolation::Constant, {{NAN, 0, 0}}), faces, 4), "");
}

}  // namespace
}  // namespace cc::test
