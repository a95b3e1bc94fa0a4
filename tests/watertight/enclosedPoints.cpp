#include "tests/watertight/enclosedPoints.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/subdiv/limitPoint.h"
#include "core/trace/gridStitch.h"

namespace cc::test {
namespace {

constexpr double kFullSphere = 12.566370614359173;

using Vector = std::array<double, 3>;

double Dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vector Cross(const Vector& a, const Vector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// The solid angle of a triangle as seen from the origin (van Oosterom and Strackee 1983).
double SolidAngle(const Vector& a, const Vector& b, const Vector& c) {
    const double la = std::sqrt(Dot(a, a)), lb = std::sqrt(Dot(b, b)), lc = std::sqrt(Dot(c, c));
    const double below = la * lb * lc + Dot(a, b) * lc + Dot(b, c) * la + Dot(c, a) * lb;
    return 2 * std::atan2(Dot(a, Cross(b, c)), below);
}

/// A patch's limit points relative to a point, at parameters i / n.
class RelativeGrid {
  public:
    RelativeGrid(const Surface& surface, uint32_t patch, int n, const Vec3f& origin)
        : _n(n), _points((n + 1) * (n + 1)) {
        const bool isTriangle = surface.Patches().IsTriangle(patch);
        for (int i = 0; i <= n; ++i) {
            for (int j = 0; j <= (isTriangle ? n - i : n); ++j) {
                const float scale = 1 / static_cast<float>(n);
                const Vec3f p =
                    EvaluateLimit(surface.Patches(), patch, surface.PatchPoints().data(),
                                  scale * static_cast<float>(j), scale * static_cast<float>(i))
                        .position;
                for (int axis = 0; axis < 3; ++axis) {
                    _points[i * (n + 1) + j][axis] = double(p[axis]) - origin[axis];
                }
            }
        }
    }
    const Vector& At(int i, int j) const { return _points[i * (_n + 1) + j]; }

  private:
    const int _n;
    std::vector<Vector> _points;
};

double SolidAngleOfTriangularPatch(const RelativeGrid& grid, int n) {
    double sum = 0;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n - i; ++j) {
            const Vector &b = grid.At(i, j + 1), &d = grid.At(i + 1, j);
            sum += SolidAngle(grid.At(i, j), b, d);
            if (i + j + 1 < n) {
                sum += SolidAngle(b, grid.At(i + 1, j + 1), d);
            }
        }
    }
    return sum;
}

double SolidAngleOfPatch(const Surface& surface, uint32_t patch, const PatchLevels& levels,
                         const Vec3f& origin) {
    const int n = 1 << (levels.Finest() - surface.Patches().At(patch).depth);
    const RelativeGrid grid(surface, patch, n, origin);
    if (surface.Patches().IsTriangle(patch)) {
        return SolidAngleOfTriangularPatch(grid, n);
    }
    const GridStitch stitch(levels, {0, 0, 1}, n, false);
    const auto at = [&](int row, int column) {
        stitch.Move(&column, &row);
        return grid.At(row, column);
    };
    double sum = 0;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            // Cut as tracers cut quads.
            const Vector a = at(i, j), c = at(i + 1, j + 1);
            sum += SolidAngle(a, at(i, j + 1), c) + SolidAngle(a, c, at(i + 1, j));
        }
    }
    return sum;
}

}  // namespace

double WindingNumber(const Surface& surface, const InstanceLevels& levels, const Vec3f& point) {
    double sum = 0;
    for (uint32_t patch = 0; patch < surface.Patches().Count(); ++patch) {
        sum += SolidAngleOfPatch(surface, patch, levels.Of(patch), point);
    }
    return sum / kFullSphere;
}

bool IsEnclosed(const Surface& surface, const InstanceLevels& levels, const Vec3f& point,
                float rounding) {
    for (int i = 0; i < 6; ++i) {
        Vec3f beside = point;
        beside[i / 2] += i % 2 == 0 ? rounding : -rounding;
        if (std::fabs(WindingNumber(surface, levels, beside)) < 0.9) {
            return false;
        }
    }
    return true;
}

std::vector<Vec3f> EnclosedPoints(const Surface& surface, const InstanceLevels& levels, size_t most,
                                  std::mt19937* random) {
    constexpr int kTries = 12;
    std::vector<Vec3f> found;
    std::uniform_int_distribution<uint32_t> anyPatch(
        0, static_cast<uint32_t>(surface.Patches().Count()) - 1);
    std::uniform_real_distribution<float> unit(0.1f, 0.4f), depth(0.03f, 0.2f);
    const float diagonal = surface.Bounds().Diagonal();
    for (int i = 0; i < kTries && found.size() < most; ++i) {
        const LimitPoint at =
            EvaluateLimit(surface.Patches(), anyPatch(*random), surface.PatchPoints().data(),
                          unit(*random), unit(*random));
        for (const float side : {-1.0f, 1.0f}) {
            const Vec3f point = at.position + at.normal * (side * depth(*random) * diagonal);
            if (std::fabs(WindingNumber(surface, levels, point)) > 0.9) {
                found.push_back(point);
                break;
            }
        }
    }
    return found;
}

}  // namespace cc::test
