// Per-target include guard, as Highway's foreach_target asks for.
#if defined(CC_TRACE_PATCH_INTERSECTOR_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CC_TRACE_PATCH_INTERSECTOR_INL_H
#undef CC_TRACE_PATCH_INTERSECTOR_INL_H
#else
#define CC_TRACE_PATCH_INTERSECTOR_INL_H
#endif

#include <algorithm>
#include <cmath>
#include <vector>

#include <hwy/highway.h>

#include "core/subdiv/extraordinaryPatch.h"
#include "core/subdiv/irregularPatch.h"
#include "core/trace/bezierRows-inl.h"
#include "core/trace/quadBlock-inl.h"
#include "core/trace/quadIntersection-inl.h"
#include "core/trace/rayPacket.h"
#include "core/trace/surface.h"
#include "core/trace/traversal-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cc {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Part of a patch: its rows run along u if isTransposed is set, else along v (see SplitPatch).
struct SubPatch {
    BezierRows bezier;
    float u, v, size;  ///< its corner and its extent in the patch's parameters
    int splits;        ///< left until it is a quad
    int firstRay;
    bool isTransposed;
};

/// Intersects rays with the patches of one surface by Algorithm 1 of the paper: parts of a patch
/// are culled or split, depth first, until they are quads. The control points are kept in Bezier
/// form, whose hull is tight and whose corners are limit positions.
/// @tparam Rays     PacketRays or SingleRay
/// @tparam kAnyHit  rays end at whatever they hit first, and hits are not recorded
template <class Rays, bool kAnyHit>
class PatchIntersector {
  public:
    PatchIntersector(const Surface& surface, uint32_t instance, int level, Rays* rays,
                     HitPacket* hits, TraceStatistics* statistics)
        : _surface(surface),
          _instance(instance),
          // Quads of a mesh must meet at one level: where faces were refined deeper than the level
          // that was asked for, the whole mesh goes as deep.
          _level(std::max(level, surface.Patches().MaxDepth())),
          _rays(*rays),
          _hits(hits),
          _statistics(*statistics) {
        for (int i = 0; i < rays->rays.count; ++i) {
            _doneRays += rays->rays.tMax[i] < rays->rays.tMin[i];
        }
    }

    void Intersect(uint32_t patch, int firstRay) {
        _isShortened = false;
        _IntersectPatch(patch, firstRay);
        if (_isShortened) {
            _rays.Shortened();
        }
    }

    /// True if every ray is done: only any-hit rays are, before the traversal is.
    bool IsDone() const { return kAnyHit && _rays.rays.count == _doneRays; }

  private:
    using Tag = typename Rays::Tag;
    static constexpr int kMaxSplits = 8;

    void _IntersectPatch(uint32_t patch, int firstRay) {
        ++_statistics.leafIntersections;
        _patch = patch;
        const PatchTable& patches = _surface.Patches();
        const Patch& p = patches.At(patch);
        const int splits = _level - p.depth;
        if (p.kind == PatchKind::Extraordinary) {
            _IntersectExtraordinary(patches, p, splits, firstRay);
            return;
        }
        if (p.kind == PatchKind::Irregular) {
            const IrregularPatch irregular =
                GatherIrregular(patches, patch, _surface.PatchPoints().data());
            const Box3f hull = irregular.HullBox();
            _SetTolerance(&hull.lower, 2);
            _IntersectIrregular(irregular, 0, 0, 1, splits, firstRay);
            return;
        }
        const BezierPatch bezier = GatherBezier(patches, patch, _surface.PatchPoints().data());
        _SetTolerance(&bezier.points[0][0], 16);
        _IntersectBezier(bezier, 0, 0, 1, splits, firstRay);
    }

    /// How far apart neighbouring patches may compute the same point.
    void _SetTolerance(const Vec3f* points, int count) {
        float largest = 0;
        for (int i = 0; i < count; ++i) {
            largest = std::max(
                {largest, std::fabs(points[i].x), std::fabs(points[i].y), std::fabs(points[i].z)});
        }
        _tolerance = 2.5e-7f * largest;
    }

    void _IntersectExtraordinary(const PatchTable& patches, const Patch& patch, int splits,
                                 int firstRay) {
        const uint32_t* indices = patches.Indices(_patch);
        _ring.resize(2 * patch.valence + 8);
        for (size_t i = 0; i < _ring.size(); ++i) {
            _ring[i] = _surface.PatchPoints()[indices[i]];
        }
        _SetTolerance(_ring.data(), static_cast<int>(_ring.size()));
        ExtraordinaryPatch extraordinary(_ring.data(), patch.valence);
        float size = 1;
        for (; splits > 0; --splits) {
            Box3f box;
            for (const Vec3f& p : extraordinary.ControlPoints()) {
                box.Extend(p);
            }
            firstRay = _FirstRay(_Widened(box), firstRay);
            if (firstRay >= _rays.rays.count) {
                return;
            }
            ++_statistics.subdivisionsIrregular;
            ExtraordinaryPatch::RegularQuarters quarters;
            extraordinary.Subdivide(&quarters);
            size *= 0.5f;
            const float u[3] = {size, size, 0}, v[3] = {0, size, size};
            for (int i = 0; i < 3; ++i) {
                _IntersectBezier(BezierPatch::FromBSpline(quarters.points[i]), u[i], v[i], size,
                                 splits - 1, firstRay);
            }
        }
        Vec3f corners[4];
        extraordinary.LimitCorners(corners);
        _IntersectLimitQuad(corners, 0, 0, size, firstRay);
    }

    void _IntersectIrregular(const IrregularPatch& patch, float u, float v, float size, int splits,
                             int firstRay) {
        Vec3f bspline[16];
        if (patch.ToBSpline(bspline)) {
            _IntersectBezier(BezierPatch::FromBSpline(bspline), u, v, size, splits, firstRay);
            return;
        }
        if (splits == 0) {
            Vec3f corners[4];
            patch.LimitCorners(corners);
            _IntersectLimitQuad(corners, u, v, size, firstRay);
            return;
        }
        firstRay = _FirstRay(_Widened(patch.HullBox()), firstRay);
        if (firstRay >= _rays.rays.count) {
            return;
        }
        ++_statistics.subdivisionsIrregular;
        IrregularPatch quarters[4];
        patch.Subdivide(quarters);
        const float half = size * 0.5f;
        for (int i = 0; i < 4; ++i) {
            _IntersectIrregular(quarters[i], i == 1 || i == 2 ? u + half : u, i >= 2 ? v + half : v,
                                half, splits - 1, firstRay);
        }
    }

    /// A quad of the last level whose box has not been tested yet.
    void _IntersectLimitQuad(const Vec3f corners[4], float u, float v, float size, int firstRay) {
        Box3f box;
        for (int i = 0; i < 4; ++i) {
            box.Extend(corners[i]);
        }
        _IntersectQuad(corners, _Widened(box), u, v, size, firstRay);
    }

    Box3f _Widened(Box3f box) const {
        for (int axis = 0; axis < 3; ++axis) {
            box.lower[axis] -= _tolerance;
            box.upper[axis] += _tolerance;
        }
        return box;
    }

    /// The first ray that hits a box, or the packet's count: culling by interval first.
    int _FirstRay(const Box3f& box, int firstRay) {
        ++_statistics.boxTests;
        if (_rays.Culls(box)) {
            ++_statistics.intervalCulls;
            return _rays.rays.count;
        }
        const int first = FirstRayThatHits(Tag(), _rays.rays, firstRay, box);
        _statistics.earlyHits += first == firstRay;
        return first;
    }

    void _IntersectBezier(const BezierPatch& bezier, float u, float v, float size, int splits,
                          int firstRay) {
        // Each split leaves at most three parts behind.
        SubPatch stack[3 * kMaxSplits + 1];
        int count = 0;
        stack[count++] = {BezierRows(bezier), u, v, size, splits, firstRay, false};
        while (count > 0) {
            SubPatch& part = stack[--count];
            const Box3f box = _Widened(HullBox(part.bezier));
            const int first = _FirstRay(box, part.firstRay);
            if (first >= _rays.rays.count) {
                continue;
            }
            if (part.splits == 0) {
                const Vec3f corners[4] = {
                    part.bezier.Corner(0, 0),
                    part.bezier.Corner(part.isTransposed, !part.isTransposed),
                    part.bezier.Corner(1, 1),
                    part.bezier.Corner(!part.isTransposed, part.isTransposed)};
                _IntersectQuad(corners, box, part.u, part.v, part.size, first);
                continue;
            }
            if (part.splits == kBlockSplits) {
                _IntersectBlock(part, _RaysThatHit(box, first));
                continue;
            }
            ++_statistics.subdivisionsRegular;
            _PushQuarters(part, first, stack, &count);
        }
    }

    /// A bit for each ray from the first on that hits a box.
    uint64_t _RaysThatHit(const Box3f& box, int firstRay) const {
        const Tag d;
        const int lanes = static_cast<int>(hn::Lanes(d));
        uint64_t bits = 0;
        for (int group = firstRay - firstRay % lanes; group < _rays.rays.count; group += lanes) {
            alignas(8) uint8_t bytes[8] = {};
            hn::StoreMaskBits(d, RaysHitBox(d, _rays.rays, group, box), bytes);
            const uint64_t mask = bytes[0] | static_cast<uint64_t>(bytes[1]) << 8;
            bits |= (mask & ((uint64_t(1) << lanes) - 1)) << group;
        }
        return bits;
    }

    /// The last levels of a part, evaluated whole, against the rays that reach its box.
    void _IntersectBlock(const SubPatch& part, uint64_t hitting) {
        ++_statistics.finalIntersections;
        _statistics.activeLanes += hwy::PopCount(hitting);
        QuadBlock block(part.bezier);
        for (; hitting != 0; hitting &= hitting - 1) {
            const int ray = __builtin_ctzll(hitting);
            const BlockHit hit = block.Intersect(_rays.rays, ray, _tolerance);
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
            _hits->u[ray] = part.u + part.size * (part.isTransposed ? hit.v : hit.u);
            _hits->v[ray] = part.v + part.size * (part.isTransposed ? hit.u : hit.v);
        }
    }

    void _PushQuarters(const SubPatch& part, int firstRay, SubPatch* stack, int* count) {
        BezierRows quarters[4];
        SplitPatch(part.bezier, quarters);
        const float half = part.size * 0.5f, u = part.u, v = part.v;
        const int splits = part.splits - 1;
        const bool isTransposed = part.isTransposed;
        for (int i = 0; i < 4; ++i) {
            const bool isHighRow = (i & 2) != 0, isHighColumn = (i & 1) != 0;
            const bool isHighU = isTransposed ? isHighRow : isHighColumn;
            const bool isHighV = isTransposed ? isHighColumn : isHighRow;
            stack[(*count)++] = {
                quarters[i], isHighU ? u + half : u, isHighV ? v + half : v, half, splits,
                firstRay,    !isTransposed};
        }
    }

    /// The final intersection (paper, section 3.5): two triangles, and of the rays only those that
    /// hit the quad's box, by vectors.
    void _IntersectQuad(const Vec3f corners[4], const Box3f& box, float u, float v, float size,
                        int firstRay) {
        ++_statistics.finalIntersections;
        const Tag d;
        const int lanes = static_cast<int>(hn::Lanes(d));
        const float longest =
            std::max(Length(corners[2] - corners[0]), Length(corners[3] - corners[1]));
        for (int group = firstRay - firstRay % lanes; group < _rays.rays.count; group += lanes) {
            if (hn::AllFalse(d, RaysHitBox(d, _rays.rays, group, box))) {
                continue;
            }
            _statistics.activeLanes += lanes;
            const RayLanes<Tag> rays(d, _rays.rays, group);
            const auto slack = hn::Mul(hn::Set(d, 2 * _tolerance * longest),
                                       hn::Load(d, _rays.rays.length + group));
            const CornerLanes<Tag> c0(d, rays, corners[0]), c1(d, rays, corners[1]),
                c2(d, rays, corners[2]), c3(d, rays, corners[3]);
            const auto tMin = hn::Load(d, _rays.rays.tMin + group);
            const auto lower = IntersectTriangle(d, rays, c0, c1, c2, slack, tMin,
                                                 hn::Load(d, _rays.rays.tMax + group));
            _isShortened |= _Record(group, lower, u, v, size, true);
            const auto upper = IntersectTriangle(d, rays, c0, c2, c3, slack, tMin,
                                                 hn::Load(d, _rays.rays.tMax + group));
            _isShortened |= _Record(group, upper, u, v, size, false);
        }
    }

    /// Notes the hits of a group of rays on a triangle, where they are nearer than what the rays
    /// have. The triangle is (0,0) (1,0) (1,1) of the quad if isLower is set, else (0,0) (1,1)
    /// (0,1).
    bool _Record(int group, const TriangleHit<Tag>& hit, float u, float v, float size,
                 bool isLower) {
        const Tag d;
        if (hn::AllFalse(d, hit.hit)) {
            return false;
        }
        float* tMax = _rays.rays.tMax + group;
        if (kAnyHit) {
            _doneRays += static_cast<int>(hn::CountTrue(d, hit.hit));
            hn::Store(hn::IfThenElse(hit.hit, hn::Set(d, -1.0f), hn::Load(d, tMax)), d, tMax);
            return true;
        }
        hn::Store(hn::IfThenElse(hit.hit, hit.t, hn::Load(d, tMax)), d, tMax);
        const auto both = hn::Min(hn::Add(hit.weightB, hit.weightC), hn::Set(d, 1.0f));
        const auto quadU = isLower ? both : hit.weightB;
        const auto quadV = isLower ? hit.weightC : both;
        const auto scale = hn::Set(d, size);
        hn::Store(hn::IfThenElse(hit.hit, hn::Add(hn::Set(d, u), hn::Mul(scale, quadU)),
                                 hn::Load(d, _hits->u + group)),
                  d, _hits->u + group);
        hn::Store(hn::IfThenElse(hit.hit, hn::Add(hn::Set(d, v), hn::Mul(scale, quadV)),
                                 hn::Load(d, _hits->v + group)),
                  d, _hits->v + group);
        const hn::RebindToUnsigned<Tag> du;
        const auto mask = hn::RebindMask(du, hit.hit);
        hn::Store(hn::IfThenElse(mask, hn::Set(du, _patch), hn::Load(du, _hits->patch + group)), du,
                  _hits->patch + group);
        hn::Store(
            hn::IfThenElse(mask, hn::Set(du, _instance), hn::Load(du, _hits->instance + group)), du,
            _hits->instance + group);
        return true;
    }

    const Surface& _surface;
    const uint32_t _instance;
    const int _level;
    Rays& _rays;
    HitPacket* const _hits;
    TraceStatistics& _statistics;

    uint32_t _patch = 0;
    float _tolerance = 0;
    int _doneRays = 0;
    bool _isShortened = false;
    std::vector<Vec3f> _ring;
};

}  // namespace HWY_NAMESPACE
}  // namespace cc
HWY_AFTER_NAMESPACE();

#endif
