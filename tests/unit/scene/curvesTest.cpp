#include "core/scene/curves.h"

#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "tests/unit/render/renderTestKit.h"

namespace cc::test {
namespace {

constexpr CurveBasis kCubic[] = {CurveBasis::Bezier, CurveBasis::BSpline, CurveBasis::CatmullRom};

Primvar Numbers(Interpolation interpolation, std::vector<float> values) {
    return {interpolation, 1, std::move(values), {}};
}

struct CurvesTest : testing::Test {
    CurvesTest() : curves(scene.AddCurves("/curves")) {}

    /// Curves whose points are one apart along x.
    std::vector<std::string> Set(CurveBasis basis, CurveWrap wrap, std::vector<int> counts) {
        const int count = std::accumulate(counts.begin(), counts.end(), 0);
        std::vector<Vec3f> points;
        for (int i = 0; i < count; ++i) {
            points.push_back({static_cast<float>(i), 0, 0});
        }
        curves->SetTopology({basis, wrap, std::move(counts)});
        curves->SetPoints(points);
        return Build();
    }
    std::vector<std::string> Build() { return scene.Build({"geometry"}); }
    const CurveSegments& Built() const {
        return static_cast<const CurveSegments&>(*curves->BuiltGeometry());
    }
    float Begin(uint32_t segment) const { return Built().At(segment).PointAt(0).x; }
    float End(uint32_t segment) const { return Built().At(segment).PointAt(1).x; }
    float ValueAt(const char* name, uint32_t segment, float u) const {
        return curves->Evaluate(*curves->FindPrimvar(name), {0, segment, u, 0}).value[0];
    }

    Scene scene;
    Curves* curves;
};

TEST_F(CurvesTest, BeginAndEndAsTheirBasisAndWrapSay) {
    struct Case {
        CurveBasis basis;
        CurveWrap wrap;
        int points, segments;
        float begin, end;
    };
    const Case cases[] = {
        {CurveBasis::Linear, CurveWrap::Nonperiodic, 5, 4, 0, 4},
        {CurveBasis::Linear, CurveWrap::Pinned, 5, 4, 0, 4},
        {CurveBasis::Linear, CurveWrap::Periodic, 5, 5, 0, 0},
        {CurveBasis::Bezier, CurveWrap::Nonperiodic, 7, 2, 0, 6},
        {CurveBasis::Bezier, CurveWrap::Periodic, 6, 2, 0, 0},
        {CurveBasis::BSpline, CurveWrap::Nonperiodic, 6, 3, 1, 4},
        {CurveBasis::BSpline, CurveWrap::Pinned, 6, 5, 0, 5},
        {CurveBasis::BSpline, CurveWrap::Periodic, 6, 6, 1, 1},
        {CurveBasis::CatmullRom, CurveWrap::Nonperiodic, 6, 3, 1, 4},
        {CurveBasis::CatmullRom, CurveWrap::Pinned, 6, 5, 0, 5},
        {CurveBasis::CatmullRom, CurveWrap::Pinned, 2, 1, 0, 1},
        {CurveBasis::CatmullRom, CurveWrap::Periodic, 6, 6, 1, 1},
    };
    for (const Case& one : cases) {
        EXPECT_TRUE(Set(one.basis, one.wrap, {one.points}).empty());
        const auto last = static_cast<uint32_t>(one.segments - 1);
        ASSERT_EQ(Built().PrimitiveCount(), size_t(one.segments));
        EXPECT_NEAR(Begin(0), one.begin, 1e-6f);
        EXPECT_NEAR(End(last), one.end, 1e-6f);
        for (uint32_t s = 0; s < last; ++s) {
            EXPECT_EQ(Built().At(s).next, s + 1);
            EXPECT_EQ(Built().At(s + 1).previous, s);
            EXPECT_NEAR(End(s), Begin(s + 1), 1e-6f);
        }
        const bool isPeriodic = one.wrap == CurveWrap::Periodic;
        EXPECT_EQ(Built().At(last).next, isPeriodic ? 0 : CurveSegment::kNone);
        EXPECT_EQ(Built().At(0).previous, isPeriodic ? last : CurveSegment::kNone);
    }
}

TEST_F(CurvesTest, FollowTheirBasis) {
    curves->SetPoints({{0, 0, 0}, {1, 3, 0}, {2, -3, 0}, {4, 1, 0}});
    // At u = 1/2: the weights of the points.
    const float weights[3][4] = {{1 / 8.f, 3 / 8.f, 3 / 8.f, 1 / 8.f},
                                 {1 / 48.f, 23 / 48.f, 23 / 48.f, 1 / 48.f},
                                 {-1 / 16.f, 9 / 16.f, 9 / 16.f, -1 / 16.f}};
    for (int i = 0; i < 3; ++i) {
        curves->SetTopology({kCubic[i], CurveWrap::Nonperiodic, {4}});
        EXPECT_TRUE(Build().empty());
        const float* w = weights[i];
        const Vec3f expected{w[1] + 2 * w[2] + 4 * w[3], 3 * w[1] - 3 * w[2] + w[3], 0};
        EXPECT_LT(Length(Built().At(0).PointAt(0.5f) - expected), 1e-6f);
    }
}

TEST_F(CurvesTest, HaveWidthsInEveryInterpolation) {
    Set(CurveBasis::CatmullRom, CurveWrap::Pinned, {3, 2});
    EXPECT_EQ(Built().At(0).RadiusAt(0.5f), 0.5f) << "without widths";
    const auto radius = [&](Interpolation interpolation, std::vector<float> widths,
                            uint32_t segment, float u) {
        curves->SetWidths(Numbers(interpolation, std::move(widths)));
        EXPECT_TRUE(Build().empty());
        return Built().At(segment).RadiusAt(u);
    };
    EXPECT_EQ(radius(Interpolation::Constant, {4}, 2, 0.3f), 2);
    EXPECT_EQ(radius(Interpolation::Uniform, {4, 6}, 2, 0.5f), 3);
    EXPECT_NEAR(radius(Interpolation::Varying, {1, 2, 4, 6, 8}, 1, 0.5f), 1.5f, 1e-6f);
    EXPECT_NEAR(radius(Interpolation::Varying, {1, 2, 4, 6, 8}, 2, 0), 3, 1e-6f);
    EXPECT_NEAR(radius(Interpolation::Vertex, {1, 2, 4, 6, 8}, 1, 1), 2, 1e-6f);
    // Vertices 1, 2, 4 and beyond the end 2 * 4 - 2.
    EXPECT_NEAR(radius(Interpolation::Vertex, {1, 2, 4, 6, 8}, 1, 0.5f),
                0.5f * (-1 / 16.f * (1 + 6) + 9 / 16.f * (2 + 4)), 1e-6f);
}

TEST_F(CurvesTest, HavePrimvarsInEveryInterpolation) {
    Set(CurveBasis::CatmullRom, CurveWrap::Pinned, {3, 2});
    curves->SetPrimvar("c", Numbers(Interpolation::Constant, {9}));
    curves->SetPrimvar("u", Numbers(Interpolation::Uniform, {4, 6}));
    curves->SetPrimvar("varying", Numbers(Interpolation::Varying, {1, 2, 4, 6, 8}));
    curves->SetPrimvar("v", Numbers(Interpolation::Vertex, {1, 2, 4, 6, 8}));
    EXPECT_TRUE(Build().empty());
    EXPECT_EQ(ValueAt("c", 2, 0.5f), 9);
    EXPECT_EQ(ValueAt("u", 1, 0.5f), 4);
    EXPECT_EQ(ValueAt("u", 2, 0.5f), 6);
    EXPECT_NEAR(ValueAt("varying", 1, 0.25f), 2.5f, 1e-6f);
    EXPECT_NEAR(ValueAt("v", 1, 0.5f), -7 / 16.f + 9 / 16.f * 6, 1e-6f);
    EXPECT_EQ(curves->ElementOf(1), 0u);
    EXPECT_EQ(curves->ElementOf(2), 1u);
}

TEST_F(CurvesTest, VaryingValuesOfPeriodicOnesMeet) {
    Set(CurveBasis::BSpline, CurveWrap::Periodic, {4});
    curves->SetPrimvar("x", Numbers(Interpolation::Varying, {1, 2, 3, 4}));
    EXPECT_TRUE(Build().empty());
    EXPECT_NEAR(ValueAt("x", 3, 0.75f), 1.75f, 1e-6f);
}

TEST_F(CurvesTest, ThatCannotBeShownAreLeftOutByThemselves) {
    EXPECT_EQ(Set(CurveBasis::BSpline, CurveWrap::Nonperiodic, {4, 3, 4}),
              std::vector<std::string>{"</curves>: 1 curve has not as many vertices as its basis "
                                       "asks for; it is left out"});
    ASSERT_EQ(Built().PrimitiveCount(), 2u);
    EXPECT_EQ(curves->ElementOf(1), 2u);
    EXPECT_NEAR(Begin(1), 8, 1e-6f);

    curves->SetWidths(Numbers(Interpolation::Uniform, {1, 1, -1}));
    EXPECT_EQ(Build(), std::vector<std::string>{"</curves>: 1 curve has widths that are negative "
                                                "or not finite; it is left out"});
    EXPECT_EQ(Built().At(1).pieces, 0);
    EXPECT_GT(Built().At(0).pieces, 0);

    std::vector<Vec3f> points(11);
    points[9].x = NAN;
    curves->SetPoints(points);
    curves->SetWidths({});
    EXPECT_EQ(Build(), std::vector<std::string>{"</curves>: 1 curve has points that are not finite "
                                                "or too far away; it is left out"});
}

TEST_F(CurvesTest, WithCountsThatMakeNoSenseAreLeftOut) {
    EXPECT_EQ(Set(CurveBasis::Linear, CurveWrap::Nonperiodic, {2}).size(), 0u);
    curves->SetTopology({CurveBasis::Linear, CurveWrap::Nonperiodic, {2, 2}});
    EXPECT_EQ(Build(), std::vector<std::string>{"</curves>: has curves of 4 vertices and 2 points; "
                                                "the curves are left out"});
    EXPECT_EQ(curves->BuiltGeometry(), nullptr);
    curves->SetTopology({CurveBasis::Linear, CurveWrap::Nonperiodic, {-2}});
    EXPECT_EQ(Build().size(), 1u);
    curves->SetTopology({CurveBasis::Linear, CurveWrap::Nonperiodic, {2}});
    EXPECT_EQ(Build().size(), 0u);
    EXPECT_NE(curves->BuiltGeometry(), nullptr);
    curves->SetWidths(Numbers(Interpolation::Vertex, {1, 1, 1}));
    EXPECT_EQ(Build(), std::vector<std::string>{"</curves>: widths is vertex and has 3 elements "
                                                "where 2 belong; widths of 1 are used"});
    curves->SetTopology({});
    curves->SetPoints({});
    EXPECT_EQ(Build().size(), 0u) << "nothing is nothing";
    EXPECT_EQ(curves->BuiltGeometry(), nullptr);
}

TEST_F(CurvesTest, MoveWithoutARebuild) {
    Set(CurveBasis::Linear, CurveWrap::Nonperiodic, {2});
    const Geometry* const geometry = curves->BuiltGeometry();
    curves->SetPoints({{0, 0, 0}, {0, 7, 0}});
    EXPECT_TRUE(Build().empty());
    EXPECT_EQ(curves->BuiltGeometry(), geometry);
    EXPECT_GT(geometry->Bounds().upper.y, 7);
    curves->SetNormals(Primvar3(Interpolation::Constant, {{0, 0, 1}}));
    EXPECT_TRUE(Build().empty());
    EXPECT_TRUE(Built().AreRibbons());
    curves->SetNormals({});
    EXPECT_TRUE(Build().empty());
    EXPECT_FALSE(Built().AreRibbons());
}

}  // namespace
}  // namespace cc::test
