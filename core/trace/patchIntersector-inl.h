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
#include "core/subdiv/limitGrid.h"
#include "core/subdiv/limitPoint.h"
#include "core/trace/bezierRows-inl.h"
#include "core/trace/gridFrame-inl.h"
#include "core/trace/instanceLevels.h"
#include "core/trace/limitGrid-inl.h"
#include "core/trace/patchRays-inl.h"
#include "core/trace/patchSquare.h"
#include "core/trace/quadWindow-inl.h"
#include "core/trace/rayPacket.h"
#include "core/trace/remoteRays.h"
#include "core/trace/sharedGrids.h"
#include "core/trace/surface.h"
#include "core/trace/traversal-inl.h"
#include "core/trace/triangleIntersector-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cc {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

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

/// The same for a limit grid.
inline void TurnGrid(const LimitGrid& from, int corner, LimitGrid* to) {
    const int side = to->side = from.side;
    for (int axis = 0; axis < 3; ++axis) {
        for (int i = 0; i <= side; ++i) {
            for (int j = 0; j <= side; ++j) {
                const int row = corner == 0   ? i
                                : corner == 1 ? j
                                : corner == 2 ? side - i
                                              : side - j;
                const int column = corner == 0   ? j
                                   : corner == 1 ? side - i
                                   : corner == 2 ? side - j
                                                 : i;
                to->points[axis][row][column] = from.points[axis][i][j];
            }
        }
    }
    to->Fill();
}

/// Part of a patch: its rows run along u if isTransposed is set, else along v (see SplitPatch).
struct SubPatch {
    BezierRows bezier;
    Square square;
    int splits;        ///< left until its quads
    uint64_t hitting;  ///< a bit for each ray that may hit it
    bool isTransposed;
};

/// Intersects rays with the patches of one surface. Where a patch is finer than a limit grid, its
/// parts are culled or split, depth first, as in Algorithm 1 of the paper; then the grid of a part
/// is evaluated at once, and of its blocks of quads only those that rays reach are intersected. The
/// control points are kept in Bezier form, whose hull is tight and whose corners are limit
/// positions.
///
/// Packets of a batch mostly meet the patches that the packets before them met: they share grids.
/// @tparam Rays     PacketRays or SingleRay
/// @tparam kAnyHit  rays end at whatever they hit first, and hits are not recorded
template <class Rays, bool kAnyHit>
class PatchIntersector {
  public:
    /// @param number  of the instance, as hits give it
    /// @param grids   null if nothing is shared
    PatchIntersector(const Instance& instance, uint32_t number, const LevelMetric& levels,
                     Rays* rays, HitPacket* hits, SharedGrids* grids, TraceStatistics* statistics)
        : _surface(SurfaceOf(instance)),
          _instance(number),
          _isRemote(levels.HasRemote() && IsRemote(SurfaceOf(instance), rays->rays)),
          _levels(levels, instance, _isRemote),
          _rays(*rays),
          _hits(hits),
          _grids(grids),
          _statistics(*statistics),
          _triangles(_surface, number, _levels.Uniform(), rays, hits, statistics, &_doneRays) {
        for (int i = 0; i < rays->rays.count; ++i) {
            _doneRays += rays->rays.tMax[i] < rays->rays.tMin[i];
        }
    }

    /// @param hitting  a bit for each ray that hits the patch's box
    void Intersect(uint32_t patch, uint64_t hitting, const Box3f& box) {
        _isShortened = false;
        _IntersectPatch(patch, hitting, box);
        if (_isShortened) {
            _rays.Shortened();
        }
    }

    /// True if every ray is done: only any-hit rays are, before the traversal is.
    bool IsDone() const { return kAnyHit && _rays.rays.count == _doneRays; }

  private:
    using Tag = typename Rays::Tag;
    static constexpr int kMaxSplits = 8;
    /// How far fans may be from the quads that they stand for, by how far their borders are.
    static constexpr float kStitchMargin = 2;

    void _IntersectPatch(uint32_t patch, uint64_t hitting, const Box3f& box) {
        ++_statistics.leafIntersections;
        _patch = patch;
        const PatchTable& patches = _surface.Patches();
        const Patch& p = patches.At(patch);
        if (patches.IsTriangle(patch)) {
            _isShortened |= _triangles.Intersect(patch, __builtin_ctzll(hitting));
            return;
        }
        const int splits = _FindLevels(patch) - p.depth;
        const Square whole{0, 0, 1};
        if (p.kind == PatchKind::Regular || p.kind == PatchKind::Bilinear) {
            // Neighbours that are not split evaluate their common points in another way.
            _tolerance =
                _isStitched && splits > kMaxGridSplits ? RoundingTolerance(&box.lower, 2) : 0;
            if (splits <= kMaxGridSplits) {
                EvaluatedGrid& grid = _GridAt(whole);
                if (!_Holds(grid, whole)) {
                    _GatherBezier(p, &grid.bezier);
                    _BeginBezier({whole, false}, splits, &grid);
                }
                _IntersectGrid(&grid, hitting);
            } else {
                BezierRows bezier;
                _GatherBezier(p, &bezier);
                _IntersectBezier(bezier, whole, splits, hitting);
            }
            return;
        }
        _tolerance = RoundingTolerance(&box.lower, 2);
        const LimitGridPlan* plan = _surface.Plans().Of(patch);
        if (plan && splits <= kPlanSplits) {
            EvaluatedGrid& grid = _GridAt(whole);
            if (!_Holds(grid, whole)) {
                _EvaluatePlanned(*plan, splits, &grid.points);
                _BeginWhole(whole, &grid);
            }
            _IntersectGrid(&grid, hitting);
            return;
        }
        _tolerance *= 2;  // every step rounds
        const bool isTile = _isStitched && splits <= kMaxGridSplits;
        if (isTile ? _IntersectHeld(whole, hitting) : _IntersectHeldQuarters(whole, hitting)) {
            return;
        }
        if (p.kind == PatchKind::Extraordinary) {
            ExtraordinaryPatch::Points points;
            _GatherExtraordinary(patches, &points);
            _IntersectExtraordinary(ExtraordinaryPatch(points.data(), p.valence), 0, whole, splits,
                                    hitting);
        } else {
            _IntersectIrregular(GatherIrregular(patches, patch, _surface.PatchPoints().data()),
                                whole, splits, hitting);
        }
    }

    /// Finds the levels of a patch; returns the finest.
    int _FindLevels(uint32_t patch) {
        if (_levels.IsUniform()) {
            return _levels.Uniform();
        }
        if (_grids) {
            HeldLevels& held = _grids->LevelsAt(_instance, patch);
            if (held.instance != _instance || held.patch != patch || held.isRemote != _isRemote) {
                held = {_instance, patch, _isRemote, _levels.Of(patch)};
            }
            _patchLevels = held.levels;
        } else {
            _patchLevels = _levels.Of(patch);
        }
        _isStitched = !_patchLevels.AreEqual();
        return _patchLevels.Finest();
    }

    /// Intersects rays with a part of an irregular patch that must be stitched. Its grid is as
    /// large as a grid may be, so that it has both ends of what its borders are joined to.
    /// @param part    an ExtraordinaryPatch or IrregularPatch
    /// @param corner  of the square that the part's (0,0) is at
    template <class Part>
    void _IntersectTile(const Part& part, int corner, const Square& square, int splits,
                        uint64_t hitting) {
        EvaluatedGrid& grid = _GridAt(square);
        if (!_Holds(grid, square)) {
            constexpr int kStride = kMaxGridSide + 1;
            Vec3f points[kStride * kStride];
            LimitGrid unturned;
            const int side = unturned.side = 1 << splits;
            EvaluateLimitGrid(part, {points, kStride, side});
            for (int row = 0; row <= side; ++row) {
                for (int column = 0; column <= side; ++column) {
                    for (int axis = 0; axis < 3; ++axis) {
                        unturned.points[axis][row][column] = points[kStride * row + column][axis];
                    }
                }
            }
            TurnGrid(unturned, corner, &grid.points);
            _BeginWhole(square, &grid);
        }
        _IntersectGrid(&grid, hitting);
    }

    /// Intersects rays with the grid of a square, if the batch has it.
    bool _IntersectHeld(const Square& square, uint64_t hitting) {
        if (!_Holds(_GridAt(square), square)) {
            return false;
        }
        _IntersectGrid(&_GridAt(square), hitting);
        return true;
    }

    void _GatherBezier(const Patch& patch, BezierRows* bezier) const {
        const Vec3f* const points = _surface.PatchPoints().data();
        if (patch.kind == PatchKind::Regular) {
            GatherRegular(_surface.Patches(), _patch, points, bezier);
        } else {
            *bezier = BezierRows(GatherBezier(_surface.Patches(), _patch, points));
        }
    }

    void _EvaluatePlanned(const LimitGridPlan& plan, int splits, LimitGrid* grid) {
        ControlPoints indices;
        GatherControlPoints(_surface.Patches(), _patch, &indices);
        const Vec3f* const points = _surface.PatchPoints().data();
        _EvaluatePlan(
            plan, [&](size_t i) { return points[indices[plan.Picks()[i]]]; }, splits, grid);
    }

    /// @param pick  returns the control point of a pick
    template <class Pick>
    HWY_INLINE void _EvaluatePlan(const LimitGridPlan& plan, const Pick& pick, int splits,
                                  LimitGrid* grid) {
        const size_t count = plan.Picks().size();
        InlineVector<float, 3 * 40> coordinates;
        coordinates.resize(3 * count);
        float* const relative[3] = {coordinates.begin(), coordinates.begin() + count,
                                    coordinates.begin() + 2 * count};
        const Vec3f base = pick(0);
        for (size_t i = 0; i < count; ++i) {
            const Vec3f p = pick(i) - base;
            relative[0][i] = p.x;
            relative[1][i] = p.y;
            relative[2][i] = p.z;
        }
        EvaluateGrid(plan, base, relative, splits, grid);
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
                                 uint64_t hitting) {
        const LimitGridPlan* plan = _surface.Plans().OfValence(patch.Valence());
        for (; splits > 0; --splits) {
            if (_isStitched && splits <= kMaxGridSplits) {
                _IntersectTile(patch, corner, square, splits, hitting);
                return;
            }
            if (plan && splits <= kPlanSplits) {
                EvaluatedGrid& shared = _GridAt(square);
                LimitGrid grid;
                const auto& points = patch.ControlPoints();
                _EvaluatePlan(*plan, [&](size_t i) { return points[i]; }, splits, &grid);
                TurnGrid(grid, corner, &shared.points);
                _BeginWhole(square, &shared);
                _IntersectGrid(&shared, hitting);
                return;
            }
            Box3f box;
            for (const Vec3f& p : patch.ControlPoints()) {
                box.Extend(p);
            }
            hitting = _RaysIn(_Widened(box), hitting);
            if (hitting == 0 || _IntersectHeldQuarters(square, hitting)) {
                return;
            }
            ++_statistics.subdivisionsIrregular;
            ExtraordinaryPatch::RegularQuarters quarters;
            patch.Subdivide(&quarters);
            for (int i = 0; i < 3; ++i) {
                Vec3f points[16];
                TurnGrid(quarters.points[i], corner, points);
                _IntersectBSpline(points, square.Quarter(corner + 1 + i), splits - 1, hitting);
            }
            square = square.Quarter(corner);
        }
        Vec3f corners[4], turned[4];
        patch.LimitCorners(corners);
        for (int i = 0; i < 4; ++i) {
            turned[(i + corner) & 3] = corners[i];
        }
        _IntersectLimitQuad(turned, square, hitting);
    }

    void _IntersectIrregular(const IrregularPatch& patch, Square square, int splits,
                             uint64_t hitting) {
        Vec3f bspline[16];
        if (patch.ToBSpline(bspline)) {
            _IntersectBSpline(bspline, square, splits, hitting);
            return;
        }
        ExtraordinaryPatch::Points points;
        const int corner = patch.ToExtraordinary(&points);
        if (corner >= 0) {
            const ExtraordinaryPatch turned(points.data(), patch.rings[corner].FaceCount());
            _IntersectExtraordinary(turned, corner, square, splits, hitting);
            return;
        }
        if (splits == 0) {
            Vec3f corners[4];
            patch.LimitCorners(corners);
            _IntersectLimitQuad(corners, square, hitting);
            return;
        }
        if (_isStitched && splits <= kMaxGridSplits) {
            _IntersectTile(patch, 0, square, splits, hitting);
            return;
        }
        hitting = _RaysIn(_Widened(patch.HullBox()), hitting);
        if (hitting == 0 || _IntersectHeldQuarters(square, hitting)) {
            return;
        }
        ++_statistics.subdivisionsIrregular;
        IrregularPatch quarters[4];
        patch.Subdivide(quarters);
        for (int i = 0; i < 4; ++i) {
            _IntersectIrregular(quarters[i], square.Quarter(i), splits - 1, hitting);
        }
    }

    /// Intersects rays with the grids of the quarters of a square, if the batch has all of them.
    bool _IntersectHeldQuarters(const Square& square, uint64_t hitting) {
        for (int i = 0; i < 4; ++i) {
            const Square quarter = square.Quarter(i);
            if (!_grids || !_Holds(_grids->At(_surface, _patch, quarter), quarter)) {
                return false;
            }
        }
        for (int i = 0; i < 4; ++i) {
            _IntersectGrid(&_GridAt(square.Quarter(i)), hitting);
        }
        return true;
    }

    void _IntersectLimitQuad(const Vec3f corners[4], const Square& square, uint64_t hitting) {
        LimitGrid& grid = _ownGrid.points;
        grid.side = 1;
        for (int axis = 0; axis < 3; ++axis) {
            grid.points[axis][0][0] = corners[0][axis];
            grid.points[axis][0][1] = corners[1][axis];
            grid.points[axis][1][1] = corners[2][axis];
            grid.points[axis][1][0] = corners[3][axis];
        }
        grid.Fill();
        _BeginWhole(square, &_ownGrid);
        _IntersectGrid(&_ownGrid, hitting);
    }

    /// Room for points that round out of the hull they are computed from.
    static Box3f _Widened(const Box3f& box) {
        return Widened(box, RoundingTolerance(&box.lower, 2));
    }

    /// A bit for each ray that hits a box, of those whose bit is set: culling by interval first.
    uint64_t _RaysIn(const Box3f& box, uint64_t among) const {
        ++_statistics.boxTests;
        if (_rays.Culls(box)) {
            ++_statistics.intervalCulls;
            return 0;
        }
        return RaysThatHit(Tag(), _rays.rays, among, box);
    }

    /// A regular part of a patch that is not. If it is a grid, it is one whether rays hit its hull
    /// or not, so that the next packet finds all quarters.
    void _IntersectBSpline(const Vec3f points[16], const Square& square, int splits,
                           uint64_t hitting) {
        const BezierRows bezier(BezierPatch::FromBSpline(points));
        if (splits <= kMaxGridSplits) {
            _IntersectPart({bezier, square, splits, hitting, false});
        } else {
            _IntersectBezier(bezier, square, splits, hitting);
        }
    }

    void _IntersectBezier(const BezierRows& bezier, const Square& square, int splits,
                          uint64_t hitting) {
        // Each split leaves at most three parts behind.
        SubPatch stack[3 * (kMaxSplits - kMaxGridSplits) + 1];
        int count = 0;
        stack[count++] = {bezier, square, splits, hitting, false};
        while (count > 0) {
            SubPatch part = stack[--count];
            part.hitting = _RaysIn(_Widened(HullBox(part.bezier)), part.hitting);
            if (part.hitting == 0) {
                continue;
            }
            if (part.splits <= kMaxGridSplits) {
                _IntersectPart(part);
            } else {
                ++_statistics.subdivisionsRegular;
                _PushQuarters(part, stack, &count);
            }
        }
    }

    void _PushQuarters(const SubPatch& part, SubPatch* stack, int* count) {
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
            stack[(*count)++] = {quarters[i], square.Quarter(corner), splits, part.hitting,
                                 !isTransposed};
        }
    }

    void _IntersectPart(const SubPatch& part) {
        EvaluatedGrid& grid = _GridAt(part.square);
        if (!_Holds(grid, part.square)) {
            grid.bezier = part.bezier;
            _BeginBezier({part.square, part.isTransposed}, part.splits, &grid);
        }
        _IntersectGrid(&grid, part.hitting);
    }

    /// Where a grid lies in its patch. If it is transposed, its columns run along v.
    struct GridPlace {
        Square square;
        bool isTransposed;
    };

    EvaluatedGrid& _GridAt(const Square& square) {
        return _grids ? _grids->At(_surface, _patch, square) : _ownGrid;
    }
    bool _Holds(const EvaluatedGrid& grid, const Square& square) const {
        return _grids && SharedGrids::Holds(grid, _surface, _patch, square) &&
               grid.levels == _patchLevels;
    }

    void _Place(const GridPlace& place, EvaluatedGrid* grid) const {
        grid->surface = &_surface;
        grid->patch = _patch;
        grid->square = place.square;
        grid->isTransposed = place.isTransposed;
        grid->tolerance = _tolerance;
        grid->levels = _patchLevels;
        grid->stitch = GridStitch();
        if (_isStitched) {
            _Stitch(grid);
        }
    }

    /// Joins a grid to the neighbours of the patch that are coarser.
    void _Stitch(EvaluatedGrid* grid) const {
        const int side = grid->points.side;
        grid->stitch = GridStitch(_patchLevels, grid->square, side, grid->isTransposed);
        if (grid->stitch.IsNeeded()) {
            _Require(0, std::max(side, LimitGrid::kLeastRows), grid);
            grid->frame.Widen(kStitchMargin * grid->stitch.Apply(&grid->points));
            grid->points.Fill();
        }
    }

    /// Begins a grid whose Bezier patch is there: rows are evaluated when rays reach them.
    void _BeginBezier(const GridPlace& place, int splits, EvaluatedGrid* grid) const {
        const BezierRows& bezier = grid->bezier;
        const Vec3f corners[4] = {bezier.Corner(0, 0), bezier.Corner(0, 1), bezier.Corner(1, 1),
                                  bezier.Corner(1, 0)};
        const int side = grid->points.side = 1 << splits;
        grid->frame = GridFrame(corners, side);
        MeasureDeviation(bezier, &grid->frame);
        grid->frame.Widen(_tolerance);
        grid->missingRows = (uint64_t(2) << std::max(side, LimitGrid::kLeastRows)) - 1;
        _Place(place, grid);
    }

    /// Begins a grid whose points are there.
    void _BeginWhole(const Square& square, EvaluatedGrid* grid) const {
        const LimitGrid& points = grid->points;
        const int side = points.side;
        const Vec3f corners[4] = {points.At(0, 0), points.At(0, side), points.At(side, side),
                                  points.At(side, 0)};
        grid->frame = GridFrame(corners, side);
        MeasureDeviation(points, &grid->frame);
        grid->frame.Widen(_tolerance);
        grid->missingRows = 0;
        _Place({square, false}, grid);
    }

    /// Evaluates rows of points that are not there yet.
    static HWY_INLINE void _Require(int first, int last, EvaluatedGrid* grid) {
        uint64_t missing = ((uint64_t(2) << last) - (uint64_t(1) << first)) & grid->missingRows;
        grid->missingRows &= ~missing;
        for (; missing != 0; missing &= missing - 1) {
            EvaluateRow(grid->bezier, __builtin_ctz(grid->points.side), __builtin_ctzll(missing),
                        &grid->points);
        }
    }

    /// @param hitting  a bit for each ray that may hit the grid
    void _IntersectGrid(EvaluatedGrid* grid, uint64_t hitting) {
        QuadRanges ranges;
        ++_statistics.boxTests;
        for (uint64_t rest = FindQuads(Tag(), grid->frame, _rays.rays, hitting, &ranges); rest != 0;
             rest &= rest - 1) {
            const int ray = __builtin_ctzll(rest);
            GridHit hit;
            hit.t = _rays.rays.tMax[ray];
            ++_statistics.activeLanes;
            _IntersectQuads(ray, ranges, grid, &hit);
            if (hit.triangle >= 0) {
                _Record(ray, hit, *grid);
            }
        }
    }

    HWY_INLINE void _IntersectQuads(int ray, const QuadRanges& ranges, EvaluatedGrid* grid,
                                    GridHit* hit) {
        const ShearedRay sheared(_rays.rays, ray);
        const int side = grid->points.side;
        const int lastRow = std::max(side - QuadWindow::kRows, 0);
        const int lastColumn = std::max(side - QuadWindow::kColumns, 0);
        int beginColumn = ranges.firstColumn[ray], endColumn = ranges.lastColumn[ray];
        int beginRow = ranges.firstRow[ray], endRow = ranges.lastRow[ray];
        if (grid->stitch.IsNeeded()) {
            grid->stitch.Widen(&beginColumn, &endColumn, &beginRow, &endRow);
        }
        for (int i = beginRow; i <= endRow; i += QuadWindow::kRows) {
            const int row = std::min(i, lastRow);
            _Require(row, row + QuadWindow::kRows, grid);
            for (int j = beginColumn; j <= endColumn; j += QuadWindow::kColumns) {
                ++_statistics.finalIntersections;
                QuadWindow(grid->points, std::min(j, lastColumn), row, grid->tolerance, sheared)
                    .Intersect(hit);
            }
        }
    }

    void _Record(int ray, const GridHit& hit, const EvaluatedGrid& grid) {
        _isShortened = true;
        if (kAnyHit) {
            ++_doneRays;
            _rays.rays.tMax[ray] = -1;
            return;
        }
        _rays.rays.tMax[ray] = hit.t;
        _hits->instance[ray] = _instance;
        _hits->patch[ray] = _patch;
        const Square& square = grid.square;
        const float scale = square.size / static_cast<float>(grid.points.side);
        float u = hit.u, v = hit.v;
        if (grid.stitch.IsNeeded()) {
            grid.stitch.ToUnmoved(hit.triangle, &u, &v);
        }
        _hits->u[ray] = square.u + scale * (grid.isTransposed ? v : u);
        _hits->v[ray] = square.v + scale * (grid.isTransposed ? u : v);
    }

    const Surface& _surface;
    const uint32_t _instance;
    const bool _isRemote;
    const InstanceLevels _levels;
    Rays& _rays;
    HitPacket* const _hits;
    SharedGrids* const _grids;
    TraceStatistics& _statistics;

    EvaluatedGrid _ownGrid;  ///< what is not shared

    uint32_t _patch = 0;
    PatchLevels _patchLevels;
    bool _isStitched = false;
    float _tolerance = 0;
    int _doneRays = 0;
    bool _isShortened = false;
    TriangleIntersector<Rays, kAnyHit> _triangles;
};

}  // namespace HWY_NAMESPACE
}  // namespace cc
HWY_AFTER_NAMESPACE();

#endif
