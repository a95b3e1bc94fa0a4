// Per-target include guard, as Highway's foreach_target asks for.
#if defined(CC_TRACE_QUAD_BLOCK_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CC_TRACE_QUAD_BLOCK_INL_H
#undef CC_TRACE_QUAD_BLOCK_INL_H
#else
#define CC_TRACE_QUAD_BLOCK_INL_H
#endif

#include <hwy/highway.h>

#include "core/trace/bezierRows-inl.h"
#include "core/trace/objectRays.h"

HWY_BEFORE_NAMESPACE();
namespace cc {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Quads a side of a block, and splits that make as many.
constexpr int kBlockSide = 4;
constexpr int kBlockSplits = 2;

/// Where one ray hits a block first.
struct BlockHit {
    bool isHit = false;
    float t = 0;
    float u = 0, v = 0;  ///< in the block, 0..1 along columns and rows of its Bezier patch
};

/// The last two levels of a patch at once: 5x5 points of the limit surface, evaluated directly, and
/// the 4x4 quads between them, laid out so that one ray meets a vector of quads.
class QuadBlock {
  public:
    explicit QuadBlock(const BezierRows& patch) {
        float grid[3][kBlockSide + 1][8];
        _Evaluate(patch, grid);
        for (int axis = 0; axis < 3; ++axis) {
            for (int row = 0; row < kBlockSide; ++row) {
                for (int column = 0; column < kBlockSide; ++column) {
                    const int quad = kBlockSide * row + column;
                    _corners[0][axis][quad] = grid[axis][row][column];
                    _corners[1][axis][quad] = grid[axis][row][column + 1];
                    _corners[2][axis][quad] = grid[axis][row + 1][column + 1];
                    _corners[3][axis][quad] = grid[axis][row + 1][column];
                }
            }
        }
    }

    /// Intersects a ray with all quads.
    /// @param tolerance  how far apart neighbouring patches may compute the same point
    BlockHit Intersect(const ObjectRays& rays, int ray, float tolerance) {
        _SeeFrom(rays.originX[ray], rays.originY[ray], rays.originZ[ray]);
        BlockHit best;
        best.t = rays.tMax[ray];
        for (size_t lane = 0; lane < kQuads; lane += hn::Lanes(Tag())) {
            _IntersectVector(rays, ray, tolerance, lane, &best);
        }
        return best;
    }

  private:
    using Tag = hn::CappedTag<float, 16>;
    using V = hn::Vec<Tag>;
    static constexpr int kQuads = kBlockSide * kBlockSide;

    /// The edges of the two triangles (0,1,2) and (0,2,3).
    enum Edge { k01, k12, k20, k23, k30, kEdgeCount };

    /// Rows of points at parameters 0, 1/4, 1/2, 3/4 and 1. The sums run alike from both ends, so
    /// that a curve that two patches share has the same points in both.
    static HWY_INLINE void _EvaluateRows(const V r[4], V out[5]) {
        const Tag d;
        constexpr float kWeights[3][4] = {{27 / 64.0f, 27 / 64.0f, 9 / 64.0f, 1 / 64.0f},
                                          {8 / 64.0f, 24 / 64.0f, 24 / 64.0f, 8 / 64.0f},
                                          {1 / 64.0f, 9 / 64.0f, 27 / 64.0f, 27 / 64.0f}};
        out[0] = r[0];
        for (int i = 0; i < 3; ++i) {
            const float* w = kWeights[i];
            out[i + 1] =
                hn::Add(hn::Add(hn::Mul(hn::Set(d, w[0]), r[0]), hn::Mul(hn::Set(d, w[3]), r[3])),
                        hn::Add(hn::Mul(hn::Set(d, w[1]), r[1]), hn::Mul(hn::Set(d, w[2]), r[2])));
        }
        out[4] = r[3];
    }

    static HWY_INLINE void _Evaluate(const BezierRows& patch, float grid[3][kBlockSide + 1][8]) {
        const Tag d;
        alignas(64) float four[5][16], last[5][16];
        for (size_t lane = 0; lane < 16; lane += hn::Lanes(d)) {
            V rows[4] = {hn::Load(d, patch.rows[0] + lane), hn::Load(d, patch.rows[1] + lane),
                         hn::Load(d, patch.rows[2] + lane), hn::Load(d, patch.rows[3] + lane)};
            TransposeRows(rows);
            V columns[5];
            _EvaluateRows(rows, columns);
            V lastColumn[4] = {columns[4], columns[4], columns[4], columns[4]};
            TransposeRows(columns);
            TransposeRows(lastColumn);
            V points[5];
            _EvaluateRows(columns, points);
            for (int row = 0; row < 5; ++row) {
                hn::Store(points[row], d, four[row] + lane);
            }
            _EvaluateRows(lastColumn, points);
            for (int row = 0; row < 5; ++row) {
                hn::Store(points[row], d, last[row] + lane);
            }
        }
        for (int axis = 0; axis < 3; ++axis) {
            for (int row = 0; row < 5; ++row) {
                for (int column = 0; column < 4; ++column) {
                    grid[axis][row][column] = four[row][4 * axis + column];
                }
                grid[axis][row][4] = last[row][4 * axis];
            }
        }
    }

    /// Prepares what depends on a ray's origin only; most rays of a packet share it.
    void _SeeFrom(float x, float y, float z) {
        if (_isSeen && x == _origin[0] && y == _origin[1] && z == _origin[2]) {
            return;
        }
        _isSeen = true;
        _origin[0] = x;
        _origin[1] = y;
        _origin[2] = z;
        constexpr int kEnds[kEdgeCount][2] = {{0, 1}, {1, 2}, {2, 0}, {2, 3}, {3, 0}};
        const Tag d;
        for (size_t lane = 0; lane < kQuads; lane += hn::Lanes(d)) {
            V corner[4][3];
            for (int c = 0; c < 4; ++c) {
                for (int axis = 0; axis < 3; ++axis) {
                    corner[c][axis] =
                        hn::Sub(hn::Load(d, _corners[c][axis] + lane), hn::Set(d, _origin[axis]));
                }
            }
            for (int e = 0; e < kEdgeCount; ++e) {
                _EdgeNormal(corner[kEnds[e][0]], corner[kEnds[e][1]], lane, _edgeNormal[e]);
            }
            _Plane(corner[0], corner[1], corner[2], lane, 0);
            _Plane(corner[0], corner[2], corner[3], lane, 1);
        }
    }

    /// Normal of the plane through the origin and an edge: the edge's volume with a direction is
    /// their dot product. The reversed edge gives exactly the negative (see EdgeVolume).
    static HWY_INLINE void _EdgeNormal(const V a[3], const V b[3], size_t lane,
                                       float normal[3][kQuads]) {
        const Tag d;
        const V ex = hn::Sub(b[0], a[0]), ey = hn::Sub(b[1], a[1]), ez = hn::Sub(b[2], a[2]);
        const V sx = hn::Add(b[0], a[0]), sy = hn::Add(b[1], a[1]), sz = hn::Add(b[2], a[2]);
        hn::Store(hn::Sub(hn::Mul(ey, sz), hn::Mul(ez, sy)), d, normal[0] + lane);
        hn::Store(hn::Sub(hn::Mul(ez, sx), hn::Mul(ex, sz)), d, normal[1] + lane);
        hn::Store(hn::Sub(hn::Mul(ex, sy), hn::Mul(ey, sx)), d, normal[2] + lane);
    }

    /// Normal and height of a triangle's plane.
    HWY_INLINE void _Plane(const V a[3], const V b[3], const V c[3], size_t lane, int triangle) {
        const Tag d;
        const V ux = hn::Sub(b[0], a[0]), uy = hn::Sub(b[1], a[1]), uz = hn::Sub(b[2], a[2]);
        const V vx = hn::Sub(c[0], a[0]), vy = hn::Sub(c[1], a[1]), vz = hn::Sub(c[2], a[2]);
        const V nx = hn::Sub(hn::Mul(uy, vz), hn::Mul(uz, vy));
        const V ny = hn::Sub(hn::Mul(uz, vx), hn::Mul(ux, vz));
        const V nz = hn::Sub(hn::Mul(ux, vy), hn::Mul(uy, vx));
        hn::Store(nx, d, _planeNormal[triangle][0] + lane);
        hn::Store(ny, d, _planeNormal[triangle][1] + lane);
        hn::Store(nz, d, _planeNormal[triangle][2] + lane);
        hn::Store(_Dot(nx, ny, nz, a[0], a[1], a[2]), d, _planeHeight[triangle] + lane);
        // The quad's diagonal bounds its edges, and with them what the tolerance can do.
        if (triangle == 0) {
            hn::Store(hn::Sqrt(_Dot(vx, vy, vz, vx, vy, vz)), d, _diagonal + lane);
        }
    }

    static HWY_INLINE V _Dot(V ax, V ay, V az, V bx, V by, V bz) {
        return hn::Add(hn::Add(hn::Mul(ax, bx), hn::Mul(ay, by)), hn::Mul(az, bz));
    }

    void _IntersectVector(const ObjectRays& rays, int ray, float tolerance, size_t lane,
                          BlockHit* best) const {
        const Tag d;
        const V dx = hn::Set(d, rays.directionX[ray]), dy = hn::Set(d, rays.directionY[ray]),
                dz = hn::Set(d, rays.directionZ[ray]);
        V volume[kEdgeCount];
        for (int e = 0; e < kEdgeCount; ++e) {
            volume[e] =
                _Dot(hn::Load(d, _edgeNormal[e][0] + lane), hn::Load(d, _edgeNormal[e][1] + lane),
                     hn::Load(d, _edgeNormal[e][2] + lane), dx, dy, dz);
        }
        const V slack =
            hn::Mul(hn::Set(d, 2 * tolerance * rays.length[ray]), hn::Load(d, _diagonal + lane));
        const V triangles[2][3] = {{volume[k12], volume[k20], volume[k01]},
                                   {volume[k23], volume[k30], hn::Neg(volume[k20])}};
        for (int triangle = 0; triangle < 2; ++triangle) {
            const V* w = triangles[triangle];
            const V least = hn::Min(hn::Min(w[0], w[1]), w[2]);
            const V most = hn::Max(hn::Max(w[0], w[1]), w[2]);
            auto hit = hn::Or(hn::Ge(least, hn::Neg(slack)), hn::Le(most, slack));
            hit = hn::And(hit, hn::Gt(hn::Max(most, hn::Neg(least)), slack));
            if (hn::AllFalse(d, hit)) {
                continue;
            }
            const V along = _Dot(hn::Load(d, _planeNormal[triangle][0] + lane),
                                 hn::Load(d, _planeNormal[triangle][1] + lane),
                                 hn::Load(d, _planeNormal[triangle][2] + lane), dx, dy, dz);
            const V t = hn::Div(hn::Load(d, _planeHeight[triangle] + lane), along);
            hit = hn::And(hit, hn::Ne(along, hn::Zero(d)));
            hit = hn::And(hit, hn::And(hn::Ge(t, hn::Set(d, rays.tMin[ray])),
                                       hn::Le(t, hn::Set(d, best->t))));
            if (!hn::AllFalse(d, hit)) {
                _KeepNearest(hit, t, w, triangle, lane, best);
            }
        }
    }

    void _KeepNearest(hn::Mask<Tag> hit, V t, const V w[3], int triangle, size_t lane,
                      BlockHit* best) const {
        const Tag d;
        const V far = hn::Set(d, 3e38f);
        const V candidates = hn::IfThenElse(hit, t, far);
        const V nearest = hn::MinOfLanes(d, candidates);
        const auto index =
            static_cast<size_t>(hn::FindFirstTrue(d, hn::And(hit, hn::Eq(candidates, nearest))));
        alignas(64) float distance[16], a[16], b[16], c[16];
        hn::Store(candidates, d, distance);
        hn::Store(w[0], d, a);
        hn::Store(w[1], d, b);
        hn::Store(w[2], d, c);
        const float inverse = 1 / (a[index] + b[index] + c[index]);
        const float weightB = _Clamp(b[index] * inverse), weightC = _Clamp(c[index] * inverse);
        const float both = _Clamp(weightB + weightC);
        const size_t quad = lane + index;
        constexpr float kSize = 1.0f / kBlockSide;
        best->isHit = true;
        best->t = distance[index];
        const size_t column = quad % kBlockSide, row = quad / kBlockSide;
        best->u = (static_cast<float>(column) + (triangle == 0 ? both : weightB)) * kSize;
        best->v = (static_cast<float>(row) + (triangle == 0 ? weightC : both)) * kSize;
    }

    static float _Clamp(float x) { return x > 0 ? (x < 1 ? x : 1) : 0; }

    alignas(64) float _corners[4][3][kQuads];
    alignas(64) float _edgeNormal[kEdgeCount][3][kQuads];
    alignas(64) float _planeNormal[2][3][kQuads];
    alignas(64) float _planeHeight[2][kQuads];
    alignas(64) float _diagonal[kQuads];
    float _origin[3];
    bool _isSeen = false;
};

}  // namespace HWY_NAMESPACE
}  // namespace cc
HWY_AFTER_NAMESPACE();

#endif
