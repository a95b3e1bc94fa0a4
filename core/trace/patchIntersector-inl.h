// Per-target include guard, as Highway's foreach_target asks for.
#if defined(CC_TRACE_PATCH_INTERSECTOR_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CC_TRACE_PATCH_INTERSECTOR_INL_H
#undef CC_TRACE_PATCH_INTERSECTOR_INL_H
#else
#define CC_TRACE_PATCH_INTERSECTOR_INL_H
#endif

#include <algorithm>
#include <cmath>

#include <hwy/highway.h>

#include "core/subdiv/extraordinaryPatch.h"
#include "core/subdiv/irregularPatch.h"
#include "core/trace/bezierRows-inl.h"
#include "core/trace/patchRays-inl.h"
#include "core/trace/quadBlock-inl.h"
#include "core/trace/quadIntersection-inl.h"
#include "core/trace/rayPacket.h"
#include "core/trace/surface.h"
#include "core/trace/traversal-inl.h"
#include "core/trace/triangleIntersector-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cc {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// A square of a patch's parameters: its lower corner and its side.
struct Square {
    float u, v, size;

    /// The quarter at a corner, counted from (0,0) by (1,0) and (1,1) to (0,1), modulo four.
    Square Quarter(int corner) const {
        const float half = size * 0.5f;
        const int c = corner & 3;
        return {c == 1 || c == 2 ? u + half : u, c >= 2 ? v + half : v, half};
    }
};

/// Turns a 4x4 grid of points: what began at (0,0) then begins at a corner.
inline void TurnGrid(const Vec3f from[16], int corner, Vec3f to[16]) {
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4; ++j) {
            const int row = corner == 0 ? i : corner == 1 ? j : corner == 2 ? 3 - i : 3 - j;
            const int column = corner == 0 ? j : corner == 1 ? 3 - i : corner == 2 ? 3 - j : i;
            to[4 * row + column] = from[4 * i + j];
        }
    }
}

/// Part of a patch: its rows run along u if isTransposed is set, else along v (see SplitPatch).
struct SubPatch {
    BezierRows bezier;
    Square square;
    int splits;  ///< left until it is a quad
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
          _statistics(*statistics),
          _triangles(surface, instance, _level, rays, hits, statistics, &_doneRays) {
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
        if (patches.IsTriangle(patch)) {
            _isShortened |= _triangles.Intersect(patch, firstRay);
            return;
        }
        const int splits = _level - p.depth;
        const Square whole{0, 0, 1};
        if (p.kind == PatchKind::Extraordinary) {
            ExtraordinaryPatch::Points points;
            _GatherExtraordinary(patches, &points);
            _SetTolerance(points.data(), static_cast<int>(points.size()));
            _IntersectExtraordinary(ExtraordinaryPatch(points.data(), p.valence), 0, whole, splits,
                                    firstRay);
            return;
        }
        if (p.kind == PatchKind::Irregular) {
            const IrregularPatch irregular =
                GatherIrregular(patches, patch, _surface.PatchPoints().data());
            const Box3f hull = irregular.HullBox();
            _SetTolerance(&hull.lower, 2);
            _IntersectIrregular(irregular, whole, splits, firstRay);
            return;
        }
        const BezierPatch bezier = GatherBezier(patches, patch, _surface.PatchPoints().data());
        _SetTolerance(&bezier.points[0][0], 16);
        _IntersectBezier(bezier, whole, splits, firstRay);
    }

    void _SetTolerance(const Vec3f* points, int count) {
        _tolerance = RoundingTolerance(points, count);
    }

    void _GatherExtraordinary(const PatchTable& patches, ExtraordinaryPatch::Points* points) const {
        const uint32_t* indices = patches.Indices(_patch);
        points->resize(patches.IndexCount(_patch));
        for (size_t i = 0; i < points->size(); ++i) {
            (*points)[i] = _surface.PatchPoints()[indices[i]];
        }
    }

    /// Splits towards the extraordinary vertex: each step leaves three regular quarters, and in the
    /// end the quad at the vertex.
    /// @param corner  of the square (u, v, size) that the vertex is at
    void _IntersectExtraordinary(ExtraordinaryPatch patch, int corner, Square square, int splits,
                                 int firstRay) {
        for (; splits > 0; --splits) {
            Box3f box;
            for (const Vec3f& p : patch.ControlPoints()) {
                box.Extend(p);
            }
            firstRay = _FirstRay(_Widened(box), firstRay);
            if (firstRay >= _rays.rays.count) {
                return;
            }
            ++_statistics.subdivisionsIrregular;
            ExtraordinaryPatch::RegularQuarters quarters;
            patch.Subdivide(&quarters);
            for (int i = 0; i < 3; ++i) {
                Vec3f points[16];
                TurnGrid(quarters.points[i], corner, points);
                _IntersectBezier(BezierPatch::FromBSpline(points), square.Quarter(corner + 1 + i),
                                 splits - 1, firstRay);
            }
            square = square.Quarter(corner);
        }
        Vec3f corners[4], turned[4];
        patch.LimitCorners(corners);
        for (int i = 0; i < 4; ++i) {
            turned[(i + corner) & 3] = corners[i];
        }
        _IntersectLimitQuad(turned, square, firstRay);
    }

    void _IntersectIrregular(const IrregularPatch& patch, Square square, int splits, int firstRay) {
        Vec3f bspline[16];
        if (patch.ToBSpline(bspline)) {
            _IntersectBezier(BezierPatch::FromBSpline(bspline), square, splits, firstRay);
            return;
        }
        ExtraordinaryPatch::Points points;
        const int corner = patch.ToExtraordinary(&points);
        if (corner >= 0) {
            const ExtraordinaryPatch turned(points.data(), patch.rings[corner].FaceCount());
            _IntersectExtraordinary(turned, corner, square, splits, firstRay);
            return;
        }
        if (splits == 0) {
            Vec3f corners[4];
            patch.LimitCorners(corners);
            _IntersectLimitQuad(corners, square, firstRay);
            return;
        }
        firstRay = _FirstRay(_Widened(patch.HullBox()), firstRay);
        if (firstRay >= _rays.rays.count) {
            return;
        }
        ++_statistics.subdivisionsIrregular;
        IrregularPatch quarters[4];
        patch.Subdivide(quarters);
        for (int i = 0; i < 4; ++i) {
            _IntersectIrregular(quarters[i], square.Quarter(i), splits - 1, firstRay);
        }
    }

    /// A quad of the last level whose box has not been tested yet.
    void _IntersectLimitQuad(const Vec3f corners[4], const Square& square, int firstRay) {
        Box3f box;
        for (int i = 0; i < 4; ++i) {
            box.Extend(corners[i]);
        }
        _IntersectQuad(corners, _Widened(box), square, firstRay);
    }

    Box3f _Widened(const Box3f& box) const { return Widened(box, _tolerance); }

    int _FirstRay(const Box3f& box, int firstRay) const {
        return FirstRayIn(_rays, box, firstRay, &_statistics);
    }

    void _IntersectBezier(const BezierPatch& bezier, const Square& square, int splits,
                          int firstRay) {
        // Each split leaves at most three parts behind.
        SubPatch stack[3 * kMaxSplits + 1];
        int count = 0;
        stack[count++] = {BezierRows(bezier), square, splits, firstRay, false};
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
                _IntersectQuad(corners, box, part.square, first);
                continue;
            }
            if (part.splits == kBlockSplits) {
                _IntersectBlock(part, RaysIn(_rays, box, first));
                continue;
            }
            ++_statistics.subdivisionsRegular;
            _PushQuarters(part, first, stack, &count);
        }
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
            const Square& square = part.square;
            _hits->u[ray] = square.u + square.size * (part.isTransposed ? hit.v : hit.u);
            _hits->v[ray] = square.v + square.size * (part.isTransposed ? hit.u : hit.v);
        }
    }

    void _PushQuarters(const SubPatch& part, int firstRay, SubPatch* stack, int* count) {
        BezierRows quarters[4];
        SplitPatch(part.bezier, quarters);
        const Square square = part.square;
        const int splits = part.splits - 1;
        const bool isTransposed = part.isTransposed;
        for (int i = 0; i < 4; ++i) {
            const bool isHighRow = (i & 2) != 0, isHighColumn = (i & 1) != 0;
            const bool isHighU = isTransposed ? isHighRow : isHighColumn;
            const bool isHighV = isTransposed ? isHighColumn : isHighRow;
            const int corner = isHighV ? (isHighU ? 2 : 3) : (isHighU ? 1 : 0);
            stack[(*count)++] = {quarters[i], square.Quarter(corner), splits, firstRay,
                                 !isTransposed};
        }
    }

    /// The final intersection (paper, section 3.5): two triangles, and of the rays only those that
    /// hit the quad's box, by vectors.
    void _IntersectQuad(const Vec3f corners[4], const Box3f& box, const Square& square,
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
            _isShortened |= _Record(group, lower, square, true);
            const auto upper = IntersectTriangle(d, rays, c0, c2, c3, slack, tMin,
                                                 hn::Load(d, _rays.rays.tMax + group));
            _isShortened |= _Record(group, upper, square, false);
        }
    }

    /// Notes the hits of a group of rays on a triangle, where they are nearer than what the rays
    /// have. The triangle is (0,0) (1,0) (1,1) of the quad if isLower is set, else (0,0) (1,1)
    /// (0,1).
    bool _Record(int group, const TriangleHit<Tag>& hit, const Square& square, bool isLower) {
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
        const auto scale = hn::Set(d, square.size);
        hn::Store(hn::IfThenElse(hit.hit, hn::Add(hn::Set(d, square.u), hn::Mul(scale, quadU)),
                                 hn::Load(d, _hits->u + group)),
                  d, _hits->u + group);
        hn::Store(hn::IfThenElse(hit.hit, hn::Add(hn::Set(d, square.v), hn::Mul(scale, quadV)),
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
    TriangleIntersector<Rays, kAnyHit> _triangles;
};

}  // namespace HWY_NAMESPACE
}  // namespace cc
HWY_AFTER_NAMESPACE();

#endif
