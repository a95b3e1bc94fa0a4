#include "core/subdiv/triangulation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "tests/repeats.h"

namespace cc::test {
namespace {

using Polygon = std::vector<Vec3f>;

constexpr double kPi = 3.14159265358979;

/// Twice the area vector of a triangle.
std::array<double, 3> Area(const Vec3f& a, const Vec3f& b, const Vec3f& c) {
    const double u[3] = {double(b.x) - a.x, double(b.y) - a.y, double(b.z) - a.z};
    const double v[3] = {double(c.x) - a.x, double(c.y) - a.y, double(c.z) - a.z};
    return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

std::array<double, 3> PolygonArea(const Polygon& polygon) {
    std::array<double, 3> sum{};
    for (size_t i = 2; i < polygon.size(); ++i) {
        const auto area = Area(polygon[0], polygon[i - 1], polygon[i]);
        for (int axis = 0; axis < 3; ++axis) {
            sum[axis] += area[axis];
        }
    }
    return sum;
}

double Length(const std::array<double, 3>& v) { return std::hypot(v[0], v[1], v[2]); }

/// What any triangulation must be: n - 2 triangles of the polygon's corners that use each edge of
/// the polygon once, and each diagonal once in either direction.
void ExpectTriangulation(const Polygon& polygon, const std::vector<PolygonTriangle>& triangles) {
    const auto count = static_cast<uint32_t>(polygon.size());
    ASSERT_EQ(triangles.size(), polygon.size() - 2);
    std::set<std::pair<uint32_t, uint32_t>> edges;
    for (const PolygonTriangle& t : triangles) {
        for (int i = 0; i < 3; ++i) {
            ASSERT_LT(t[i], count);
            EXPECT_TRUE(edges.insert({t[i], t[(i + 1) % 3]}).second) << "an edge is used twice";
        }
    }
    for (uint32_t i = 0; i < count; ++i) {
        EXPECT_EQ(edges.erase({i, (i + 1) % count}), 1u) << "edge " << i << " is missing";
    }
    for (const auto& edge : edges) {
        EXPECT_EQ(edges.count({edge.second, edge.first}), 1u) << "a diagonal has one side only";
    }
}

/// The triangles cover the inside of a polygon once: none is turned over, and areas add up.
void ExpectCovered(const Polygon& polygon) {
    const std::vector<PolygonTriangle> triangles = TriangulatePolygon(polygon);
    ExpectTriangulation(polygon, triangles);
    const std::array<double, 3> whole = PolygonArea(polygon);
    double sum = 0;
    for (const PolygonTriangle& t : triangles) {
        const auto area = Area(polygon[t[0]], polygon[t[1]], polygon[t[2]]);
        sum += Length(area);
        const double along =
            (area[0] * whole[0] + area[1] * whole[1] + area[2] * whole[2]) / Length(whole);
        EXPECT_GE(along, -1e-6 * Length(whole));
    }
    EXPECT_NEAR(sum / Length(whole), 1, 1e-5);
}

Polygon Flat(const std::vector<Vec2f>& corners) {
    Polygon polygon;
    for (const Vec2f& p : corners) {
        polygon.push_back({p.x, p.y, 0});
    }
    return polygon;
}

/// Radii by turns around a circle.
Polygon Star(int tips, float inner) {
    Polygon polygon;
    for (int i = 0; i < 2 * tips; ++i) {
        const double angle = kPi * i / tips, radius = i % 2 == 0 ? 1 : inner;
        polygon.push_back({float(radius * std::cos(angle)), float(radius * std::sin(angle)), 0});
    }
    return polygon;
}

/// Out along one side of a spiral and back along the other.
Polygon Spiral(int turns, int steps) {
    Polygon polygon;
    const auto add = [&](int i, double width) {
        const double angle = 2 * kPi * i / steps, radius = 1 + angle / (2 * kPi) + width;
        polygon.push_back({float(radius * std::cos(angle)), float(radius * std::sin(angle)), 0});
    };
    for (int i = 0; i <= turns * steps; ++i) {
        add(i, 0.5);
    }
    for (int i = turns * steps; i >= 0; --i) {
        add(i, 0);
    }
    return polygon;
}

/// A polygon put anywhere in space, and out of its plane by a little.
Polygon Tilted(Polygon polygon, float bend) {
    for (size_t i = 0; i < polygon.size(); ++i) {
        const Vec3f p = polygon[i];
        const float z = bend * std::sin(5 * p.x + 3 * p.y);
        polygon[i] = {0.6f * p.x - 0.8f * z + 7, 0.48f * p.x + 0.8f * p.y + 0.36f * z - 3,
                      0.64f * p.x - 0.6f * p.y + 0.48f * z + 2};
    }
    return polygon;
}

const Polygon kL = Flat({{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}});
const Polygon kU = Flat({{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}});
/// A square with a square hole, reached over a bridge that is walked twice.
const Polygon kKeyhole =
    Flat({{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}, {1, 1}, {1, 3}, {3, 3}, {3, 1}, {1, 1}});

TEST(Triangulation, CoversConcavePolygons) {
    for (const Polygon& polygon :
         {kL, kU, kKeyhole, Star(5, 0.4f), Star(7, 0.05f), Star(40, 0.7f), Spiral(3, 17)}) {
        ExpectCovered(polygon);
        ExpectCovered(Tilted(polygon, 0));
        Polygon backwards(polygon.rbegin(), polygon.rend());
        ExpectCovered(backwards);
    }
}

TEST(Triangulation, CoversRandomPolygons) {
    std::mt19937 random(17);
    std::uniform_real_distribution<float> unit(0, 1);
    for (int trial = 0; trial < 300; ++trial) {
        // Seen from the middle, corners come one after the other: it does not cross itself.
        const int count = 4 + trial % 40;
        Polygon polygon;
        for (int i = 0; i < count; ++i) {
            const double angle = 2 * kPi * (i + 0.4 * unit(random)) / count;
            const double radius = 0.02 + unit(random) * unit(random);
            polygon.push_back(
                {float(radius * std::cos(angle)), float(radius * std::sin(angle)), 0});
        }
        ExpectCovered(polygon);
    }
}

TEST(Triangulation, StartsAnywhereAndIsTheSameEveryTime) {
    Polygon polygon = kU;
    for (size_t i = 0; i < polygon.size(); ++i) {
        ExpectCovered(polygon);
        EXPECT_EQ(TriangulatePolygon(polygon), TriangulatePolygon(polygon));
        std::rotate(polygon.begin(), polygon.begin() + 1, polygon.end());
    }
}

TEST(Triangulation, CutsConvexQuadsFromTheFirstCorner) {
    const std::vector<PolygonTriangle> expected{{0, 1, 2}, {0, 2, 3}};
    EXPECT_EQ(TriangulatePolygon(Flat({{0, 0}, {5, 0}, {5, 1}, {0, 1}})), expected);
    EXPECT_EQ(TriangulatePolygon(Flat({{0, 0}, {0, 1}, {5, 1}, {5, 0}})), expected);
    // The other diagonal is shorter, which makes no difference.
    EXPECT_EQ(TriangulatePolygon(Flat({{0, 0}, {2, 1}, {5, 5}, {1, 2}})), expected);
}

TEST(Triangulation, CutsDartsFromTheirNotch) {
    Polygon dart = Flat({{0, 0}, {4, 1}, {0, 2}, {1, 1}});
    for (size_t notch = 4; notch-- > 0;) {
        ExpectCovered(dart);
        for (const PolygonTriangle& t : TriangulatePolygon(dart)) {
            EXPECT_EQ(std::count(t.begin(), t.end(), (notch + 0) % 4), 1) << notch;
        }
        std::rotate(dart.begin(), dart.begin() + 1, dart.end());
    }
}

TEST(Triangulation, TakesStraightAndRepeatedCorners) {
    const Polygon straight = Flat({{0, 0},
                                   {1, 0},
                                   {1.25f, 0},
                                   {1.5f, 0},
                                   {1.75f, 0},
                                   {3, 0},
                                   {3, 1},
                                   {3, 2},
                                   {2, 2},
                                   {1, 2},
                                   {0, 2},
                                   {0, 1}});
    ExpectCovered(straight);
    for (const PolygonTriangle& t : TriangulatePolygon(straight)) {
        // Each of them has neighbours that meet it there: no triangle may pass over one.
        EXPECT_GT(Length(Area(straight[t[0]], straight[t[1]], straight[t[2]])), 0.1);
    }
    ExpectCovered(Flat({{0, 0}, {3, 0}, {3, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 1}, {1, 3}, {0, 3}}));
    // In float, a third of the way is not on the line.
    ExpectCovered(Tilted(straight, 0));
}

TEST(Triangulation, TakesPolygonsThatAreNotQuiteFlat) {
    for (const Polygon& polygon : {kL, kU, Star(9, 0.5f)}) {
        ExpectTriangulation(Tilted(polygon, 0.02f), TriangulatePolygon(Tilted(polygon, 0.02f)));
        ExpectCovered(Tilted(polygon, 1e-4f));
    }
}

TEST(Triangulation, IsAFanOfNothingBelowThreeCorners) {
    EXPECT_TRUE(TriangulatePolygon({}).empty());
    EXPECT_TRUE(TriangulatePolygon(Flat({{0, 0}, {1, 0}})).empty());
    EXPECT_EQ(TriangulatePolygon(Flat({{0, 0}, {1, 0}, {0, 1}})).size(), 1u);
}

TEST(Triangulation, CoversWhatHasNoInsideSomehow) {
    const Polygon bowTie = Flat({{0, 0}, {1, 1}, {1, 0}, {0, 1}});
    const Polygon line = Flat({{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}});
    const Polygon point(9, Vec3f{1, 2, 3});
    Polygon pentagram;
    for (int i = 0; i < 5; ++i) {
        const double angle = 4 * kPi * i / 5;
        pentagram.push_back({float(std::cos(angle)), float(std::sin(angle)), 0});
    }
    for (const Polygon& polygon : {bowTie, line, point, pentagram}) {
        ExpectTriangulation(polygon, TriangulatePolygon(polygon));
    }
    std::mt19937 random(3);
    std::uniform_real_distribution<float> unit(-1, 1);
    for (int count = 4; count < 300; count = count * 3 / 2) {
        Polygon scribble;
        for (int i = 0; i < count; ++i) {
            scribble.push_back({unit(random), unit(random), count % 2 == 0 ? 0 : unit(random)});
        }
        ExpectTriangulation(scribble, TriangulatePolygon(scribble));
    }
}

TEST(Triangulation, TakesTheLargestAndSmallestPolygons) {
    for (const float scale : {1e-30f, 1e-6f, 1e18f}) {
        Polygon polygon = kU;
        for (Vec3f& p : polygon) {
            p *= scale;
        }
        ExpectCovered(polygon);
    }
}

/// These would take minutes if each ear were looked for among all corners.
TEST(Triangulation, BearsAHundredThousandCorners) {
    constexpr int kCount = Repeats(100000);
    ExpectCovered(Star(kCount / 2, 0.9f));
    Polygon circle;
    for (int i = 0; i < kCount; ++i) {
        const double angle = 2 * kPi * i / kCount;
        circle.push_back({float(std::cos(angle)), float(std::sin(angle)), 0});
    }
    ExpectTriangulation(circle, TriangulatePolygon(circle));
    Polygon comb;
    for (int i = 0; i < kCount / 2; ++i) {
        comb.push_back({float(i), i % 2 == 0 ? 0.0f : 10000.0f, 0});
    }
    comb.push_back({float(kCount) / 2, -1, 0});
    comb.push_back({0, -1, 0});
    ExpectCovered(comb);
    ExpectTriangulation(Spiral(20, kCount / 40), TriangulatePolygon(Spiral(20, kCount / 40)));
    std::mt19937 random(3);
    std::uniform_real_distribution<float> unit(-1, 1);
    Polygon scribble(kCount);
    for (Vec3f& p : scribble) {
        p = {unit(random), unit(random), 0};
    }
    ExpectTriangulation(scribble, TriangulatePolygon(scribble));
}

}  // namespace
}  // namespace cc::test
