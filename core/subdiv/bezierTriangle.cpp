#include "core/subdiv/bezierTriangle.h"

#include <cassert>

namespace cc {
namespace {

constexpr int kDegree = 4;

/// Powers of the three barycentric coordinates in the Bernstein polynomial of a point.
constexpr int kPowers[BezierTriangle::kPointCount][3] = {
    {4, 0, 0}, {0, 4, 0}, {0, 0, 4},                                   // corners
    {3, 1, 0}, {1, 3, 0}, {0, 3, 1}, {0, 1, 3}, {1, 0, 3}, {3, 0, 1},  // near them, by edges
    {2, 2, 0}, {0, 2, 2}, {2, 0, 2},                                   // middles of edges
    {2, 1, 1}, {1, 2, 1}, {1, 1, 2},                                   // inside
};

/// A polynomial in barycentric coordinates, homogeneous of a degree up to 4: coefficients by the
/// powers of the second and third.
struct Polynomial {
    double c[kDegree + 1][kDegree + 1] = {};

    double Of(const int powers[3]) const { return c[powers[1]][powers[2]]; }
};

/// Multiplies by x0 a + x1 b + x2 c, (a, b, c) being the coordinates of u, v.
Polynomial Times(const Polynomial& p, float u, float v) {
    const double a = 1.0 - u - v;
    Polynomial product;
    for (int j = 0; j <= kDegree; ++j) {
        for (int k = 0; j + k <= kDegree; ++k) {
            product.c[j][k] =
                a * p.c[j][k] + (j > 0 ? u * p.c[j - 1][k] : 0) + (k > 0 ? v * p.c[j][k - 1] : 0);
        }
    }
    return product;
}

BezierTriangleWeights ToWeights(const Polynomial& p) {
    BezierTriangleWeights weights{};
    for (int i = 0; i < BezierTriangle::kPointCount; ++i) {
        weights[i] = static_cast<float>(p.Of(kPowers[i]));
    }
    return weights;
}

Vec3f Sum(const Vec3f points[BezierTriangle::kPointCount], const BezierTriangleWeights& weights) {
    Vec3f sum;
    for (int i = 0; i < BezierTriangle::kPointCount; ++i) {
        sum += points[i] * weights[i];
    }
    return sum;
}

Polynomial PowerOf(float u, float v, int power) {
    Polynomial p;
    p.c[0][0] = 1;
    for (int i = 0; i < power; ++i) {
        p = Times(p, u, v);
    }
    return p;
}

/// Weights of the derivative along an axis of the parameters, 1 being u and 2 being v: four times
/// the cubic of the differences.
BezierTriangleWeights DerivativeWeights(float u, float v, int axis) {
    const Polynomial cubic = PowerOf(u, v, kDegree - 1);
    BezierTriangleWeights weights{};
    for (int i = 0; i < BezierTriangle::kPointCount; ++i) {
        int less[3] = {kPowers[i][0], kPowers[i][1], kPowers[i][2]};
        double weight = 0;
        if (--less[axis] >= 0) {
            weight += cubic.Of(less);
        }
        ++less[axis];
        if (--less[0] >= 0) {
            weight -= cubic.Of(less);
        }
        weights[i] = static_cast<float>(kDegree * weight);
    }
    return weights;
}

/// The sum of the six neighbours of a vertex, in doubles: patches that share it count from
/// different neighbours on and still get the same.
Vec3f SumOfNeighbors(const Vec3f* const n[6]) {
    Vec3f sum;
    for (int axis = 0; axis < 3; ++axis) {
        double total = 0;
        for (int i = 0; i < 6; ++i) {
            total += (*n[i])[axis];
        }
        sum[axis] = static_cast<float>(total);
    }
    return sum;
}

}  // namespace

BezierTriangle BezierTriangle::FromBoxSpline(const Vec3f s[12]) {
    BezierTriangle patch;
    for (int i = 0; i < 3; ++i) {
        const int next = (i + 1) % 3, last = (i + 2) % 3;
        const Vec3f &a = s[i], &b = s[next], &c = s[last];
        // Beyond the edge from a to b; around a and around b, the points that complete the hexagon.
        const Vec3f &beyond = s[5 + 3 * i], &beforeEdge = s[5 + 3 * last],
                    &afterEdge = s[5 + 3 * next], &aNear = s[4 + 3 * i], &bNear = s[3 + 3 * next];
        const Vec3f* const around[6] = {&b, &c, &beforeEdge, &s[3 + 3 * i], &aNear, &beyond};
        patch.points[i] = (a * 6 + SumOfNeighbors(around)) * (1 / 12.0f);
        // Sums that run alike from both ends, and from both sides, of an edge.
        const Vec3f sides = c + beyond;
        patch.points[3 + 2 * i] =
            ((a * 12 + b * 4) + (sides * 3 + (beforeEdge + aNear))) * (1 / 24.0f);
        patch.points[4 + 2 * i] =
            ((b * 12 + a * 4) + (sides * 3 + (afterEdge + bNear))) * (1 / 24.0f);
        patch.points[9 + i] = ((a + b) * 8 + sides * 4) * (1 / 24.0f);
        patch.points[12 + i] = (a * 10 + (b + c) * 6 + (beyond + beforeEdge)) * (1 / 24.0f);
    }
    return patch;
}

Vec3f BezierTriangle::Position(float u, float v) const {
    return Sum(points, PositionWeights(u, v));
}

Vec3f BezierTriangle::DerivativeU(float u, float v) const {
    return Sum(points, DerivativeWeights(u, v, 1));
}

Vec3f BezierTriangle::DerivativeV(float u, float v) const {
    return Sum(points, DerivativeWeights(u, v, 2));
}

Box3f BezierTriangle::SplitBounds() const {
    static const std::array<std::array<BezierTriangleWeights, kPointCount>, 4> kWeights = [] {
        std::array<std::array<BezierTriangleWeights, kPointCount>, 4> weights;
        for (int part = 0; part < 4; ++part) {
            for (int i = 0; i < kPointCount; ++i) {
                weights[part][i] = SubTriangleWeights(SubTriangle().Split(part), i);
            }
        }
        return weights;
    }();
    Box3f box;
    for (const auto& part : kWeights) {
        for (const BezierTriangleWeights& weights : part) {
            box.Extend(Sum(points, weights));
        }
    }
    return box;
}

BezierTriangleWeights SubTriangleWeights(const SubTriangle& part, int i) {
    const float corners[3][2] = {
        {part.u, part.v}, {part.u + part.size, part.v}, {part.u, part.v + part.size}};
    Polynomial p;
    p.c[0][0] = 1;
    for (int corner = 0; corner < 3; ++corner) {
        for (int n = 0; n < kPowers[i][corner]; ++n) {
            p = Times(p, corners[corner][0], corners[corner][1]);
        }
    }
    return ToWeights(p);
}

BezierTriangleWeights PositionWeights(float u, float v) {
    return ToWeights(PowerOf(u, v, kDegree));
}

BezierTriangle GatherBezierTriangle(const PatchTable& patches, uint32_t patch,
                                    const Vec3f* values) {
    assert(patches.At(patch).kind == PatchKind::RegularTriangle);
    const uint32_t* indices = patches.Indices(patch);
    Vec3f points[12];
    for (int i = 0; i < 12; ++i) {
        points[i] = values[indices[i]];
    }
    return BezierTriangle::FromBoxSpline(points);
}

}  // namespace cc
