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

Vector From(const Vec3f& origin, const Vec3f& p) {
    return {double(p.x) - origin.x, double(p.y) - origin.y, double(p.z) - origin.z};
}

}  // namespace

/// The limit points of a patch at parameters i / n, and how they are stitched.
class CutSurface::Patch {
  public:
    Patch(const Surface& surface, uint32_t patch, const PatchLevels& levels)
        : _isTriangle(surface.Patches().IsTriangle(patch)),
          _n(1 << (levels.Finest() - surface.Patches().At(patch).depth)),
          _points((_n + 1) * (_n + 1)) {
        for (int i = 0; i <= _n; ++i) {
            for (int j = 0; j <= (_isTriangle ? _n - i : _n); ++j) {
                const float scale = 1 / static_cast<float>(_n);
                _points[i * (_n + 1) + j] =
                    EvaluateLimit(surface.Patches(), patch, surface.PatchPoints().data(),
                                  scale * static_cast<float>(j), scale * static_cast<float>(i))
                        .position;
            }
        }
        if (!_isTriangle) {
            _Stitch(levels);
        }
    }

    double SolidAngleFrom(const Vec3f& origin) const {
        return _isTriangle ? _OfTriangle(origin) : _OfQuad(origin);
    }

  private:
    void _Stitch(const PatchLevels& levels) {
        const GridStitch stitch(levels, {0, 0, 1}, _n, false);
        const std::vector<Vec3f> points = _points;
        for (int i = 0; i <= _n; ++i) {
            for (int j = 0; j <= _n; ++j) {
                int row = i, column = j;
                stitch.Move(&column, &row);
                _points[i * (_n + 1) + j] = points[row * (_n + 1) + column];
            }
        }
    }

    double _OfTriangle(const Vec3f& origin) const {
        double sum = 0;
        for (int i = 0; i < _n; ++i) {
            for (int j = 0; j < _n - i; ++j) {
                const Vector b = _At(origin, i, j + 1), d = _At(origin, i + 1, j);
                sum += SolidAngle(_At(origin, i, j), b, d);
                if (i + j + 1 < _n) {
                    sum += SolidAngle(b, _At(origin, i + 1, j + 1), d);
                }
            }
        }
        return sum;
    }

    double _OfQuad(const Vec3f& origin) const {
        double sum = 0;
        for (int i = 0; i < _n; ++i) {
            for (int j = 0; j < _n; ++j) {
                // Cut as tracers cut quads.
                const Vector a = _At(origin, i, j), c = _At(origin, i + 1, j + 1);
                sum += SolidAngle(a, _At(origin, i, j + 1), c) +
                       SolidAngle(a, c, _At(origin, i + 1, j));
            }
        }
        return sum;
    }

    Vector _At(const Vec3f& origin, int i, int j) const {
        return From(origin, _points[i * (_n + 1) + j]);
    }

    const bool _isTriangle;
    const int _n;
    std::vector<Vec3f> _points;
};

CutSurface::CutSurface(const Surface& surface, const InstanceLevels& levels) {
    for (uint32_t patch = 0; patch < surface.Patches().Count(); ++patch) {
        _patches.push_back(std::make_shared<Patch>(surface, patch, levels.Of(patch)));
    }
}

double CutSurface::WindingNumber(const Vec3f& point) const {
    double sum = 0;
    for (const auto& patch : _patches) {
        sum += patch->SolidAngleFrom(point);
    }
    return sum / kFullSphere;
}

bool CutSurface::Encloses(const Vec3f& point, float rounding) const {
    for (int i = 0; i < 6; ++i) {
        Vec3f beside = point;
        beside[i / 2] += i % 2 == 0 ? rounding : -rounding;
        if (std::fabs(WindingNumber(beside)) < 0.9) {
            return false;
        }
    }
    return true;
}

std::vector<Vec3f> EnclosedPoints(const Surface& surface, const InstanceLevels& levels, size_t most,
                                  std::mt19937* random) {
    constexpr int kTries = 12;
    const CutSurface cut(surface, levels);
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
            if (std::fabs(cut.WindingNumber(point)) > 0.9) {
                found.push_back(point);
                break;
            }
        }
    }
    return found;
}

}  // namespace cc::test
