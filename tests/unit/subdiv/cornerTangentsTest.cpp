#include "core/subdiv/cornerTangents.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "core/subdiv/limitPoint.h"
#include "core/subdiv/patchBuilder.h"
#include "tests/unit/subdiv/cageKit.h"
#include "tests/unit/subdiv/testCages.h"

namespace cc::test {
namespace {

using Matrix = std::vector<std::vector<double>>;

Matrix Square(const Matrix& m) {
    Matrix square(m.size(), std::vector<double>(m.size()));
    double largest = 0;
    for (size_t i = 0; i < m.size(); ++i) {
        for (size_t j = 0; j < m.size(); ++j) {
            for (size_t k = 0; k < m.size(); ++k) {
                square[i][j] += m[i][k] * m[k][j];
            }
            largest = std::max(largest, std::abs(square[i][j]));
        }
    }
    for (std::vector<double>& row : square) {
        for (double& value : row) {
            value /= largest;
        }
    }
    return square;
}

/// A sharp corner as vertex 0 of a fan whose other vertices are anywhere.
struct SharpFan {
    Scheme scheme;
    int faceCount;
    bool isClosed;
    bool hasSharpEdge = false;  ///< that to vertex 1, where the fan is closed

    int EdgeCount() const { return faceCount + !isClosed; }
    /// Around the corner: edges, then diagonals.
    int VectorCount() const {
        return EdgeCount() + (scheme == Scheme::CatmullClark ? faceCount : 0);
    }
    int Next(int edge) const { return (edge + 1) % EdgeCount(); }

    Cage ToCage(unsigned seed) const {
        std::mt19937 random(seed);
        std::uniform_real_distribution<float> unit(-1, 1);
        Cage cage;
        cage.mesh.scheme = scheme;
        for (int i = 0; i <= VectorCount(); ++i) {
            cage.points.push_back({unit(random), unit(random), unit(random)});
        }
        for (int j = 0; j < faceCount; ++j) {
            std::vector<int> face{0, 1 + j, 1 + Next(j)};
            if (scheme == Scheme::CatmullClark) {
                face.insert(face.begin() + 2, 1 + EdgeCount() + j);
            }
            AddFace(&cage, face);
        }
        AddCorner(&cage, 0, 10);
        if (hasSharpEdge) {
            AddCrease(&cage, {0, 1}, 10);
        }
        return cage;
    }

    bool IsSharp(int edge) const {
        return (!isClosed && (edge == 0 || edge == EdgeCount() - 1)) || (hasSharpEdge && edge == 0);
    }

    /// What a step makes of the vectors around the corner.
    Matrix Step() const { return scheme == Scheme::Loop ? _LoopStep() : _CatmullClarkStep(); }

    /// Two different vectors.
    using Pair = std::array<int, 2>;
    std::vector<Pair> Pairs() const {
        std::vector<Pair> pairs;
        for (int i = 0; i < VectorCount(); ++i) {
            for (int j = i + 1; j < VectorCount(); ++j) {
                pairs.push_back({i, j});
            }
        }
        return pairs;
    }

    /// What 2^doublings steps make of the cross products of pairs, up to a factor. They are refined
    /// in place of the vectors, which become too alike for a product to tell them apart.
    Matrix Products(int doublings) const {
        const Matrix step = Step();
        const std::vector<Pair> pairs = Pairs();
        Matrix products(pairs.size(), std::vector<double>(pairs.size()));
        for (size_t row = 0; row < pairs.size(); ++row) {
            for (size_t column = 0; column < pairs.size(); ++column) {
                const auto [i, j] = pairs[row];
                const auto [k, l] = pairs[column];
                products[row][column] = step[i][k] * step[j][l] - step[i][l] * step[j][k];
            }
        }
        for (int doubling = 0; doubling < doublings; ++doubling) {
            products = Square(products);
        }
        return products;
    }

    std::array<double, 3> Normal(const Matrix& products, const std::vector<Vec3f>& points,
                                 int face) const {
        const std::vector<Pair> pairs = Pairs();
        const int next = Next(face);
        const Pair pair = {std::min(face, next), std::max(face, next)};
        const size_t row = std::find(pairs.begin(), pairs.end(), pair) - pairs.begin();
        std::array<double, 3> sum{};
        const auto edge = [&](int i, int axis) {
            return static_cast<double>(points[1 + i][axis]) - points[0][axis];
        };
        for (size_t column = 0; column < pairs.size(); ++column) {
            const auto [k, l] = pairs[column];
            for (int axis = 0; axis < 3; ++axis) {
                const int y = (axis + 1) % 3, z = (axis + 2) % 3;
                sum[axis] +=
                    products[row][column] * (edge(k, y) * edge(l, z) - edge(k, z) * edge(l, y));
            }
        }
        const double length = std::hypot(sum[0], sum[1], sum[2]) * (face < next ? 1 : -1);
        return {sum[0] / length, sum[1] / length, sum[2] / length};
    }

  private:
    /// Loop 1987, Hoppe et al. 1994.
    Matrix _LoopStep() const {
        const int n = EdgeCount();
        Matrix step(n, std::vector<double>(n));
        for (int i = 0; i < n; ++i) {
            step[i][i] = IsSharp(i) ? 0.5 : 0.375;
            step[i][(i + 1) % n] += IsSharp(i) ? 0 : 0.125;
            step[i][(i + n - 1) % n] += IsSharp(i) ? 0 : 0.125;
        }
        return step;
    }

    /// Catmull and Clark 1978, with the edges of DeRose et al. 1998.
    Matrix _CatmullClarkStep() const {
        const int edgeCount = EdgeCount();
        Matrix step(VectorCount(), std::vector<double>(VectorCount()));
        for (int j = 0; j < faceCount; ++j) {
            for (const int i : {j, Next(j), edgeCount + j}) {
                step[edgeCount + j][i] += 0.25;
            }
        }
        for (int i = 0; i < edgeCount; ++i) {
            step[i][i] = IsSharp(i) ? 0.5 : 0.25;
            for (const int face : {i, (i + faceCount - 1) % faceCount}) {
                for (int k = 0; k < VectorCount() && !IsSharp(i); ++k) {
                    step[i][k] += 0.25 * step[edgeCount + face][k];
                }
            }
        }
        return step;
    }
};

/// @param doublings  of steps: what is left after n is 1/n in resonance, else a power of n
void ExpectNormalsOfRefinement(const SharpFan& corner, int doublings) {
    const Matrix products = corner.Products(doublings);
    for (unsigned seed = 0; seed < 20; ++seed) {
        Cage cage = corner.ToCage(seed);
        cage.mesh.leftHanded = seed % 2 != 0;
        std::string error;
        const PatchTable patches = BuildPatchTable(cage.mesh, cage.points.size(), &error);
        ASSERT_EQ(error, "");
        const std::vector<Vec3f> points = patches.PatchPoints(cage.points);
        for (uint32_t patch = 0; patch < patches.Count(); ++patch) {
            const int face = static_cast<int>(patches.AuthoredFace(patch));
            const std::array<double, 3> n = corner.Normal(products, cage.points, face);
            Vec3f normal = EvaluateLimit(patches, patch, points.data(), 0, 0).normal;
            normal = cage.mesh.leftHanded ? -normal : normal;
            EXPECT_LT(std::hypot(normal.x - n[0], normal.y - n[1], normal.z - n[2]), 2e-4)
                << corner.faceCount << " faces, closed " << corner.isClosed << ", seed " << seed
                << ", face " << face;
        }
    }
}

TEST(CornerTangents, NormalsAreThoseOfRefinementUnderLoop) {
    for (int faceCount : {1, 2, 3, 4, 5, 6}) {
        ExpectNormalsOfRefinement({Scheme::Loop, faceCount, false}, 22);
    }
    for (int faceCount : {7, 8, 9, 12, 20}) {
        ExpectNormalsOfRefinement({Scheme::Loop, faceCount, false}, 10);
    }
    for (int faceCount : {3, 4, 5, 6, 7, 12}) {
        ExpectNormalsOfRefinement({Scheme::Loop, faceCount, true}, 8);
    }
    // The middle one of five faces shrinks so much more than the others that doubles lose it.
    ExpectNormalsOfRefinement({Scheme::Loop, 5, true, true}, 7);
    for (int faceCount : {4, 6, 7, 8, 12, 20}) {
        ExpectNormalsOfRefinement({Scheme::Loop, faceCount, true, true}, 11);
    }
}

TEST(CornerTangents, NormalsAreThoseOfRefinementUnderCatmullClark) {
    for (int faceCount : {1, 2, 3, 4}) {
        ExpectNormalsOfRefinement({Scheme::CatmullClark, faceCount, false}, 22);
    }
    for (int faceCount : {5, 6, 7, 9}) {
        ExpectNormalsOfRefinement({Scheme::CatmullClark, faceCount, false}, 10);
    }
    for (int faceCount : {2, 3, 4, 5, 7, 9}) {
        ExpectNormalsOfRefinement({Scheme::CatmullClark, faceCount, true}, 8);
    }
    // As above, the middle one of three.
    ExpectNormalsOfRefinement({Scheme::CatmullClark, 3, true, true}, 7);
    for (int faceCount : {2, 4, 5, 7, 9}) {
        ExpectNormalsOfRefinement({Scheme::CatmullClark, faceCount, true, true}, 11);
    }
}

/// Of three faces around a single sharp edge s the edges in between tend to it as k s / 4 in step
/// k, and their difference d is quartered: so slowly that no refinement shows the limit.
TEST(CornerTangents, OfThreeTrianglesAroundASharpEdge) {
    const Vec3f s = {1, 0, 0}, first = {0.3f, 1, 0.2f}, second = {-0.4f, -0.7f, 0.9f};
    const auto normal = [](const SharpCorner& corner, int face) {
        Vec3f towardsEdge, towardsNextEdge;
        EXPECT_TRUE(CornerTangents(corner, face, &towardsEdge, &towardsNextEdge));
        return Normalize(Cross(towardsEdge, towardsNextEdge));
    };
    const SharpCorner corner{{s, first, second, s}, {}, false};
    EXPECT_LT(Length(normal(corner, 0) - Normalize(Cross(s, first + second))), 1e-6f);
    EXPECT_LT(Length(normal(corner, 1) - Normalize(Cross(s, second - first))), 1e-6f);
    EXPECT_LT(Length(normal(corner, 2) - Normalize(Cross(first + second, s))), 1e-6f);
    // A difference along the sharp edge leaves the sum, which is halved.
    const SharpCorner along{{s, first, first - 2.0f * s, s}, {}, false};
    EXPECT_LT(Length(normal(along, 1) - Normalize(Cross(2.0f * first, -s))), 1e-6f);
}

TEST(CornerTangents, OfFewFacesHaveThePlaneOfTheEnds) {
    const Vec3f first = {1, 0, 0}, last = {0, 2, 0}, anything = {0.3f, 0.4f, 5};
    for (const SharpCorner& corner :
         {SharpCorner{{first, anything, last}, {}, false},
          SharpCorner{{first, anything, -anything, last}, {}, false},
          SharpCorner{{first, last}, {anything}, false},
          SharpCorner{{first, anything, last}, {anything, -anything}, false}}) {
        for (int face = 0; face + 1 < static_cast<int>(corner.edges.size()); ++face) {
            Vec3f towardsEdge, towardsNextEdge;
            ASSERT_TRUE(CornerTangents(corner, face, &towardsEdge, &towardsNextEdge));
            const Vec3f normal = Normalize(Cross(towardsEdge, towardsNextEdge));
            EXPECT_EQ(normal, (Vec3f{0, 0, 1})) << face;
        }
    }
}

TEST(CornerTangents, OnAStraightBoundaryHasThePlaneOfItsFaces) {
    for (int faceCount : {2, 3}) {
        Cage cage = SharpFan{Scheme::Loop, faceCount, false}.ToCage(0);
        cage.points = {{5, 5, 5}, {6, 5, 5}, {5.5f, 5.5f, 6}, {4.7f, 5.3f, 5.6f}, {4, 5, 5}};
        if (faceCount == 2) {
            cage.points.erase(cage.points.begin() + 3);
        }
        std::string error;
        const PatchTable patches = BuildPatchTable(cage.mesh, cage.points.size(), &error);
        const std::vector<Vec3f> points = patches.PatchPoints(cage.points);
        // Of two faces the plane of the inner edge, of three that of the sum of both.
        const Vec3f across = faceCount == 2 ? Vec3f{0, 0.5f, 1} : Vec3f{0, 0.8f, 1.6f};
        for (uint32_t patch = 0; patch < patches.Count(); ++patch) {
            const LimitPoint corner = EvaluateLimit(patches, patch, points.data(), 0, 0);
            const Vec3f expected = Normalize(Cross({1, 0, 0}, across));
            EXPECT_LT(Length(corner.normal - expected), 2e-4f) << faceCount << " " << patch;
        }
    }
}

TEST(CornerTangents, AreUnknownWhereEdgesAreParallel) {
    Vec3f towardsEdge, towardsNextEdge;
    const auto areKnown = [&](const SharpCorner& corner, int face) {
        return CornerTangents(corner, face, &towardsEdge, &towardsNextEdge);
    };
    const Vec3f x = {1, 0, 0}, y = {0, 1, 0};
    EXPECT_FALSE(areKnown({{x, -2.0f * x, -x}, {}, false}, 0));
    EXPECT_FALSE(areKnown({{x, x, x, x}, {}, false}, 1));
    EXPECT_FALSE(areKnown({{x, x, x, x, x}, {}, false}, 2));
    EXPECT_FALSE(areKnown({{x, x, x}, {}, true}, 2));
    EXPECT_FALSE(areKnown({{{}, {}, {}}, {}, true}, 0));
    EXPECT_FALSE(areKnown({{x, -2.0f * x, -x}, {-x, -x}, false}, 0));
    EXPECT_FALSE(areKnown({{x, x}, {y, -y}, true}, 0));
    // Flat, and around the corner: no spike.
    EXPECT_TRUE(areKnown({{x, y, -x, -y}, {}, true}, 3));
    EXPECT_EQ(Normalize(Cross(towardsEdge, towardsNextEdge)), (Vec3f{0, 0, 1}));
    EXPECT_TRUE(areKnown({{x, y, -x, -y}, {x + y, y - x, -x - y, x - y}, true}, 3));
    EXPECT_NEAR(Normalize(Cross(towardsEdge, towardsNextEdge)).z, 1, 1e-6f);
}

}  // namespace
}  // namespace cc::test
