// Per-target include guard, as Highway's foreach_target asks for.
#if defined(CC_TRACE_ALGORITHM1_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CC_TRACE_ALGORITHM1_INL_H
#undef CC_TRACE_ALGORITHM1_INL_H
#else
#define CC_TRACE_ALGORITHM1_INL_H
#endif

#include <algorithm>

#include <hwy/highway.h>

#include "core/subdiv/irregularPatch.h"
#include "core/trace/packetTriangles-inl.h"
#include "core/trace/patchRays-inl.h"
#include "core/trace/surface.h"
#include "core/trace/textureHits.h"
#include "core/trace/traversal-inl.h"
#include "core/trace/triangleIntersector-inl.h"
#include "core/trace/tuplePatch-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cc {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// A vector of a tuple, at a point of the mesh: its position, or the texture coordinates that a
/// projection along z gives it.
inline Vec3f TupleValue(const Vec3f& position, int vector) {
    return vector == 0 ? position : Vec3f{position.x, position.y, 0};
}

template <int kVectors>
Tuple<kVectors> ToTuple(const Vec3f& position) {
    Tuple<kVectors> tuple;
    for (int i = 0; i < kVectors; ++i) {
        const Vec3f value = TupleValue(position, i);
        tuple.lanes[i][0] = value.x;
        tuple.lanes[i][1] = value.y;
        tuple.lanes[i][2] = value.z;
        tuple.lanes[i][3] = 0;
    }
    return tuple;
}

/// A quad with tags, whose refinement is not a matter of fixed weights: all vectors of its tuples
/// are refined one after the other.
template <int kVectors>
struct IrregularTuplePatch {
    IrregularPatch vectors[kVectors];

    static IrregularTuplePatch From(const IrregularPatch& positions) {
        IrregularTuplePatch patch;
        for (int i = 0; i < kVectors; ++i) {
            patch.vectors[i] = positions;
            for (VertexRing& ring : patch.vectors[i].rings) {
                const auto convert = [i](Vec3f& p) { p = TupleValue(p, i); };
                convert(ring.center);
                std::for_each(ring.edges.begin(), ring.edges.end(), convert);
                std::for_each(ring.diagonals.begin(), ring.diagonals.end(), convert);
            }
        }
        return patch;
    }

    void Subdivide(IrregularTuplePatch quarters[4]) const {
        for (int i = 0; i < kVectors; ++i) {
            IrregularPatch parts[4];
            vectors[i].Subdivide(parts);
            for (int part = 0; part < 4; ++part) {
                quarters[part].vectors[i] = std::move(parts[part]);
            }
        }
    }

    void LimitCorners(Tuple<kVectors> corners[4]) const {
        Vec3f values[kVectors][4];
        for (int i = 0; i < kVectors; ++i) {
            vectors[i].LimitCorners(values[i]);
        }
        Join(values[0], 4, corners);
    }

    /// As IrregularPatch::ToBSpline.
    bool ToRegular(RegularTuplePatch<kVectors>* regular) const {
        Vec3f values[kVectors][16];
        for (int i = 0; i < kVectors; ++i) {
            if (!vectors[i].ToBSpline(values[i])) {
                return false;
            }
        }
        Join(values[0], 16, regular->points);
        return true;
    }

    /// As IrregularPatch::ToExtraordinary.
    int ToExtraordinary(typename ExtraordinaryTuplePatch<kVectors>::Points* points) const {
        ExtraordinaryPatch::Points values;
        int corner = -1;
        for (int i = 0; i < kVectors; ++i) {
            values.resize(0);
            corner = vectors[i].ToExtraordinary(&values);
            if (corner < 0) {
                break;
            }
            points->resize(values.size());
            for (size_t p = 0; p < values.size(); ++p) {
                SetVector(values[p], i, &(*points)[p]);
            }
        }
        return corner;
    }

  private:
    static void SetVector(const Vec3f& value, int vector, Tuple<kVectors>* tuple) {
        float* lanes = tuple->lanes[vector];
        lanes[0] = value.x;
        lanes[1] = value.y;
        lanes[2] = value.z;
        lanes[3] = 0;
    }
    /// Tuples of values that lie vector by vector.
    static void Join(const Vec3f* values, int count, Tuple<kVectors>* tuples) {
        for (int i = 0; i < kVectors; ++i) {
            for (int p = 0; p < count; ++p) {
                SetVector(values[i * count + p], i, &tuples[p]);
            }
        }
    }
};

/// A packet whose rays are tested four at a time, as the paper tests them.
struct TupleRays : PacketRays {
    using Tag = TupleTag;
    using PacketRays::PacketRays;
};

/// Algorithm 1 of the paper as it was published: a packet of 64 rays against a patch that is
/// subdivided by the Catmull-Clark rules, depth first, one control point a SIMD vector. A part's
/// bound is the box of its 1-ring; it is culled by interval arithmetic, then entered if its first
/// active ray hits, or else the next that does.
///
/// Two things differ, so that all tracers see one surface: the vertices of the last quads are
/// pushed to the limit, and the edge tests of their triangles have the slack that makes
/// neighbouring patches watertight. Patches are found by the BVH that all tracers share, which is
/// wider than the paper's. Creases, which the paper leaves open, are IrregularPatch's, and the
/// triangles of the Loop scheme, of which it says as little, are TriangleIntersector's: those have
/// no texture coordinates.
/// @tparam kVectors  1: 4-tuples; 2: 8-tuples, which carry texture coordinates along
/// @tparam kAnyHit   rays end at whatever they hit first, and hits are not recorded
template <int kVectors, bool kAnyHit>
class Algorithm1 {
  public:
    /// @param texture  what 8-tuples give for each hit; else null
    Algorithm1(const Surface& surface, uint32_t instance, int level, TupleRays* rays,
               HitPacket* hits, TextureHits* texture, TraceStatistics* statistics)
        : _surface(surface),
          // Quads of a mesh must meet at one level.
          _level(std::max(level, surface.Patches().MaxDepth())),
          _rays(*rays),
          _texture(texture),
          _statistics(*statistics),
          _triangles(instance, &rays->rays, hits, statistics),
          _loop(surface, instance, _level, rays, hits, statistics, _triangles.DoneRays()) {}

    void Intersect(uint32_t patch, int firstRay) {
        _isShortened = false;
        _IntersectPatch(patch, firstRay);
        if (_isShortened) {
            _rays.Shortened();
        }
    }

    bool IsDone() const { return _triangles.IsDone(); }

  private:
    using Point = Tuple<kVectors>;
    using Regular = RegularTuplePatch<kVectors>;
    using Extraordinary = ExtraordinaryTuplePatch<kVectors>;
    using Irregular = IrregularTuplePatch<kVectors>;
    static constexpr int kMaxSplits = 8;

    /// What waits on the stack: a part, and how often it is to be split yet.
    struct Part {
        Regular patch;
        Square square;
        int splits;
        int firstRay;
    };

    void _IntersectPatch(uint32_t patch, int firstRay) {
        ++_statistics.leafIntersections;
        _patch = patch;
        const Patch& p = _surface.Patches().At(patch);
        const int splits = _level - p.depth;
        const Square whole{0, 0, 1};
        switch (p.kind) {
            case PatchKind::Regular:
            case PatchKind::Bilinear: {
                const Regular regular =
                    p.kind == PatchKind::Regular ? _GatherRegular() : _GatherBilinear();
                _SetTolerance(regular.Bounds());
                _IntersectRegular(regular, whole, splits, firstRay);
                break;
            }
            case PatchKind::Extraordinary: {
                const Extraordinary extraordinary = _GatherExtraordinary(p.valence);
                _SetTolerance(extraordinary.Bounds());
                _IntersectExtraordinary(extraordinary, 0, whole, splits, firstRay);
                break;
            }
            case PatchKind::Irregular: {
                const IrregularPatch irregular =
                    GatherIrregular(_surface.Patches(), patch, _surface.PatchPoints().data());
                _SetTolerance(irregular.HullBox());
                _IntersectIrregular(Irregular::From(irregular), whole, splits, firstRay);
                break;
            }
            case PatchKind::RegularTriangle:
            case PatchKind::IrregularTriangle:
            case PatchKind::FlatTriangle: _isShortened = _loop.Intersect(patch, firstRay); break;
        }
    }

    Vec3f _PatchPoint(int i) const {
        return _surface.PatchPoints()[_surface.Patches().Indices(_patch)[i]];
    }

    Regular _GatherRegular() const {
        Regular regular;
        for (int i = 0; i < 16; ++i) {
            regular.points[i] = ToTuple<kVectors>(_PatchPoint(i));
        }
        return regular;
    }

    /// A bilinear quad is the B-spline whose control points continue its parameters beyond it.
    Regular _GatherBilinear() const {
        const Vec3f low = _PatchPoint(0), high = _PatchPoint(3);
        const Vec3f alongLow = _PatchPoint(1) - low, alongHigh = _PatchPoint(2) - high;
        Regular regular;
        for (int row = 0; row < 4; ++row) {
            for (int column = 0; column < 4; ++column) {
                const float u = static_cast<float>(column - 1), v = static_cast<float>(row - 1);
                regular.points[4 * row + column] =
                    ToTuple<kVectors>((low + alongLow * u) * (1 - v) + (high + alongHigh * u) * v);
            }
        }
        return regular;
    }

    Extraordinary _GatherExtraordinary(int valence) const {
        typename Extraordinary::Points points;
        points.resize(_surface.Patches().IndexCount(_patch));
        for (size_t i = 0; i < points.size(); ++i) {
            points[i] = ToTuple<kVectors>(_PatchPoint(static_cast<int>(i)));
        }
        return Extraordinary(std::move(points), valence);
    }

    /// @param hull  holds all control points
    void _SetTolerance(const Box3f& hull) { _tolerance = RoundingTolerance(&hull.lower, 2); }

    /// The loop of Algorithm 1.
    void _IntersectRegular(const Regular& regular, const Square& square, int splits, int firstRay) {
        // Each split leaves at most three parts behind.
        Part stack[3 * kMaxSplits + 1];
        int count = 0;
        stack[count++] = {regular, square, splits, firstRay};
        while (count > 0) {
            const Part part = stack[--count];
            const Box3f box = Widened(part.patch.Bounds(), _tolerance);
            const int first = _FirstRay(box, part.firstRay);
            if (first >= _rays.rays.count) {
                continue;
            }
            if (part.splits == 0) {
                Point corners[4];
                part.patch.LimitCorners(corners);
                _IntersectQuad(corners, box, part.square, first);
                continue;
            }
            ++_statistics.subdivisionsRegular;
            Point refined[5][5];
            part.patch.Refine(refined);
            for (int corner = 0; corner < 4; ++corner) {
                const int row = corner >= 2, column = corner == 1 || corner == 2;
                stack[count++] = {Regular::Part(refined, row, column), part.square.Quarter(corner),
                                  part.splits - 1, first};
            }
        }
    }

    /// Each step leaves three regular quarters; the one with the extraordinary vertex comes last.
    /// @param corner  of the square that the vertex is at
    void _IntersectExtraordinary(Extraordinary patch, int corner, Square square, int splits,
                                 int firstRay) {
        Box3f box;
        for (;; --splits) {
            box = Widened(patch.Bounds(), _tolerance);
            firstRay = _FirstRay(box, firstRay);
            if (firstRay >= _rays.rays.count) {
                return;
            }
            if (splits == 0) {
                break;
            }
            ++_statistics.subdivisionsIrregular;
            Regular quarters[3];
            patch.Subdivide(quarters);
            for (int i = 0; i < 3; ++i) {
                _IntersectRegular(quarters[i].Turned(corner), square.Quarter(corner + 1 + i),
                                  splits - 1, firstRay);
            }
            square = square.Quarter(corner);
        }
        Point corners[4], turned[4];
        patch.LimitCorners(corners);
        for (int i = 0; i < 4; ++i) {
            turned[(i + corner) & 3] = corners[i];
        }
        _IntersectQuad(turned, box, square, firstRay);
    }

    void _IntersectIrregular(const Irregular& patch, const Square& square, int splits,
                             int firstRay) {
        Regular regular;
        if (patch.ToRegular(&regular)) {
            _IntersectRegular(regular, square, splits, firstRay);
            return;
        }
        typename Extraordinary::Points points;
        const int corner = patch.ToExtraordinary(&points);
        if (corner >= 0) {
            const int valence = patch.vectors[0].rings[corner].FaceCount();
            _IntersectExtraordinary(Extraordinary(std::move(points), valence), corner, square,
                                    splits, firstRay);
            return;
        }
        const Box3f box = Widened(patch.vectors[0].HullBox(), _tolerance);
        firstRay = _FirstRay(box, firstRay);
        if (firstRay >= _rays.rays.count) {
            return;
        }
        if (splits == 0) {
            Point corners[4];
            patch.LimitCorners(corners);
            _IntersectQuad(corners, box, square, firstRay);
            return;
        }
        ++_statistics.subdivisionsIrregular;
        Irregular quarters[4];
        patch.Subdivide(quarters);
        for (int i = 0; i < 4; ++i) {
            _IntersectIrregular(quarters[i], square.Quarter(i), splits - 1, firstRay);
        }
    }

    /// Interval arithmetic, then the first-hit test, then the search for any other ray that hits a
    /// box (paper, section 3.4). Returns the first that does, or the packet's count.
    int _FirstRay(const Box3f& box, int firstRay) const {
        return FirstRayIn(_rays, box, firstRay, &_statistics);
    }

    void _IntersectQuad(const Point corners[4], const Box3f& box, const Square& square,
                        int firstRay) {
        const Vec3f positions[4] = {corners[0].Position(), corners[1].Position(),
                                    corners[2].Position(), corners[3].Position()};
        const SurfaceQuad quad(positions, square);
        const bool isHit = _triangles.Intersect(
            quad.triangles, 2, _patch, _tolerance, box, firstRay,
            [&](int group, const TriangleHit<TupleTag>& hit, int triangle) {
                if constexpr (kVectors == 2) {
                    const Point& b = corners[1 + triangle];
                    const Point& c = corners[2 + triangle];
                    _RecordTexture(group, hit, 0, corners[0], b, c, _texture->s);
                    _RecordTexture(group, hit, 1, corners[0], b, c, _texture->t);
                }
            });
        _isShortened = isHit || _isShortened;
    }

    /// A texture coordinate at the hits on the triangle a, b, c.
    void _RecordTexture(int group, const TriangleHit<TupleTag>& hit, int coordinate, const Point& a,
                        const Point& b, const Point& c, float* coordinates) const {
        const TupleTag d;
        const auto along = [&](const Point& from, const Point& to, hn::Vec<TupleTag> weight) {
            const float difference =
                to.lanes[kVectors - 1][coordinate] - from.lanes[kVectors - 1][coordinate];
            return hn::Mul(hn::Set(d, difference), weight);
        };
        const auto value = hn::Add(hn::Set(d, a.lanes[kVectors - 1][coordinate]),
                                   hn::Add(along(a, b, hit.weightB), along(a, c, hit.weightC)));
        hn::Store(hn::IfThenElse(hit.hit, value, hn::Load(d, coordinates + group)), d,
                  coordinates + group);
    }

    const Surface& _surface;
    const int _level;
    TupleRays& _rays;
    TextureHits* const _texture;
    TraceStatistics& _statistics;
    PacketTriangles<TupleTag, kAnyHit> _triangles;
    TriangleIntersector<TupleRays, kAnyHit> _loop;

    uint32_t _patch = 0;
    float _tolerance = 0;
    bool _isShortened = false;
};

}  // namespace HWY_NAMESPACE
}  // namespace cc
HWY_AFTER_NAMESPACE();

#endif
