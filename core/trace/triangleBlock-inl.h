// Per-target include guard, as Highway's foreach_target asks for.
#if defined(CC_TRACE_TRIANGLE_BLOCK_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CC_TRACE_TRIANGLE_BLOCK_INL_H
#undef CC_TRACE_TRIANGLE_BLOCK_INL_H
#else
#define CC_TRACE_TRIANGLE_BLOCK_INL_H
#endif

#include <hwy/highway.h>

#include "core/trace/bezierLanes-inl.h"
#include "core/trace/objectRays.h"

HWY_BEFORE_NAMESPACE();
namespace cc {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Where one ray hits a block of triangles first.
struct TriangleBlockHit {
    bool isHit = false;
    float t = 0;
    float u = 0, v = 0;  ///< in the block's triangle
};

/// The triangles that the last splits of a patch make, up to 16, laid out so that one ray meets a
/// vector of them.
class TriangleBlock {
  public:
    /// Evaluates the limit surface at the corners of all triangles.
    /// @param splits  0..kLatticeSplits: the patch becomes 4^splits triangles
    TriangleBlock(const BezierLanes& patch, int splits) {
        alignas(64) float vertices[3][16];
        const LatticeTable& lattice = BezierTables::Get().lattice[splits];
        Combine(patch, lattice.weights, vertices);
        _count = 1 << (2 * splits);
        _scale = 1 / static_cast<float>(1 << splits);
        for (int t = 0; t < kMaxCount; ++t) {
            // Lanes that are left over become points, which no ray hits.
            const LatticeTriangle& triangle = lattice.triangles[t < _count ? t : 0];
            for (int corner = 0; corner < 3; ++corner) {
                const int vertex = triangle.vertices[t < _count ? corner : 0];
                for (int axis = 0; axis < 3; ++axis) {
                    _corners[corner][axis][t] = vertices[axis][vertex];
                }
            }
            _columns[t] = triangle.column;
            _rows[t] = triangle.row;
            _turns[t] = triangle.turn;
        }
    }

    /// A single triangle.
    explicit TriangleBlock(const Vec3f corners[3]) {
        for (int t = 0; t < kMaxCount; ++t) {
            for (int corner = 0; corner < 3; ++corner) {
                for (int axis = 0; axis < 3; ++axis) {
                    _corners[corner][axis][t] = corners[t == 0 ? corner : 0][axis];
                }
            }
        }
        _columns[0] = _rows[0] = 0;
        _turns[0] = 1;
    }

    /// Intersects a ray with all triangles.
    /// @param tolerance  how far apart neighbouring patches may compute the same point
    TriangleBlockHit Intersect(const ObjectRays& rays, int ray, float tolerance) {
        _SeeFrom({rays.originX[ray], rays.originY[ray], rays.originZ[ray]});
        TriangleBlockHit best;
        best.t = rays.tMax[ray];
        for (int lane = 0; lane < _count; lane += static_cast<int>(hn::Lanes(Tag()))) {
            _IntersectVector(rays, ray, tolerance, lane, &best);
        }
        return best;
    }

  private:
    using Tag = hn::CappedTag<float, 16>;
    using V = hn::Vec<Tag>;
    static constexpr int kMaxCount = 16;

    /// Prepares what depends on a ray's origin only; most rays of a packet share it.
    void _SeeFrom(const Vec3f& origin) {
        if (_isSeen && origin == _origin) {
            return;
        }
        _isSeen = true;
        _origin = origin;
        const Tag d;
        for (int lane = 0; lane < _count; lane += static_cast<int>(hn::Lanes(d))) {
            V corner[3][3];
            for (int c = 0; c < 3; ++c) {
                for (int axis = 0; axis < 3; ++axis) {
                    corner[c][axis] =
                        hn::Sub(hn::Load(d, _corners[c][axis] + lane), hn::Set(d, origin[axis]));
                }
            }
            V longest = hn::Zero(d);
            for (int c = 0; c < 3; ++c) {
                _SetEdge(corner[(c + 1) % 3], corner[(c + 2) % 3], lane, _edgeNormal[c], &longest);
            }
            hn::Store(hn::Sqrt(longest), d, _longest + lane);
            _SetPlane(corner, lane);
        }
    }

    /// Sets the normal of the plane through the origin and an edge: the edge's volume with a
    /// direction is their dot product. The reversed edge gives exactly the negative (see
    /// EdgeVolume), so that two triangles agree on who has the ray.
    static HWY_INLINE void _SetEdge(const V a[3], const V b[3], int lane,
                                    float normal[3][kMaxCount], V* longest) {
        const Tag d;
        const V ex = hn::Sub(b[0], a[0]), ey = hn::Sub(b[1], a[1]), ez = hn::Sub(b[2], a[2]);
        const V sx = hn::Add(b[0], a[0]), sy = hn::Add(b[1], a[1]), sz = hn::Add(b[2], a[2]);
        hn::Store(hn::Sub(hn::Mul(ey, sz), hn::Mul(ez, sy)), d, normal[0] + lane);
        hn::Store(hn::Sub(hn::Mul(ez, sx), hn::Mul(ex, sz)), d, normal[1] + lane);
        hn::Store(hn::Sub(hn::Mul(ex, sy), hn::Mul(ey, sx)), d, normal[2] + lane);
        *longest = hn::Max(*longest, _Dot(ex, ey, ez, ex, ey, ez));
    }

    /// Sets the normal and height of the triangles' planes.
    HWY_INLINE void _SetPlane(const V c[3][3], int lane) {
        const Tag d;
        V e1[3], e2[3];
        for (int axis = 0; axis < 3; ++axis) {
            e1[axis] = hn::Sub(c[1][axis], c[0][axis]);
            e2[axis] = hn::Sub(c[2][axis], c[0][axis]);
        }
        const V nx = hn::Sub(hn::Mul(e1[1], e2[2]), hn::Mul(e1[2], e2[1]));
        const V ny = hn::Sub(hn::Mul(e1[2], e2[0]), hn::Mul(e1[0], e2[2]));
        const V nz = hn::Sub(hn::Mul(e1[0], e2[1]), hn::Mul(e1[1], e2[0]));
        hn::Store(nx, d, _planeNormal[0] + lane);
        hn::Store(ny, d, _planeNormal[1] + lane);
        hn::Store(nz, d, _planeNormal[2] + lane);
        hn::Store(_Dot(nx, ny, nz, c[0][0], c[0][1], c[0][2]), d, _planeHeight + lane);
    }

    static HWY_INLINE V _Dot(V ax, V ay, V az, V bx, V by, V bz) {
        return hn::Add(hn::Add(hn::Mul(ax, bx), hn::Mul(ay, by)), hn::Mul(az, bz));
    }

    void _IntersectVector(const ObjectRays& rays, int ray, float tolerance, int lane,
                          TriangleBlockHit* best) const {
        const Tag d;
        const V dx = hn::Set(d, rays.directionX[ray]), dy = hn::Set(d, rays.directionY[ray]),
                dz = hn::Set(d, rays.directionZ[ray]);
        const auto dot = [&](const float normal[3][kMaxCount]) {
            return _Dot(hn::Load(d, normal[0] + lane), hn::Load(d, normal[1] + lane),
                        hn::Load(d, normal[2] + lane), dx, dy, dz);
        };
        // The volume of the edge opposite to each corner.
        const V w[3] = {dot(_edgeNormal[0]), dot(_edgeNormal[1]), dot(_edgeNormal[2])};
        const V slack =
            hn::Mul(hn::Set(d, 2 * tolerance * rays.length[ray]), hn::Load(d, _longest + lane));
        const V least = hn::Min(hn::Min(w[0], w[1]), w[2]);
        const V most = hn::Max(hn::Max(w[0], w[1]), w[2]);
        auto hit = hn::Or(hn::Ge(least, hn::Neg(slack)), hn::Le(most, slack));
        // A triangle thinner than the slack has no plane worth the name; its neighbours have the
        // ray.
        hit = hn::And(hit, hn::Gt(hn::Max(most, hn::Neg(least)), slack));
        if (hn::AllFalse(d, hit)) {
            return;
        }
        const V along = dot(_planeNormal);
        const V t = hn::Div(hn::Load(d, _planeHeight + lane), along);
        hit = hn::And(hit, hn::Ne(along, hn::Zero(d)));
        hit = hn::And(
            hit, hn::And(hn::Ge(t, hn::Set(d, rays.tMin[ray])), hn::Le(t, hn::Set(d, best->t))));
        if (!hn::AllFalse(d, hit)) {
            _KeepNearest(hit, t, w, lane, best);
        }
    }

    void _KeepNearest(hn::Mask<Tag> hit, V t, const V w[3], int lane,
                      TriangleBlockHit* best) const {
        const Tag d;
        const V candidates = hn::IfThenElse(hit, t, hn::Set(d, 3e38f));
        const V nearest = hn::MinOfLanes(d, candidates);
        const auto index =
            static_cast<size_t>(hn::FindFirstTrue(d, hn::And(hit, hn::Eq(candidates, nearest))));
        alignas(64) float distance[16], a[16], b[16], c[16];
        hn::Store(candidates, d, distance);
        hn::Store(w[0], d, a);
        hn::Store(w[1], d, b);
        hn::Store(w[2], d, c);
        const float inverse = 1 / (a[index] + b[index] + c[index]);
        const float weightB = _Clamp(b[index] * inverse, 1);
        const float weightC = _Clamp(c[index] * inverse, 1 - weightB);
        const size_t triangle = lane + index;
        best->isHit = true;
        best->t = distance[index];
        best->u = (_columns[triangle] + _turns[triangle] * weightB) * _scale;
        best->v = (_rows[triangle] + _turns[triangle] * weightC) * _scale;
    }

    static float _Clamp(float x, float most) { return x > 0 ? (x < most ? x : most) : 0; }

    int _count = 1;
    float _scale = 1;  ///< of a triangle in the block
    alignas(64) float _corners[3][3][kMaxCount];
    alignas(64) float _edgeNormal[3][3][kMaxCount];  ///< of the edge opposite to each corner
    alignas(64) float _planeNormal[3][kMaxCount];
    alignas(64) float _planeHeight[kMaxCount];
    alignas(64) float _longest[kMaxCount];
    /// Where a triangle's first corner is in the block, and 1 or -1 if it is turned.
    float _columns[kMaxCount], _rows[kMaxCount], _turns[kMaxCount];
    Vec3f _origin;
    bool _isSeen = false;
};

}  // namespace HWY_NAMESPACE
}  // namespace cc
HWY_AFTER_NAMESPACE();

#endif
