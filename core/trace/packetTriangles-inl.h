// Per-target include guard, as Highway's foreach_target asks for.
#if defined(CC_TRACE_PACKET_TRIANGLES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CC_TRACE_PACKET_TRIANGLES_INL_H
#undef CC_TRACE_PACKET_TRIANGLES_INL_H
#else
#define CC_TRACE_PACKET_TRIANGLES_INL_H
#endif

#include <algorithm>

#include <hwy/highway.h>

#include "core/trace/boxTests-inl.h"
#include "core/trace/patchSquare.h"
#include "core/trace/quadIntersection-inl.h"
#include "core/trace/rayPacket.h"
#include "core/trace/traceStatistics.h"

HWY_BEFORE_NAMESPACE();
namespace cc {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// The first of the rays whose bits are set; there must be one.
inline int FirstOf(uint64_t rays) { return __builtin_ctzll(rays); }

/// A triangle of a surface: its corners, and where they lie on the patch.
struct SurfaceTriangle {
    Vec3f corners[3];
    Vec2f parameters[3];
};

/// The two triangles of a quad: (0,0) (1,0) (1,1) and (0,0) (1,1) (0,1) of its square.
struct SurfaceQuad {
    SurfaceTriangle triangles[2];

    /// @param corners  of the square, from (0,0) by (1,0) to (0,1)
    SurfaceQuad(const Vec3f corners[4], const Square& square) {
        const float u = square.u, v = square.v, size = square.size;
        triangles[0] = {{corners[0], corners[1], corners[2]},
                        {{u, v}, {u + size, v}, {u + size, v + size}}};
        triangles[1] = {{corners[0], corners[2], corners[3]},
                        {{u, v}, {u + size, v + size}, {u, v + size}}};
    }
};

/// Intersects the rays of a packet with triangles of one surface, one at a time, rays across the
/// vector; notes the nearest hits.
/// @tparam D        as many rays as a vector of D has lanes are tested at once
/// @tparam kAnyHit  rays end at whatever they hit first, and hits are not recorded
template <class D, bool kAnyHit>
class PacketTriangles {
  public:
    PacketTriangles(uint32_t instance, ObjectRays* rays, HitPacket* hits,
                    TraceStatistics* statistics)
        : _instance(instance), _rays(*rays), _hits(hits), _statistics(*statistics) {
        for (int i = 0; i < rays->count; ++i) {
            _doneRays += rays->tMax[i] < rays->tMin[i];
        }
    }

    /// True if every ray is done: only any-hit rays are, before the traversal is.
    bool IsDone() const { return kAnyHit && _rays.count == _doneRays; }

    /// Rays that are done: counted up too by who else ends any-hit rays.
    int* DoneRays() { return &_doneRays; }

    /// The final intersection (paper, section 3.5): the packet shrinks to the vectors of rays from
    /// the first to the last that hits a box, which are intersected with a few triangles in turn.
    /// @param box        holds the triangles
    /// @param tolerance  how far apart neighbouring patches may compute the same point
    /// @param onHit      called with a vector's first ray, its hits on a triangle, and which of the
    ///                   triangles that is
    /// Returns true if a ray has become shorter.
    template <class OnHit>
    bool Intersect(const SurfaceTriangle* triangles, int count, uint32_t patch, float tolerance,
                   const Box3f& box, int firstRay, const OnHit& onHit) {
        const D d;
        const int lanes = static_cast<int>(hn::Lanes(d));
        int first = firstRay - firstRay % lanes, last = (_rays.count - 1) / lanes * lanes;
        while (first <= last && hn::AllFalse(d, RaysHitBox(d, _rays, first, box))) {
            first += lanes;
        }
        while (first < last && hn::AllFalse(d, RaysHitBox(d, _rays, last, box))) {
            last -= lanes;
        }
        ++_statistics.finalIntersections;
        bool isShortened = false;
        for (int group = first; group <= last; group += lanes) {
            _statistics.activeLanes += lanes;
            const RayLanes<D> rays(d, _rays, group);
            for (int i = 0; i < count; ++i) {
                const TriangleHit<D> hit = _Test(triangles[i], tolerance, rays, group);
                if (!hn::AllFalse(d, hit.hit)) {
                    isShortened = true;
                    _Record(triangles[i], patch, group, hit);
                    onHit(group, hit, i);
                }
            }
        }
        return isShortened;
    }

  private:
    HWY_INLINE TriangleHit<D> _Test(const SurfaceTriangle& triangle, float tolerance,
                                    const RayLanes<D>& rays, int group) const {
        const D d;
        const Vec3f &a = triangle.corners[0], &b = triangle.corners[1], &c = triangle.corners[2];
        const float longest = std::max({Length(b - a), Length(c - b), Length(a - c)});
        const auto slack =
            hn::Mul(hn::Set(d, 2 * tolerance * longest), hn::Load(d, _rays.length + group));
        return IntersectTriangle(d, rays, CornerLanes<D>(d, rays, a), CornerLanes<D>(d, rays, b),
                                 CornerLanes<D>(d, rays, c), slack, hn::Load(d, _rays.tMin + group),
                                 hn::Load(d, _rays.tMax + group));
    }

    /// Notes the hits of a vector of rays: they are nearer than what the rays had.
    HWY_INLINE void _Record(const SurfaceTriangle& triangle, uint32_t patch, int group,
                            const TriangleHit<D>& hit) {
        const D d;
        float* tMax = _rays.tMax + group;
        if (kAnyHit) {
            _doneRays += static_cast<int>(hn::CountTrue(d, hit.hit));
            hn::Store(hn::IfThenElse(hit.hit, hn::Set(d, -1.0f), hn::Load(d, tMax)), d, tMax);
            return;
        }
        hn::Store(hn::IfThenElse(hit.hit, hit.t, hn::Load(d, tMax)), d, tMax);
        const auto b = hit.weightB;
        const auto c = hn::Min(hit.weightC, hn::Sub(hn::Set(d, 1.0f), b));
        const Vec2f* p = triangle.parameters;
        _StoreParameter(hit.hit, p[0].x, p[1].x, p[2].x, b, c, _hits->u + group);
        _StoreParameter(hit.hit, p[0].y, p[1].y, p[2].y, b, c, _hits->v + group);
        _StoreIndex(hit.hit, patch, _hits->patch + group);
        _StoreIndex(hit.hit, _instance, _hits->instance + group);
    }

    static HWY_INLINE void _StoreParameter(hn::Mask<D> hit, float atA, float atB, float atC,
                                           hn::Vec<D> b, hn::Vec<D> c, float* to) {
        const D d;
        const auto fromA =
            hn::Add(hn::Mul(hn::Set(d, atB - atA), b), hn::Mul(hn::Set(d, atC - atA), c));
        const auto value = hn::Add(hn::Set(d, atA), fromA);
        hn::Store(hn::IfThenElse(hit, value, hn::Load(d, to)), d, to);
    }

    static HWY_INLINE void _StoreIndex(hn::Mask<D> hit, uint32_t index, uint32_t* to) {
        const hn::RebindToUnsigned<D> d;
        const auto mask = hn::RebindMask(d, hit);
        hn::Store(hn::IfThenElse(mask, hn::Set(d, index), hn::Load(d, to)), d, to);
    }

    const uint32_t _instance;
    ObjectRays& _rays;
    HitPacket* const _hits;
    TraceStatistics& _statistics;
    int _doneRays = 0;
};

}  // namespace HWY_NAMESPACE
}  // namespace cc
HWY_AFTER_NAMESPACE();

#endif
