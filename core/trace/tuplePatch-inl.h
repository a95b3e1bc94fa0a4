// Per-target include guard, as Highway's foreach_target asks for.
#if defined(CC_TRACE_TUPLE_PATCH_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CC_TRACE_TUPLE_PATCH_INL_H
#undef CC_TRACE_TUPLE_PATCH_INL_H
#else
#define CC_TRACE_TUPLE_PATCH_INL_H
#endif

#include <algorithm>
#include <utility>

#include <hwy/highway.h>

#include "core/math/box.h"
#include "core/math/inlineVector.h"

HWY_BEFORE_NAMESPACE();
namespace cc {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using TupleTag = hn::FixedTag<float, 4>;

/// A control point as the paper stores it (section 3.2): a 4-tuple, x y z and padding in one SIMD
/// vector, or an 8-tuple, with texture coordinates s t in a second one.
/// @tparam kVectors  1 or 2
template <int kVectors>
struct alignas(16) Tuple {
    float lanes[kVectors][4];

    Vec3f Position() const { return {lanes[0][0], lanes[0][1], lanes[0][2]}; }
};

/// The same in registers.
template <int kVectors>
struct TupleVector {
    hn::Vec<TupleTag> vectors[kVectors];

    TupleVector() = default;
    HWY_INLINE TupleVector(const Tuple<kVectors>& from) {  // NOLINT: a load, as conversions are
        for (int i = 0; i < kVectors; ++i) {
            vectors[i] = hn::Load(TupleTag(), from.lanes[i]);
        }
    }
    HWY_INLINE void Store(Tuple<kVectors>* to) const {
        for (int i = 0; i < kVectors; ++i) {
            hn::Store(vectors[i], TupleTag(), to->lanes[i]);
        }
    }

    friend HWY_INLINE TupleVector operator+(TupleVector a, const TupleVector& b) {
        for (int i = 0; i < kVectors; ++i) {
            a.vectors[i] = hn::Add(a.vectors[i], b.vectors[i]);
        }
        return a;
    }
    friend HWY_INLINE TupleVector operator*(TupleVector a, float s) {
        for (int i = 0; i < kVectors; ++i) {
            a.vectors[i] = hn::Mul(a.vectors[i], hn::Set(TupleTag(), s));
        }
        return a;
    }
};

/// The box of control points: by the nesting of refined meshes it holds the limit surface.
template <int kVectors>
HWY_INLINE Box3f BoxOfTuples(const Tuple<kVectors>* points, size_t count) {
    const TupleTag d;
    auto lower = hn::Load(d, points[0].lanes[0]), upper = lower;
    for (size_t i = 1; i < count; ++i) {
        const auto p = hn::Load(d, points[i].lanes[0]);
        lower = hn::Min(lower, p);
        upper = hn::Max(upper, p);
    }
    Tuple<1> low, high;
    hn::Store(lower, d, low.lanes[0]);
    hn::Store(upper, d, high.lanes[0]);
    Box3f box;
    box.lower = low.Position();
    box.upper = high.Position();
    return box;
}

// The Catmull-Clark rules (paper, section 2.1) for smooth vertices. Each sum pairs what mirrors and
// turns exchange, so that neighbouring patches compute the same bits for what they share.

template <class V>
HWY_INLINE V FacePoint(const V& a, const V& b, const V& c, const V& d) {
    return ((a + c) + (b + d)) * 0.25f;
}
template <class V>
HWY_INLINE V EdgePoint(const V& a, const V& b, const V& leftFace, const V& rightFace) {
    return ((a + b) + (leftFace + rightFace)) * 0.25f;
}

/// The 4x4 control points of a regular quad, rows along u (paper, Figure 2b).
template <int kVectors>
struct RegularTuplePatch {
    using Point = Tuple<kVectors>;
    using V = TupleVector<kVectors>;

    Point points[16];

    const Point& At(int row, int column) const { return points[4 * row + column]; }

    Box3f Bounds() const { return BoxOfTuples(points, 16); }

    /// One step: 9 face points, 12 edge points and 4 vertex points, as 5x5 points of the refined
    /// mesh.
    HWY_INLINE void Refine(Point refined[5][5]) const {
        V faces[3][3];
        for (int r = 0; r < 3; ++r) {
            for (int c = 0; c < 3; ++c) {
                faces[r][c] = FacePoint<V>(At(r, c), At(r, c + 1), At(r + 1, c + 1), At(r + 1, c));
                faces[r][c].Store(&refined[2 * r][2 * c]);
            }
        }
        for (int i = 0; i < 3; ++i) {
            for (int j = 1; j < 3; ++j) {
                EdgePoint<V>(At(j, i), At(j, i + 1), faces[j - 1][i], faces[j][i])
                    .Store(&refined[2 * j - 1][2 * i]);
                EdgePoint<V>(At(i, j), At(i + 1, j), faces[i][j - 1], faces[i][j])
                    .Store(&refined[2 * i][2 * j - 1]);
            }
        }
        for (int r = 1; r < 3; ++r) {
            for (int c = 1; c < 3; ++c) {
                const V edges = (V(At(r - 1, c)) + At(r + 1, c)) + (V(At(r, c - 1)) + At(r, c + 1));
                const V diagonals =
                    (faces[r - 1][c - 1] + faces[r][c]) + (faces[r - 1][c] + faces[r][c - 1]);
                (V(At(r, c)) * 0.5f + (edges + diagonals) * (1 / 16.0f))
                    .Store(&refined[2 * r - 1][2 * c - 1]);
            }
        }
    }

    /// The 4x4 points of refined ones that begin at a row and a column.
    static RegularTuplePatch Part(const Point refined[5][5], int row, int column) {
        RegularTuplePatch part;
        for (int r = 0; r < 4; ++r) {
            std::copy(refined[row + r] + column, refined[row + r] + column + 4,
                      part.points + 4 * r);
        }
        return part;
    }

    /// What began at (0,0) then begins at a corner (0,0) (1,0) (1,1) (0,1) of the square.
    RegularTuplePatch Turned(int corner) const {
        RegularTuplePatch turned;
        for (int i = 0; i < 4; ++i) {
            for (int j = 0; j < 4; ++j) {
                const int row = corner == 0 ? i : corner == 1 ? j : corner == 2 ? 3 - i : 3 - j;
                const int column = corner == 0 ? j : corner == 1 ? 3 - i : corner == 2 ? 3 - j : i;
                turned.points[4 * row + column] = At(i, j);
            }
        }
        return turned;
    }

    /// Where a corner goes in the limit: the tensor product of (1 4 1) / 6.
    HWY_INLINE Point LimitCorner(int row, int column) const {
        const V diagonals = (V(At(row - 1, column - 1)) + At(row + 1, column + 1)) +
                            (V(At(row - 1, column + 1)) + At(row + 1, column - 1));
        const V edges = (V(At(row - 1, column)) + At(row + 1, column)) +
                        (V(At(row, column - 1)) + At(row, column + 1));
        Point limit;
        ((diagonals + edges * 4.0f + V(At(row, column)) * 16.0f) * (1 / 36.0f)).Store(&limit);
        return limit;
    }

    void LimitCorners(Point corners[4]) const {
        corners[0] = LimitCorner(1, 1);
        corners[1] = LimitCorner(1, 2);
        corners[2] = LimitCorner(2, 2);
        corners[3] = LimitCorner(2, 1);
    }
};

/// A quad with an extraordinary vertex at (0,0), in the points' order of ExtraordinaryPatch: the
/// 4x4 layout and the vertex's ring beside it (paper, Figure 2c).
template <int kVectors>
class ExtraordinaryTuplePatch {
  public:
    using Point = Tuple<kVectors>;
    using V = TupleVector<kVectors>;
    using Points = InlineVector<Point, 24>;

    ExtraordinaryTuplePatch(Points points, int valence)
        : _points(std::move(points)), _valence(valence) {}

    Box3f Bounds() const { return BoxOfTuples(_points.data(), _points.size()); }

    /// One step: returns the regular quarters, in the order of ExtraordinaryPatch, and becomes the
    /// quarter that keeps the extraordinary vertex.
    void Subdivide(RegularTuplePatch<kVectors> quarters[3]) {
        Point refined[5][5];
        _Grid().Refine(refined);
        _RefineRing();
        // What the ring decides; refined[0][0] lies beyond the vertex and is not used.
        refined[1][1] = _scratch[0];
        refined[1][2] = _ScratchEdge(0);
        refined[2][2] = _ScratchDiagonal(0);
        refined[2][1] = _ScratchEdge(1);
        refined[2][0] = _ScratchDiagonal(1);
        refined[1][0] = _ScratchEdge(2);
        refined[0][1] = _ScratchEdge(_valence - 1);
        refined[0][2] = _ScratchDiagonal(_valence - 1);
        quarters[0] = RegularTuplePatch<kVectors>::Part(refined, 0, 1);
        quarters[1] = RegularTuplePatch<kVectors>::Part(refined, 1, 1);
        quarters[2] = RegularTuplePatch<kVectors>::Part(refined, 1, 0);
        Point* outer = &_scratch[1 + 2 * _valence];
        for (int i = 0; i < 4; ++i) {
            outer[i] = refined[i][3];
            outer[6 - i] = refined[3][i];
        }
        _points.swap(_scratch);
    }

    void LimitCorners(Point corners[4]) const {
        _Grid().LimitCorners(corners);
        V edges = V(_Edge(0)), diagonals = V(_Diagonal(0));
        for (int i = 1; i < _valence; ++i) {
            edges = edges + _Edge(i);
            diagonals = diagonals + _Diagonal(i);
        }
        const float n = static_cast<float>(_valence);
        ((V(_points[0]) * (n * n) + edges * 4.0f + diagonals) * (1 / (n * (n + 5))))
            .Store(&corners[0]);
    }

  private:
    const Point& _Edge(int i) const { return _points[1 + 2 * (i % _valence)]; }
    const Point& _Diagonal(int i) const { return _points[2 + 2 * (i % _valence)]; }
    Point& _ScratchEdge(int i) { return _scratch[1 + 2 * (i % _valence)]; }
    Point& _ScratchDiagonal(int i) { return _scratch[2 + 2 * (i % _valence)]; }

    /// The 4x4 points. There is no (0,0): what is made of it is not used.
    RegularTuplePatch<kVectors> _Grid() const {
        const Point* outer = &_points[1 + 2 * _valence];
        return {{_points[0], _Edge(_valence - 1), _Diagonal(_valence - 1), outer[0],  //
                 _Edge(2), _points[0], _Edge(0), outer[1],                            //
                 _Diagonal(1), _Edge(1), _Diagonal(0), outer[2],                      //
                 outer[6], outer[5], outer[4], outer[3]}};
    }

    /// Face points, edge points and the vertex point of the ring.
    void _RefineRing() {
        _scratch.resize(_points.size());
        const int n = _valence;
        const V center = V(_points[0]);
        V sum = center * 0.0f;
        for (int i = 0; i < n; ++i) {
            const V face = FacePoint<V>(center, _Edge(i), _Diagonal(i), _Edge(i + 1));
            face.Store(&_ScratchDiagonal(i));
            sum = sum + (face + _Edge(i));
        }
        for (int i = 0; i < n; ++i) {
            EdgePoint<V>(center, _Edge(i), _ScratchDiagonal(i), _ScratchDiagonal(i + n - 1))
                .Store(&_ScratchEdge(i));
        }
        const float inverse = 1.0f / static_cast<float>(n);
        (center * (1 - 2 * inverse) + sum * (inverse * inverse)).Store(&_scratch[0]);
    }

    Points _points, _scratch;
    int _valence;
};

}  // namespace HWY_NAMESPACE
}  // namespace cc
HWY_AFTER_NAMESPACE();

#endif
