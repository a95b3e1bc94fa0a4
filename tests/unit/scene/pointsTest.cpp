#include "core/scene/points.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/unit/render/renderTestKit.h"

namespace cc::test {
namespace {

using testing::Test;

struct PointsTest : Test {
    PointsTest() : points(scene.AddPoints("/points")) {
        points->SetPoints({{0, 0, 0}, {3, 0, 0}, {6, 0, 0}});
    }

    std::vector<std::string> Build() { return scene.Build({"geometry"}); }
    const Spheres& Built() const { return static_cast<const Spheres&>(*points->BuiltGeometry()); }
    float Width(uint32_t i) const { return 2 * Built().At(i).radius; }

    Scene scene;
    Points* points;
};

Primvar Widths(Interpolation interpolation, std::vector<float> values) {
    return {interpolation, 1, std::move(values), {}};
}

TEST_F(PointsTest, HaveTheWidthsThatAreGiven) {
    EXPECT_TRUE(Build().empty());
    EXPECT_EQ(Width(1), 1);
    points->SetWidths(Widths(Interpolation::Constant, {0.5f}));
    EXPECT_TRUE(Build().empty());
    EXPECT_EQ(Width(2), 0.5f);
    for (const Interpolation interpolation : {Interpolation::Vertex, Interpolation::Varying}) {
        points->SetWidths(Widths(interpolation, {1, 2, 3}));
        EXPECT_TRUE(Build().empty());
        EXPECT_EQ(Width(1), 2);
        EXPECT_EQ(Width(2), 3);
    }
    EXPECT_EQ(Built().Bounds().upper.x, 7.5f + 5e-7f * 7.5f);
}

TEST_F(PointsTest, WithTheWrongNumberOfWidthsAreOneWide) {
    points->SetWidths(Widths(Interpolation::Vertex, {2, 2}));
    EXPECT_EQ(Build(), std::vector<std::string>{"</points>: widths is vertex and has 2 elements "
                                                "where 3 belong; widths of 1 are used"});
    EXPECT_EQ(Width(1), 1);
    EXPECT_TRUE(Build().empty()) << "said once";
}

TEST_F(PointsTest, ThatCannotBeShownAreLeftOutByThemselves) {
    points->SetPoints({{0, 0, 0}, {NAN, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}});
    points->SetWidths(Widths(Interpolation::Vertex, {1, 1, -1, NAN, 0}));
    EXPECT_EQ(Build(), (std::vector<std::string>{
                           "</points>: 1 point is not finite or too far away; it is left out",
                           "</points>: 2 points have widths that are negative or not finite; they "
                           "are left out"}));
    for (uint32_t i = 0; i < 5; ++i) {
        EXPECT_EQ(Width(i), i == 0 ? 1 : 0);
    }
    EXPECT_LT(Built().Bounds().upper.x, 0.51f);
}

TEST_F(PointsTest, WithoutAnyToShowAreLeftOut) {
    points->SetWidths(Widths(Interpolation::Constant, {0}));
    EXPECT_TRUE(Build().empty());
    EXPECT_EQ(points->BuiltGeometry(), nullptr);
    EXPECT_TRUE(scene.ShownShapes().empty());
    points->SetPoints({});
    points->SetWidths({});
    EXPECT_TRUE(Build().empty());
    EXPECT_EQ(points->BuiltGeometry(), nullptr);
}

TEST_F(PointsTest, MoveAndGrowWithoutARebuild) {
    Build();
    const Geometry* const geometry = points->BuiltGeometry();
    points->SetPoints({{0, 0, 0}, {3, 9, 0}, {6, 0, 0}});
    Build();
    EXPECT_EQ(points->BuiltGeometry(), geometry);
    EXPECT_GT(geometry->Bounds().upper.y, 9);
    points->SetWidths(Widths(Interpolation::Constant, {4}));
    Build();
    EXPECT_EQ(points->BuiltGeometry(), geometry);
    EXPECT_EQ(Built().At(1).center, (Vec3f{3, 9, 0})) << "points that did not change stay";
    EXPECT_GT(geometry->Bounds().upper.y, 11);
    EXPECT_EQ(scene.GetStatistics().surfacesMoved, 2u);
    points->SetPoints({{1, 1, 1}});
    Build();
    EXPECT_EQ(points->BuiltGeometry()->PrimitiveCount(), 1u);
    EXPECT_EQ(scene.GetStatistics().surfacesBuilt, 2u);
}

TEST_F(PointsTest, EachHaveTheirPrimvars) {
    points->SetPrimvar("displayColor",
                       Primvar3(Interpolation::Vertex, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}));
    points->SetPrimvar("mass", {Interpolation::Varying, 1, {4, 5, 6}, {}});
    points->SetPrimvar("one", {Interpolation::Constant, 2, {7, 8}, {}});
    points->SetPrimvar("bad", {Interpolation::Vertex, 1, {4, 5}, {}});
    EXPECT_EQ(Build(), std::vector<std::string>{"</points>: bad is vertex and has 2 elements where "
                                                "3 belong; it is left out"});
    const ShapePoint second{0, 1, 0.5f, 0.5f};
    EXPECT_EQ(points->DisplayColor(second), (Vec3f{0, 1, 0}));
    EXPECT_EQ(points->Evaluate(*points->FindPrimvar("mass"), second).value[0], 5);
    EXPECT_EQ(points->Evaluate(*points->FindPrimvar("one"), second).value[1], 8);
    EXPECT_EQ(points->FindPrimvar("bad"), nullptr);
    EXPECT_EQ(points->ElementOf(2), 2u);

    // The next points may be those that the values belong to.
    points->SetPoints({{0, 0, 0}, {3, 0, 0}});
    EXPECT_EQ(Build().size(), 2u) << "two do not fit any more";
    EXPECT_NE(points->FindPrimvar("bad"), nullptr);
    EXPECT_EQ(points->DisplayColor(second), kDefaultDisplayColor);
}

TEST_F(PointsTest, HaveInstances) {
    points->SetInstances({Placed(1, 0, 0, 0), Placed(2, 0, 10, 0)});
    points->SetPrimvar("displayColor", Primvar3(Interpolation::Instance, {{1, 0, 0}, {0, 0, 1}}));
    EXPECT_TRUE(Build().empty());
    EXPECT_EQ(scene.GetStatistics().instances, 2u);
    EXPECT_EQ(points->DisplayColor({1, 0, 0, 0}), (Vec3f{0, 0, 1}));
    EXPECT_GT(scene.Instances().Bounds().upper.y, 10.9f);
}

}  // namespace
}  // namespace cc::test
