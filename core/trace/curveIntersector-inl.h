// Per-target include guard, as Highway's foreach_target asks for.
#if defined(CC_TRACE_CURVE_INTERSECTOR_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CC_TRACE_CURVE_INTERSECTOR_INL_H
#undef CC_TRACE_CURVE_INTERSECTOR_INL_H
#else
#define CC_TRACE_CURVE_INTERSECTOR_INL_H
#endif

#include <hwy/highway.h>

#include "core/trace/curvePieces.h"
#include "core/trace/objectRays.h"
#include "core/trace/rayPacket.h"

HWY_BEFORE_NAMESPACE();
namespace cc {
namespace HWY_NAMESPACE {

/// Intersects rays with the segments of curves: a segment is cut into pieces once for all rays that
/// reach it.
/// @tparam Rays     PacketRays or SingleRay
/// @tparam kAnyHit  rays end at whatever they hit first, and hits are not recorded
template <class Rays, bool kAnyHit>
class CurveIntersector {
  public:
    /// @param number  of the instance, as hits give it
    CurveIntersector(const CurveSegments& segments, uint32_t number, Rays* rays, HitPacket* hits)
        : _segments(segments), _instance(number), _rays(rays->rays), _hits(hits) {}

    /// @param hitting  a bit for each ray that hits the segment's box
    /// Returns true if a ray hits it.
    bool Intersect(uint32_t index, uint64_t hitting) {
        const CurvePieces pieces(_segments, index);
        bool isHit = false;
        for (; hitting != 0; hitting &= hitting - 1) {
            const int i = __builtin_ctzll(hitting);
            CurveRay ray{{_rays.originX[i], _rays.originY[i], _rays.originZ[i]},
                         {_rays.directionX[i], _rays.directionY[i], _rays.directionZ[i]},
                         _rays.tMin[i],
                         _rays.tMax[i]};
            if (pieces.Intersect(&ray)) {
                isHit = true;
                _Record(index, i, ray);
            }
        }
        return isHit;
    }

  private:
    void _Record(uint32_t index, int i, const CurveRay& ray) {
        if (kAnyHit) {
            _rays.tMax[i] = -1;
            return;
        }
        _rays.tMax[i] = ray.tMax;
        _hits->instance[i] = _instance;
        _hits->patch[i] = index;
        _hits->u[i] = ray.u;
        _hits->v[i] = ray.v;
    }

    const CurveSegments& _segments;
    const uint32_t _instance;
    ObjectRays& _rays;
    HitPacket* const _hits;
};

}  // namespace HWY_NAMESPACE
}  // namespace cc
HWY_AFTER_NAMESPACE();

#endif
