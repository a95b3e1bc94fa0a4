#include "core/subdiv/loopCorner.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "core/subdiv/limitPoint.h"
#include "core/subdiv/patchBuilder.h"
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

/// A sharp corner of Loop's scheme as vertex 0 of a fan whose other vertices are anywhere.
struct SharpCorner {
    int faceCount;
    bool isClosed;
    bool hasSharpEdge = false;  ///< that to vertex 1, where the fan is closed

    int EdgeCount() const { return faceCount + !isClosed; }

    Cage ToCage(unsigned seed) const {
        std::mt19937 random(seed);
        std::uniform_real_distribution<float> unit(-1, 1);
        Cage cage;
        cage.mesh.scheme = Scheme::Loop;
        for (int i = 0; i <= EdgeCount(); ++i) {
            cage.points.push_back({unit(random), unit(random), unit(random)});
        }
        for (int j = 0; j < faceCount; ++j) {
            cage.mesh.faceVertexCounts.push_back(3);
            for (int vertex : {0, 1 + j, 1 + (j + 1) % EdgeCount()}) {
                cage.mesh.faceVertexIndices.push_back(vertex);
            }
        }
        cage.mesh.cornerIndices = {0};
        cage.mesh.cornerSharpnesses = {10};
        if (hasSharpEdge) {
            cage.mesh.creaseIndices = {0, 1};
            cage.mesh.creaseLengths = {2};
            cage.mesh.creaseSharpnesses = {10};
        }
        return cage;
    }

    /// What a step makes of the edges (Loop 1987, Hoppe et al. 1994).
    Matrix Step() const {
        const int n = EdgeCount();
        Matrix step(n, std::vector<double>(n));
        for (int i = 0; i < n; ++i) {
            const bool isSharp = (!isClosed && (i == 0 || i == n - 1)) || (hasSharpEdge && i == 0);
            step[i][i] = isSharp ? 0.5 : 0.375;
            step[i][(i + 1) % n] += isSharp ? 0 : 0.125;
            step[i][(i + n - 1) % n] += isSharp ? 0 : 0.125;
        }
        return step;
    }

    /// Two different edges.
    using Pair = std::array<int, 2>;
    std::vector<Pair> Pairs() const {
        std::vector<Pair> pairs;
        for (int i = 0; i < EdgeCount(); ++i) {
            for (int j = i + 1; j < EdgeCount(); ++j) {
                pairs.push_back({i, j});
            }
        }
        return pairs;
    }

    /// What 2^doublings steps make of the cross products of pairs, up to a factor. They are refined
    /// in place of the edges, which become too alike for a product to tell them apart.
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
        const int next = (face + 1) % EdgeCount();
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
};

/// @param doublings  of steps: what is left after n is 1/n in resonance, else a power of n
void ExpectNormalsOfRefinement(const SharpCorner& corner, int doublings) {
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

TEST(LoopCorner, NormalsAreThoseOfRefinement) {
    for (int faceCount : {1, 2, 3, 4, 5, 6}) {
        ExpectNormalsOfRefinement({faceCount, false}, 22);
    }
    for (int faceCount : {7, 8, 9, 12}) {
        ExpectNormalsOfRefinement({faceCount, false}, 10);
    }
    for (int faceCount : {3, 4, 5, 6, 7, 12}) {
        ExpectNormalsOfRefinement({faceCount, true}, 8);
    }
    for (int faceCount : {4, 7, 8, 12}) {
        ExpectNormalsOfRefinement({faceCount, true, true}, 11);
    }
}

TEST(LoopCorner, OfTwoOrThreeFacesHasThePlaneOfItsEnds) {
    const Vec3f first = {1, 0, 0}, last = {0, 2, 0}, anything = {0.3f, 0.4f, 5};
    for (const CornerEdges& edges :
         {CornerEdges{first, anything, last}, CornerEdges{first, anything, -anything, last}}) {
        for (int face = 0; face + 1 < static_cast<int>(edges.size()); ++face) {
            Vec3f towardsEdge, towardsNextEdge;
            ASSERT_TRUE(LoopCornerTangents(edges, false, face, &towardsEdge, &towardsNextEdge));
            const Vec3f normal = Normalize(Cross(towardsEdge, towardsNextEdge));
            EXPECT_EQ(normal, (Vec3f{0, 0, 1})) << face;
        }
    }
}

/// No mask is known there, and the evaluation refines.
TEST(LoopCorner, OnAStraightBoundaryHasThePlaneOfItsFaces) {
    for (int faceCount : {2, 3}) {
        Cage cage = SharpCorner{faceCount, false}.ToCage(0);
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

TEST(LoopCorner, HasNoTangentsWhereItsEdgesAreParallel) {
    Vec3f towardsEdge, towardsNextEdge;
    const Vec3f x = {1, 0, 0}, y = {0, 1, 0};
    EXPECT_FALSE(LoopCornerTangents({x, y, -x}, false, 0, &towardsEdge, &towardsNextEdge));
    EXPECT_FALSE(LoopCornerTangents({x, x, x, x}, false, 1, &towardsEdge, &towardsNextEdge));
    EXPECT_FALSE(LoopCornerTangents({x, x, x, x, x}, false, 2, &towardsEdge, &towardsNextEdge));
    EXPECT_FALSE(LoopCornerTangents({x, x, x}, true, 2, &towardsEdge, &towardsNextEdge));
    EXPECT_FALSE(LoopCornerTangents({{}, {}, {}}, true, 0, &towardsEdge, &towardsNextEdge));
    // Flat, and around the corner: no spike.
    EXPECT_TRUE(LoopCornerTangents({x, y, -x, -y}, true, 3, &towardsEdge, &towardsNextEdge));
    EXPECT_EQ(Normalize(Cross(towardsEdge, towardsNextEdge)), (Vec3f{0, 0, 1}));
}

}  // namespace
}  // namespace cc::test
