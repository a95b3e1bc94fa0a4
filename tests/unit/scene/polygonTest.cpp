#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "tests/unit/render/renderTestKit.h"

namespace cc::test {
namespace {

RenderOptions OneSample() {
    RenderOptions options;
    options.samples = 1;
    return options;
}

/// Flat faces in the xy plane that face +z, not subdivided.
Cage Polygons(const std::vector<std::vector<int>>& faces, const std::vector<Vec3f>& points) {
    Cage cage;
    cage.name = "polygons";
    cage.mesh.scheme = Scheme::None;
    for (const std::vector<int>& face : faces) {
        cage.mesh.faceVertexCounts.push_back(static_cast<int>(face.size()));
        cage.mesh.faceVertexIndices.insert(cage.mesh.faceVertexIndices.end(), face.begin(),
                                           face.end());
    }
    cage.points = points;
    return cage;
}

/// A U in -1..1 whose gap is |x| < 1/3, y > -1/3; a fan from its first corner would fill the gap.
Cage LetterU() {
    const float t = 1 / 3.0f;
    return Polygons({{0, 1, 2, 3, 4, 5, 6, 7}}, {{-1, -1, 0},
                                                 {1, -1, 0},
                                                 {1, 1, 0},
                                                 {t, 1, 0},
                                                 {t, -t, 0},
                                                 {-t, -t, 0},
                                                 {-t, 1, 0},
                                                 {-1, 1, 0}});
}

constexpr int kSize = 32;

/// Pixel centres in -2..2: CameraAt(4) sees as much of the plane.
float At(int pixel) { return (static_cast<float>(pixel) + 0.5f) * 4 / kSize - 2; }

Film Render(Scene* scene, std::vector<Aov> aovs) {
    EXPECT_TRUE(scene->Build({"geometry"}).empty());
    Film film(kSize, kSize, std::move(aovs));
    RenderStatistics statistics;
    RenderFrame(scene, CameraAt(4), OneSample(), &film, &statistics, nullptr, nullptr);
    return film;
}

/// Calls check(pixel, x, y, isInside) for all pixels of the U.
template <typename Check>
void ForEachPixelOfU(const Check& check) {
    for (int row = 0; row < kSize; ++row) {
        for (int column = 0; column < kSize; ++column) {
            const float x = At(column), y = At(row);
            const bool isInGap = std::fabs(x) < 1 / 3.0f && y > -1 / 3.0f;
            check(row * kSize + column, x, y, std::fabs(x) < 1 && std::fabs(y) < 1 && !isInGap);
        }
    }
}

TEST(Polygon, ConcaveOnesHaveTheirOutline) {
    Scene scene;
    AddCage(&scene, "/u", LetterU());
    const Film film = Render(&scene, {Aov::PrimId, Aov::ElementId, Aov::Normal, Aov::CameraDepth});
    ForEachPixelOfU([&](int pixel, float, float, bool isInside) {
        ASSERT_EQ(film.Ints(Aov::PrimId)[pixel], isInside ? 0 : -1);
        ASSERT_EQ(film.Ints(Aov::ElementId)[pixel], isInside ? 0 : -1);
        EXPECT_NEAR(film.Floats(Aov::Normal)[3 * pixel + 2], isInside ? 1 : 0, 1e-6f);
        EXPECT_NEAR(film.Floats(Aov::CameraDepth)[pixel], isInside ? 4 : 0, 1e-5f);
    });
}

TEST(Polygon, ValuesAreLinearOverItsTriangles) {
    const Cage cage = LetterU();
    std::vector<float> atPoints, atCorners;
    for (const Vec3f& p : cage.points) {
        atPoints.insert(atPoints.end(), {3 * p.x - p.y, p.x + 5 * p.y});
    }
    atCorners = atPoints;
    for (const Interpolation interpolation :
         {Interpolation::Varying, Interpolation::Vertex, Interpolation::FaceVarying}) {
        Scene scene;
        AddCage(&scene, "/u", cage)->SetPrimvar("st", {interpolation, 2, atPoints, {}});
        const Aov st(Aov::Primvar, "st", 2);
        const Film film = Render(&scene, {st});
        ForEachPixelOfU([&](int pixel, float x, float y, bool isInside) {
            ASSERT_EQ(film.Coverage(st)[pixel], isInside);
            EXPECT_NEAR(film.Floats(st)[2 * pixel], isInside ? 3 * x - y : 0, 1e-5f);
            EXPECT_NEAR(film.Floats(st)[2 * pixel + 1], isInside ? x + 5 * y : 0, 1e-5f);
        });
    }
}

TEST(Polygon, CornersThatRepeatAPointKeepTheirOwnValues) {
    // A square whose second corner is there twice, with two values: they meet in the corner.
    const Cage cage = Polygons({{0, 1, 1, 2, 3}}, {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}});
    Scene scene;
    AddCage(&scene, "/square", cage)
        ->SetPrimvar("x", {Interpolation::FaceVarying, 1, {0, 1, 5, 5, 0}, {}});
    const Aov aov(Aov::Primvar, "x", 1);
    const Film film = Render(&scene, {aov});
    const auto value = [&](int column, int row) { return film.Floats(aov)[row * kSize + column]; };
    EXPECT_GT(value(23, 23), 4);
    EXPECT_LT(value(8, 23), 0.5f);
    EXPECT_LT(value(8, 8), 0.5f);
    // From 0 to 1 along the lower edge.
    EXPECT_NEAR(value(16, 8), 0.5f, 0.2f);
}

TEST(Polygon, TheCutFollowsThePoints) {
    Scene scene;
    Cage cage = LetterU();
    Mesh* const mesh = AddCage(&scene, "/u", cage);
    Render(&scene, {});
    // The notch now comes from below.
    for (Vec3f& p : cage.points) {
        p.x = -p.x;
        p.y = -p.y;
    }
    std::rotate(cage.points.begin(), cage.points.begin() + 3, cage.points.end());
    mesh->SetPoints(cage.points);
    const Film film = Render(&scene, {Aov::PrimId});
    ForEachPixelOfU([&](int pixel, float, float, bool isInside) {
        ASSERT_EQ(film.Ints(Aov::PrimId)[kSize * kSize - 1 - pixel], isInside ? 0 : -1);
    });
    EXPECT_EQ(scene.GetStatistics().surfacesBuilt, 1u);
}

TEST(Polygon, HolesAreLeftOut) {
    Cage cage = Polygons({{0, 1, 4, 3}, {1, 2, 5, 4}},
                         {{-1, -1, 0}, {0, -1, 0}, {1, -1, 0}, {-1, 1, 0}, {0, 1, 0}, {1, 1, 0}});
    cage.mesh.holeIndices = {0};
    Scene scene;
    AddCage(&scene, "/holes", cage);
    const Film film = Render(&scene, {Aov::ElementId});
    for (int pixel = 0; pixel < kSize * kSize; ++pixel) {
        const float x = At(pixel % kSize), y = At(pixel / kSize);
        EXPECT_EQ(film.Ints(Aov::ElementId)[pixel], x > 0 && x < 1 && std::fabs(y) < 1 ? 1 : -1);
    }
}

/// The normal at the middle of a square that is not subdivided, given authored ones.
struct NormalOfSquare {
    explicit NormalOfSquare(const Primvar& normals, Scheme scheme = Scheme::None,
                            bool isReversed = false) {
        Scene scene;
        Cage cage = isReversed ? Reversed(Square()) : Square();
        cage.mesh.scheme = scheme;
        AddCage(&scene, "/square", cage)->SetPrimvar("normals", normals);
        lines = scene.Build({"geometry"});
        Film film(1, 1, {Aov::Normal});
        RenderStatistics statistics;
        RenderFrame(&scene, CameraAt(4), OneSample(), &film, &statistics, nullptr, nullptr);
        const float* n = film.Floats(Aov::Normal);
        normal = {n[0], n[1], n[2]};
    }

    Vec3f normal;
    std::vector<std::string> lines;
};

void ExpectNear(const Vec3f& a, const Vec3f& b) { EXPECT_LT(Length(a - b), 1e-5f); }

TEST(Polygon, AuthoredNormalsShade) {
    const Vec3f n{0.6f, 0, 0.8f};
    for (const Primvar& normals :
         {Primvar3(Interpolation::Constant, {n * 3}), Primvar3(Interpolation::Uniform, {n}),
          Primvar3(Interpolation::Varying, {n, n, n, n}),
          Primvar3(Interpolation::Vertex, {n, n, n, n}),
          Primvar3(Interpolation::FaceVarying, {n}, {0, 0, 0, 0})}) {
        const NormalOfSquare square(normals);
        EXPECT_TRUE(square.lines.empty());
        ExpectNear(square.normal, n);
        // Seen from behind, and given the wrong way round: it is the side that is seen.
        ExpectNear(NormalOfSquare(normals, Scheme::None, true).normal, n);
        Primvar inwards = normals;
        for (float& number : inwards.values) {
            number = -number;
        }
        ExpectNear(NormalOfSquare(inwards).normal, n);
    }
}

TEST(Polygon, NormalsAreLinearAndThenUnit) {
    const Vec3f left{-0.6f, 0, 0.8f}, right{0.6f, 0, 0.8f};
    const NormalOfSquare square(Primvar3(Interpolation::Vertex, {left, right, right, left}));
    ExpectNear(square.normal, {0, 0, 1});
}

TEST(Polygon, SubdivisionHasNormalsOfItsOwn) {
    const Primvar normals = Primvar3(Interpolation::Constant, {{0.6f, 0, 0.8f}});
    for (const Scheme scheme : {Scheme::CatmullClark, Scheme::Bilinear}) {
        ExpectNear(NormalOfSquare(normals, scheme).normal, {0, 0, 1});
    }
}

TEST(Polygon, BadNormalsGiveFacetsAndOneWarning) {
    constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
    for (const Primvar& normals :
         {Primvar3(Interpolation::Vertex, {{1, 0, 0}}), Primvar3(Interpolation::Constant, {{}}),
          Primvar3(Interpolation::Constant, {{1, 0, kNaN}}),
          Primvar{Interpolation::Constant, 2, {1, 0}, {}}}) {
        const NormalOfSquare square(normals);
        ASSERT_EQ(square.lines.size(), 1u);
        EXPECT_NE(square.lines[0].find("</square>: "), std::string::npos);
        EXPECT_NE(square.lines[0].find("normals"), std::string::npos);
        EXPECT_NE(square.lines[0].find("facets"), std::string::npos);
        ExpectNear(square.normal, {0, 0, 1});
    }
}

/// The colour of the middle of a white square that is lit from a direction.
float Brightness(const Vec3f& normal, const Vec3f& towardsLight) {
    Scene scene;
    Cage cage = Square();
    cage.mesh.scheme = Scheme::None;
    Mesh* const mesh = AddCage(&scene, "/square", cage);
    mesh->SetPrimvar("normals", Primvar3(Interpolation::Constant, {normal}));
    mesh->SetPrimvar("displayColor", ConstantColor({1, 1, 1}));
    Light* const light = scene.AddLight();
    light->direction = -towardsLight;
    light->power = {3.14159265f, 0, 0};
    // Else the square itself would be in the way of what comes from behind.
    light->castsShadows = false;
    scene.Build({"geometry"});
    Film film(1, 1, {Aov::Color});
    RenderStatistics statistics;
    RenderFrame(&scene, CameraAt(4), OneSample(), &film, &statistics, nullptr, nullptr);
    return film.Floats(Aov::Color)[0];
}

TEST(Polygon, LightMeetsTheAuthoredNormalOnTheSideOfTheFacet) {
    const Vec3f tilted{0.8f, 0, 0.6f};
    EXPECT_NEAR(Brightness({0, 0, 1}, {0, 0, 1}), 1, 1e-4f);
    EXPECT_NEAR(Brightness(tilted, {0, 0, 1}), 0.6f, 1e-4f);
    EXPECT_NEAR(Brightness(tilted, tilted), 1, 1e-4f);
    // Before the tilted normal, but behind the facet.
    EXPECT_EQ(Brightness(tilted, Normalize({1, 0, -0.2f})), 0);
    // Behind the tilted normal.
    EXPECT_EQ(Brightness(tilted, Normalize({-1, 0, 0.2f})), 0);
}

}  // namespace
}  // namespace cc::test
