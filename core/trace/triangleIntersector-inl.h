// Per-target include guard, as Highway's foreach_target asks for.
#if defined(CC_TRACE_TRIANGLE_INTERSECTOR_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CC_TRACE_TRIANGLE_INTERSECTOR_INL_H
#undef CC_TRACE_TRIANGLE_INTERSECTOR_INL_H
#else
#define CC_TRACE_TRIANGLE_INTERSECTOR_INL_H
#endif

#include <hwy/highway.h>

#include "core/subdiv/bezierTriangle.h"
#include "core/subdiv/irregularTriangle.h"
#include "core/trace/bezierLanes-inl.h"
#include "core/trace/patchRays-inl.h"
#include "core/trace/rayPacket.h"
#include "core/trace/surface.h"
#include "core/trace/triangleBlock-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cc {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Intersects rays with the triangles of the Loop scheme and of polygons by Algorithm 1 of the
/// paper, as PatchIntersector does with quads: parts are culled by their Bezier hull or split into
/// four, and the last levels are evaluated at once.
/// @tparam Rays     PacketRays or SingleRay
/// @tparam kAnyHit  rays end at whatever they hit first, and hits are not recorded
template <class Rays, bool kAnyHit>
class TriangleIntersector {
  public:
    /// @param level     splits of each triangle
    /// @param doneRays  is counted up by any-hit rays that end
    TriangleIntersector(const Surface& surface, uint32_t instance, int level, Rays* rays,
                        HitPacket* hits, TraceStatistics* statistics, int* doneRays)
        : _surface(surface),
          _instance(instance),
          _level(level),
          _rays(*rays),
          _hits(hits),
          _statistics(*statistics),
          _doneRays(*doneRays) {}

    /// Returns true if a ray was shortened.
    bool Intersect(uint32_t patch, int firstRay) {
        _patch = patch;
        _isShortened = false;
        const PatchTable& patches = _surface.Patches();
        const Vec3f* points = _surface.PatchPoints().data();
        if (patches.At(patch).kind == PatchKind::FlatTriangle) {
            const uint32_t* indices = patches.Indices(patch);
            const Vec3f corners[3] = {points[indices[0]], points[indices[1]], points[indices[2]]};
            _tolerance = RoundingTolerance(corners, 3);
            _IntersectCorners(corners, SubTriangle(), firstRay);
        } else if (patches.At(patch).kind == PatchKind::RegularTriangle) {
            const BezierTriangle bezier = GatherBezierTriangle(patches, patch, points);
            _tolerance = RoundingTolerance(bezier.points, BezierTriangle::kPointCount);
            _IntersectBezier(bezier, SubTriangle(), _level, firstRay);
        } else {
            const IrregularTriangle irregular = GatherIrregularTriangle(patches, patch, points);
            const Box3f hull = irregular.HullBox();
            _tolerance = RoundingTolerance(&hull.lower, 2);
            _IntersectIrregular(irregular, SubTriangle(), _level, firstRay);
        }
        return _isShortened;
    }

  private:
    static constexpr int kMaxSplits = 8;

    /// Part of a patch.
    struct Part {
        BezierLanes bezier;
        SubTriangle at;
        int splits;  ///< left until it is a triangle
        int firstRay;
    };

    int _FirstRay(const Box3f& box, int firstRay) const {
        return FirstRayIn(_rays, Widened(box, _tolerance), firstRay, &_statistics);
    }

    void _IntersectIrregular(const IrregularTriangle& patch, const SubTriangle& at, int splits,
                             int firstRay) {
        Vec3f spline[12];
        if (patch.ToBoxSpline(spline)) {
            _IntersectBezier(BezierTriangle::FromBoxSpline(spline), at, splits, firstRay);
            return;
        }
        firstRay = _FirstRay(patch.HullBox(), firstRay);
        if (firstRay >= _rays.rays.count) {
            return;
        }
        if (splits == 0) {
            Vec3f corners[3];
            patch.LimitCorners(corners);
            _IntersectCorners(corners, at, firstRay);
            return;
        }
        ++_statistics.subdivisionsIrregular;
        IrregularTriangle parts[4];
        patch.Subdivide(parts);
        for (int i = 0; i < 4; ++i) {
            _IntersectIrregular(parts[i], at.Split(i), splits - 1, firstRay);
        }
    }

    void _IntersectCorners(const Vec3f corners[3], const SubTriangle& at, int firstRay) {
        Box3f box;
        for (int i = 0; i < 3; ++i) {
            box.Extend(corners[i]);
        }
        TriangleBlock block(corners);
        _IntersectBlock(&block, at, RaysIn(_rays, Widened(box, _tolerance), firstRay));
    }

    void _IntersectBezier(const BezierTriangle& bezier, const SubTriangle& whole, int splits,
                          int firstRay) {
        // Each split leaves at most three parts behind.
        Part stack[3 * kMaxSplits + 1];
        int count = 0;
        stack[count++] = {BezierLanes(bezier), whole, splits, firstRay};
        while (count > 0) {
            const Part part = stack[--count];
            const Box3f box = HullBox(part.bezier);
            const int first = _FirstRay(box, part.firstRay);
            if (first >= _rays.rays.count) {
                continue;
            }
            if (part.splits <= kLatticeSplits) {
                TriangleBlock block(part.bezier, part.splits);
                _IntersectBlock(&block, part.at, RaysIn(_rays, Widened(box, _tolerance), first));
                continue;
            }
            ++_statistics.subdivisionsRegular;
            BezierLanes parts[4];
            SplitTriangle(part.bezier, parts);
            for (int i = 0; i < 4; ++i) {
                stack[count++] = {parts[i], part.at.Split(i), part.splits - 1, first};
            }
        }
    }

    /// @param at       the block's triangle in the patch
    /// @param hitting  a bit for each ray that reaches the block's box
    void _IntersectBlock(TriangleBlock* block, const SubTriangle& at, uint64_t hitting) {
        ++_statistics.finalIntersections;
        _statistics.activeLanes += hwy::PopCount(hitting);
        for (; hitting != 0; hitting &= hitting - 1) {
            const int ray = __builtin_ctzll(hitting);
            const TriangleBlockHit hit = block->Intersect(_rays.rays, ray, _tolerance);
            if (!hit.isHit) {
                continue;
            }
            _isShortened = true;
            if (kAnyHit) {
                ++_doneRays;
                _rays.rays.tMax[ray] = -1;
                continue;
            }
            _rays.rays.tMax[ray] = hit.t;
            _hits->instance[ray] = _instance;
            _hits->patch[ray] = _patch;
            _hits->u[ray] = at.u + at.size * hit.u;
            _hits->v[ray] = at.v + at.size * hit.v;
        }
    }

    const Surface& _surface;
    const uint32_t _instance;
    const int _level;
    Rays& _rays;
    HitPacket* const _hits;
    TraceStatistics& _statistics;
    int& _doneRays;

    uint32_t _patch = 0;
    float _tolerance = 0;
    bool _isShortened = false;
};

}  // namespace HWY_NAMESPACE
}  // namespace cc
HWY_AFTER_NAMESPACE();

#endif
