// Per-target include guard, as Highway's foreach_target asks for.
#if defined(CC_TRACE_QUAD_WINDOW_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CC_TRACE_QUAD_WINDOW_INL_H
#undef CC_TRACE_QUAD_WINDOW_INL_H
#else
#define CC_TRACE_QUAD_WINDOW_INL_H
#endif

#include <algorithm>
#include <cmath>

#include <hwy/highway.h>

#include "core/trace/boxTests-inl.h"
#include "core/trace/limitGrid-inl.h"
#include "core/trace/objectRays.h"

HWY_BEFORE_NAMESPACE();
namespace cc {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Where one ray hits a grid first.
struct GridHit {
    float t;
    float u = 0, v = 0;  ///< in quads of the grid, along columns and rows
    int triangle = -1;   ///< two for each quad, row by row; -1 if nothing is hit
};

/// A ray as the quad test takes it. Coordinates are ordered so that the last is the one that the
/// ray is longest along.
struct ShearedRay {
    int axes[3];
    float origin[3];
    /// How far the ray goes along the first two axes per unit of the last, and its parameter.
    float shear[3];
    float tMin;

    ShearedRay(const ObjectRays& rays, int ray) {
        const float directions[3] = {rays.directionX[ray], rays.directionY[ray],
                                     rays.directionZ[ray]};
        const float origins[3] = {rays.originX[ray], rays.originY[ray], rays.originZ[ray]};
        const float inverses[3] = {rays.inverseX[ray], rays.inverseY[ray], rays.inverseZ[ray]};
        const float x = std::fabs(directions[0]), y = std::fabs(directions[1]),
                    z = std::fabs(directions[2]);
        const int longest = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
        for (int k = 0; k < 3; ++k) {
            axes[k] = (longest + 1 + k) % 3;
            origin[k] = origins[axes[k]];
        }
        shear[0] = directions[axes[0]] * inverses[longest];
        shear[1] = directions[axes[1]] * inverses[longest];
        shear[2] = inverses[longest];
        tMin = rays.tMin[ray];
    }
};

/// A window of some quads of a grid, a lane each, and one ray.
///
/// The test is that of Woop, Benthin and Wald 2013: points are sheared so that the ray becomes the
/// third axis, and edges are tested in the plane across it. Quads that share an edge shear the same
/// points to the same bits, and a product is never rounded past a larger one, so that every ray
/// that crosses the edge hits at least one of them.
class QuadWindow {
  public:
    static constexpr int kColumns = LimitGrid::kLeastColumns, kRows = LimitGrid::kLeastRows;

    /// @param column,row  of the window's first quad
    /// @param tolerance   how far apart neighbours may have the points that they share; mostly 0
    QuadWindow(const LimitGrid& grid, int column, int row, float tolerance, const ShearedRay& ray)
        : _side(grid.side), _column(column), _row(row), _tolerance(tolerance), _ray(ray) {
        for (int k = 0; k < 3; ++k) {
            _points[k] = &grid.points[ray.axes[k]][row][column];
        }
    }

    /// Takes the nearest hit that lies in [tMin, hit->t], if there is one. Of hits at the same
    /// distance it is that of the last triangle, whichever windows the grid is seen through.
    HWY_INLINE void Intersect(GridHit* hit) const {
        for (size_t lane = 0; lane < kQuads; lane += hn::Lanes(Tag())) {
            _IntersectVector(lane, hit);
        }
    }

  private:
    static constexpr int kQuads = kColumns * kRows;
    using Tag = hn::CappedTag<float, kQuads>;
    using V = hn::Vec<Tag>;

    /// The edges of the two triangles (0,1,2) and (0,2,3) of a quad.
    enum Edge { k01, k12, k20, k23, k30, kEdgeCount };

    /// A corner of each quad relative to the ray's origin, in the order of the ray's axes, and
    /// as it is seen along the ray.
    struct Corner {
        V x, y, z;
        V shearedX, shearedY;
    };

    /// @param offset  of the first quad's corner from that of the window
    HWY_INLINE V _Relative(int k, size_t offset) const {
        const Tag d;
        return hn::Sub(LoadFours(d, _points[k] + offset, LimitGrid::kStride),
                       hn::Set(d, _ray.origin[k]));
    }

    HWY_INLINE Corner _Corner(size_t offset) const {
        const Tag d;
        Corner corner;
        corner.x = _Relative(0, offset);
        corner.y = _Relative(1, offset);
        corner.z = _Relative(2, offset);
        corner.shearedX = hn::NegMulAdd(hn::Set(d, _ray.shear[0]), corner.z, corner.x);
        corner.shearedY = hn::NegMulAdd(hn::Set(d, _ray.shear[1]), corner.z, corner.y);
        return corner;
    }

    /// Positive if the ray passes the edge from a to b on its left. Exactly the negative for the
    /// edge from b to a: no fused multiply-add here.
    static HWY_INLINE V _Edge(const Corner& a, const Corner& b) {
        return hn::Sub(hn::Mul(a.shearedX, b.shearedY), hn::Mul(a.shearedY, b.shearedX));
    }

    HWY_INLINE void _IntersectVector(size_t lane, GridHit* best) const {
        constexpr size_t kRow = LimitGrid::kStride;
        const size_t first = lane / kColumns * kRow;
        const Corner c[4] = {_Corner(first), _Corner(first + 1), _Corner(first + kRow + 1),
                             _Corner(first + kRow)};
        const V edges[kEdgeCount] = {_Edge(c[0], c[1]), _Edge(c[1], c[2]), _Edge(c[2], c[0]),
                                     _Edge(c[2], c[3]), _Edge(c[3], c[0])};
        const V slack = _Slack(c[0], c[2]);
        const uint32_t lower = _Inside(edges[k12], edges[k20], edges[k01], slack);
        const uint32_t upper = _Inside(edges[k23], edges[k30], hn::Neg(edges[k20]), slack);
        if ((lower | upper) != 0) {
            _KeepNearest(lane, c, edges, slack, lower, upper, best);
        }
    }

    /// By how much an edge function may be off because points are.
    HWY_INLINE V _Slack(const Corner& a, const Corner& c) const {
        const Tag d;
        if (_tolerance == 0) {
            return hn::Zero(d);
        }
        const V x = hn::Sub(c.x, a.x), y = hn::Sub(c.y, a.y), z = hn::Sub(c.z, a.z);
        const V square = hn::MulAdd(x, x, hn::MulAdd(y, y, hn::Mul(z, z)));
        return hn::Mul(hn::Set(d, 4 * _tolerance), hn::Sqrt(square));
    }

    /// A bit for each lane where a ray passes all edges of a triangle on the same side.
    static HWY_INLINE uint32_t _Inside(V a, V b, V c, V slack) {
        const Tag d;
        const V least = hn::Min(hn::Min(a, b), c), most = hn::Max(hn::Max(a, b), c);
        return LaneBits(d, hn::Or(hn::Ge(least, hn::Neg(slack)), hn::Le(most, slack)));
    }

    /// Nearly always one triangle: what is left is not worth vectors.
    /// @param lower,upper  a bit for each lane whose triangle of corners 0, 1, 2 or 0, 2, 3 is hit
    HWY_NOINLINE void _KeepNearest(size_t firstLane, const Corner c[4], const V edges[kEdgeCount],
                                   V slack, uint32_t lower, uint32_t upper, GridHit* best) const {
        const Tag d;
        alignas(64) float functions[kEdgeCount][kQuads], slacks[kQuads];
        alignas(64) float depths[4][kQuads], x[4][kQuads], y[4][kQuads];
        for (int e = 0; e < kEdgeCount; ++e) {
            hn::Store(edges[e], d, functions[e]);
        }
        for (int i = 0; i < 4; ++i) {
            hn::Store(c[i].z, d, depths[i]);
            if (_tolerance > 0) {
                hn::Store(c[i].shearedX, d, x[i]);
                hn::Store(c[i].shearedY, d, y[i]);
            }
        }
        hn::Store(slack, d, slacks);
        for (uint32_t rest = lower; rest != 0; rest &= rest - 1) {
            const int i = __builtin_ctz(rest);
            float weights[3] = {functions[k12][i], functions[k20][i], functions[k01][i]};
            const float at[3] = {depths[0][i], depths[1][i], depths[2][i]};
            if (_tolerance > 0) {
                const Outline outline{{x[0][i], x[1][i], x[2][i]}, {y[0][i], y[1][i], y[2][i]}};
                if (!_BringInside(outline, slacks[i], weights)) {
                    continue;
                }
            }
            _Keep(firstLane + i, false, weights, at, best);
        }
        for (uint32_t rest = upper; rest != 0; rest &= rest - 1) {
            const int i = __builtin_ctz(rest);
            float weights[3] = {functions[k23][i], functions[k30][i], -functions[k20][i]};
            const float at[3] = {depths[0][i], depths[2][i], depths[3][i]};
            if (_tolerance > 0) {
                const Outline outline{{x[0][i], x[2][i], x[3][i]}, {y[0][i], y[2][i], y[3][i]}};
                if (!_BringInside(outline, slacks[i], weights)) {
                    continue;
                }
            }
            _Keep(firstLane + i, true, weights, at, best);
        }
    }

    /// Takes a hit on a triangle if it is nearer than the best so far.
    /// @param weights  the edge functions opposite to its corners: barycentric weights, times an
    ///                 area
    /// @param depths   of its corners along the ray's last axis
    HWY_INLINE void _Keep(size_t quad, bool isUpper, const float weights[3], const float depths[3],
                          GridHit* best) const {
        const float inverse = 1 / (weights[0] + weights[1] + weights[2]);
        const float height =
            weights[0] * depths[0] + weights[1] * depths[1] + weights[2] * depths[2];
        const float t = height * _ray.shear[2] * inverse;
        const int row = _row + static_cast<int>(quad) / kColumns;
        const int column = _column + static_cast<int>(quad) % kColumns;
        // A window may be larger than its grid: the points there are copies, near enough for slack.
        if (row >= _side || column >= _side) {
            return;
        }
        const int triangle = 2 * (row * _side + column) + static_cast<int>(isUpper);
        // Not so for a triangle without area, too: t is not a number then.
        const bool isNearer = t < best->t || (t == best->t && triangle > best->triangle);
        if (!(t >= _ray.tMin && isNearer)) {
            return;
        }
        const float weightB = _Clamp(weights[1] * inverse), weightC = _Clamp(weights[2] * inverse);
        const float both = _Clamp(weightB + weightC);
        best->t = t;
        best->u = static_cast<float>(column) + (isUpper ? weightB : both);
        best->v = static_cast<float>(row) + (isUpper ? both : weightC);
        best->triangle = triangle;
    }

    /// A triangle as it is seen along the ray, which is at the origin.
    struct Outline {
        float x[3], y[3];
    };

    /// Moves a hit that is outside by no more than the slack into the triangle. Returns false if
    /// the triangle is not there after all.
    bool _BringInside(const Outline& outline, float slack, float weights[3]) const {
        const float sign = weights[0] + weights[1] + weights[2] < 0 ? -1.0f : 1.0f;
        float most = 0;
        for (int i = 0; i < 3; ++i) {
            most = std::max(most, std::fabs(weights[i]));
            weights[i] = std::max(weights[i] * sign, 0.0f);
        }
        return most > slack || _BringToOutline(outline, weights);
    }

    /// A triangle thinner than the slack says nothing by its edge functions, which are small far
    /// along its edges too: a ray hits it where its outline is no further than points may be off.
    bool _BringToOutline(const Outline& outline, float weights[3]) const {
        const float reach = 4 * _tolerance;
        float nearest = reach * reach;
        bool isFound = false;
        for (int a = 0; a < 3; ++a) {
            const int b = (a + 1) % 3;
            const float x = outline.x[b] - outline.x[a], y = outline.y[b] - outline.y[a];
            const float square = x * x + y * y;
            const float along = -(outline.x[a] * x + outline.y[a] * y);
            const float part = square > 0 ? _Clamp(along / square) : 0;
            const float offX = outline.x[a] + part * x, offY = outline.y[a] + part * y;
            const float off = offX * offX + offY * offY;
            if (off <= nearest) {
                nearest = off;
                isFound = true;
                weights[a] = 1 - part;
                weights[b] = part;
                weights[3 - a - b] = 0;
            }
        }
        return isFound;
    }

    static float _Clamp(float x) { return x > 0 ? (x < 1 ? x : 1) : 0; }

    const float* _points[3];  ///< of the window's first corner, in the order of the ray's axes
    const int _side, _column, _row;
    const float _tolerance;
    const ShearedRay& _ray;
};

}  // namespace HWY_NAMESPACE
}  // namespace cc
HWY_AFTER_NAMESPACE();

#endif
