// Per-target include guard, as Highway's foreach_target asks for.
#if defined(CC_TRACE_GRID_INTERSECTION_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CC_TRACE_GRID_INTERSECTION_INL_H
#undef CC_TRACE_GRID_INTERSECTION_INL_H
#else
#define CC_TRACE_GRID_INTERSECTION_INL_H
#endif

#include <algorithm>
#include <cmath>

#include <hwy/highway.h>

#include "core/trace/limitGrid-inl.h"
#include "core/trace/objectRays.h"

HWY_BEFORE_NAMESPACE();
namespace cc {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Where one ray hits a block first.
struct BlockHit {
    float t = 0;
    float u = 0, v = 0;  ///< in quads of the grid, along columns and rows
};

/// The quads of a block, a lane each, for rays whose direction is longest along one axis.
///
/// The test is that of Woop, Benthin and Wald 2013: points are sheared so that the ray becomes the
/// third axis, and edges are tested in the plane across it. Quads that share an edge shear the same
/// points to the same bits, and a product is never rounded past a larger one, so that every ray
/// that crosses the edge hits at least one of them.
class QuadBlock {
  public:
    /// @param axis   the axis that rays are longest along
    /// @param tolerance  how far apart neighbours may have the points that they share; mostly 0
    /// @param origin     of all rays, or null if they have several
    QuadBlock(const LimitGrid& grid, int block, int axis, float tolerance, const Vec3f* origin) {
        const int blocks = grid.BlocksAlongSide();
        _row = kBlockSide * (block / blocks);
        _column = kBlockSide * (block % blocks);
        const int axes[3] = {(axis + 1) % 3, (axis + 2) % 3, axis};
        for (int k = 0; k < 3; ++k) {
            _Gather(grid, axes[k], origin ? (*origin)[axes[k]] : 0, k);
        }
        std::fill(_slack, _slack + kQuads, 0.0f);
        for (int quad = 0; quad < kQuads && tolerance > 0; ++quad) {
            _slack[quad] = 4 * tolerance * _Diagonal(quad);
        }
    }

    /// Finds the nearest hit of a ray in [tMin, tMax]. Returns false if there is none.
    /// @tparam kIsPinhole  all rays have the origin that the block was made for
    /// @param origin  along the axes after the longest one, then along that
    /// @param shear   how far the ray goes along the other two axes per unit of the longest, and
    /// its
    ///                parameter per unit
    template <bool kIsPinhole>
    HWY_INLINE bool Intersect(const float origin[3], const float shear[3], float tMin, float tMax,
                              BlockHit* hit) const {
        bool isHit = false;
        hit->t = tMax;
        for (size_t lane = 0; lane < kQuads; lane += hn::Lanes(Tag())) {
            isHit |= _IntersectVector<kIsPinhole>(origin, shear, tMin, lane, hit);
        }
        return isHit;
    }

  private:
    using Tag = hn::CappedTag<float, 16>;
    using V = hn::Vec<Tag>;
    static constexpr int kQuads = kBlockSide * kBlockSide;

    /// The edges of the two triangles (0,1,2) and (0,2,3) of a quad.
    enum Edge { k01, k12, k20, k23, k30, kEdgeCount };

    /// Corners of all quads along one axis. Lanes beyond a small grid get quads without area.
    void _Gather(const LimitGrid& grid, int axis, float origin, int k) {
        if (grid.side < kBlockSide) {
            _GatherSmall(grid, axis, origin, k);
            return;
        }
        constexpr size_t kStride = LimitGrid::kStride;
        const Tag d;
        const V from = hn::Set(d, origin);
        for (size_t lane = 0; lane < kQuads; lane += hn::Lanes(d)) {
            const float* lower = grid.points[axis][_row + lane / kBlockSide] + _column;
            const float* upper = lower + kStride;
            const float* const first[4] = {lower, lower + 1, upper + 1, upper};
            for (int c = 0; c < 4; ++c) {
                hn::Store(hn::Sub(LoadFours(d, first[c], kStride), from), d, _corners[c][k] + lane);
            }
        }
    }

    void _GatherSmall(const LimitGrid& grid, int axis, float origin, int k) {
        const auto& points = grid.points[axis];
        for (int quad = 0; quad < kQuads; ++quad) {
            const int r0 = std::min(quad / kBlockSide, grid.side);
            const int r1 = std::min(r0 + 1, grid.side);
            const int c0 = std::min(quad % kBlockSide, grid.side);
            const int c1 = std::min(c0 + 1, grid.side);
            _corners[0][k][quad] = points[r0][c0] - origin;
            _corners[1][k][quad] = points[r0][c1] - origin;
            _corners[2][k][quad] = points[r1][c1] - origin;
            _corners[3][k][quad] = points[r1][c0] - origin;
        }
    }

    /// A coordinate of corners relative to a ray's origin.
    template <bool kIsPinhole>
    HWY_INLINE V _SeenFrom(int corner, int k, size_t lane, const float origin[3]) const {
        const Tag d;
        const V at = hn::Load(d, _corners[corner][k] + lane);
        return kIsPinhole ? at : hn::Sub(at, hn::Set(d, origin[k]));
    }

    /// A corner seen along the ray.
    struct Sheared {
        V x, y;
    };

    /// Positive if the ray passes the edge from a to b on its left. Exactly the negative for the
    /// edge from b to a: no fused multiply-add here.
    static HWY_INLINE V _Edge(const Sheared& a, const Sheared& b) {
        return hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x));
    }

    template <bool kIsPinhole>
    HWY_INLINE bool _IntersectVector(const float origin[3], const float shear[3], float tMin,
                                     size_t lane, BlockHit* best) const {
        const Tag d;
        Sheared corner[4];
        for (int c = 0; c < 4; ++c) {
            const V z = _SeenFrom<kIsPinhole>(c, 2, lane, origin);
            corner[c].x =
                hn::NegMulAdd(hn::Set(d, shear[0]), z, _SeenFrom<kIsPinhole>(c, 0, lane, origin));
            corner[c].y =
                hn::NegMulAdd(hn::Set(d, shear[1]), z, _SeenFrom<kIsPinhole>(c, 1, lane, origin));
        }
        const V edges[kEdgeCount] = {_Edge(corner[0], corner[1]), _Edge(corner[1], corner[2]),
                                     _Edge(corner[2], corner[0]), _Edge(corner[2], corner[3]),
                                     _Edge(corner[3], corner[0])};
        const V slack = hn::Load(d, _slack + lane);
        const uint32_t lower = _Inside(edges[k12], edges[k20], edges[k01], slack);
        const uint32_t upper = _Inside(edges[k23], edges[k30], hn::Neg(edges[k20]), slack);
        if ((lower | upper) == 0) {
            return false;
        }
        // Nearly always one quad: the rest is not worth vectors.
        alignas(64) float lanes[kEdgeCount][kQuads];
        for (int e = 0; e < kEdgeCount; ++e) {
            hn::Store(edges[e], d, lanes[e]);
        }
        bool isHit = false;
        for (uint32_t rest = lower; rest != 0; rest &= rest - 1) {
            const int i = __builtin_ctz(rest);
            float weights[3] = {lanes[k12][i], lanes[k20][i], lanes[k01][i]};
            isHit |= _KeepNearest(weights, lane + i, 1, 2, kIsPinhole ? 0 : origin[2], shear[2],
                                  tMin, best);
        }
        for (uint32_t rest = upper; rest != 0; rest &= rest - 1) {
            const int i = __builtin_ctz(rest);
            float weights[3] = {lanes[k23][i], lanes[k30][i], -lanes[k20][i]};
            isHit |= _KeepNearest(weights, lane + i, 2, 3, kIsPinhole ? 0 : origin[2], shear[2],
                                  tMin, best);
        }
        return isHit;
    }

    /// A bit for each lane where a ray passes all edges of a triangle on the same side.
    static HWY_INLINE uint32_t _Inside(V a, V b, V c, V slack) {
        const Tag d;
        const V least = hn::Min(hn::Min(a, b), c), most = hn::Max(hn::Max(a, b), c);
        return MaskBits(d, hn::Or(hn::Ge(least, hn::Neg(slack)), hn::Le(most, slack)));
    }

    /// Takes a hit on a triangle if it is nearer than the best so far.
    /// @param weights  the edge functions opposite to corner 0 and corners b and c of the quad:
    ///                 barycentric weights, times an area
    HWY_INLINE bool _KeepNearest(float weights[3], size_t quad, int b, int c, float origin,
                                 float scale, float tMin, BlockHit* best) const {
        if (_slack[quad] > 0 && !_BringInside(weights, _slack[quad])) {
            return false;
        }
        const float inverse = 1 / (weights[0] + weights[1] + weights[2]);
        const float height = weights[0] * (_corners[0][2][quad] - origin) +
                             weights[1] * (_corners[b][2][quad] - origin) +
                             weights[2] * (_corners[c][2][quad] - origin);
        const float t = height * scale * inverse;
        // False for a triangle without area, too: t is not a number then.
        if (!(t >= tMin && t <= best->t)) {
            return false;
        }
        const float weightB = _Clamp(weights[1] * inverse), weightC = _Clamp(weights[2] * inverse);
        const float both = _Clamp(weightB + weightC);
        const int row = _row + static_cast<int>(quad) / kBlockSide;
        const int column = _column + static_cast<int>(quad) % kBlockSide;
        const bool isLower = b == 1;
        best->t = t;
        best->u = static_cast<float>(column) + (isLower ? both : weightB);
        best->v = static_cast<float>(row) + (isLower ? weightC : both);
        return true;
    }

    /// Moves a hit that is outside by no more than the slack into the triangle. Returns false for a
    /// triangle thinner than the slack, which has no plane worth the name; its neighbours have the
    /// ray.
    static bool _BringInside(float weights[3], float slack) {
        const float sign = weights[0] + weights[1] + weights[2] < 0 ? -1.0f : 1.0f;
        float most = 0;
        for (int i = 0; i < 3; ++i) {
            most = std::max(most, std::fabs(weights[i]));
            weights[i] = std::max(weights[i] * sign, 0.0f);
        }
        return most > slack;
    }

    float _Diagonal(int quad) const {
        float square = 0;
        for (int k = 0; k < 3; ++k) {
            const float along = _corners[2][k][quad] - _corners[0][k][quad];
            square += along * along;
        }
        return std::sqrt(square);
    }

    static float _Clamp(float x) { return x > 0 ? (x < 1 ? x : 1) : 0; }

    alignas(64) float _corners[4][3][kQuads];
    int _row, _column;
    alignas(64) float _slack[kQuads];
};

}  // namespace HWY_NAMESPACE
}  // namespace cc
HWY_AFTER_NAMESPACE();

#endif
