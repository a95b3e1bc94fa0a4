#include "core/subdiv/cornerTangents.h"

#include <cmath>

// With the corner in the origin, a step halves a sharp edge. Under Loop's scheme it takes any other
// edge e_j to 3/8 e_j + 1/8 (e_j-1 + e_j+1); under Catmull-Clark it takes the diagonals f_j to f'_j
// = 1/4 (e_j + f_j + e_j+1), and those edges to 1/4 (e_j + f'_j-1 + f'_j). What is left after many
// steps follows from the eigenvectors of that matrix whose eigenvalues are the largest. They are
// waves: edge j has the share sin or cos of j times an angle, and a diagonal that of j + 1/2 times
// the angle.

namespace cc {
namespace {

constexpr double kPi = 3.14159265358979323846;

/// Sine of the angle below which directions are parallel but for rounding.
constexpr float kParallel = 1e-5f;

bool AreParallel(const Vec3f& a, const Vec3f& b) {
    return !(Length(Cross(Normalize(a), Normalize(b))) > kParallel);
}

/// What the vectors around a corner weigh in a wave of some angle, beside their shares: the left
/// eigenvector.
struct WaveWeights {
    double edge, diagonal, end;
};

/// The eigenvalue is 3/8 + cos(angle) / 4.
WaveWeights TriangleWeights(double angle) {
    return {1, 0, std::sin(angle) / (2 * std::cos(angle) - 1)};
}

/// The eigenvalue is 1/4 + edge * cos(angle / 2) / 8.
WaveWeights QuadWeights(double angle) {
    const double half = std::cos(angle / 2), edge = half + std::sqrt(half * half + 4);
    return {edge, 1, std::sin(angle / 2) * (edge * half + 2) / (edge * half - 2)};
}

/// The limit at a corner under one of the schemes.
class CornerLimit {
  public:
    explicit CornerLimit(const SharpCorner& corner)
        : _edges(corner.edges),
          _diagonals(corner.diagonals),
          _faceCount(static_cast<int>(corner.edges.size()) - (corner.isClosed ? 0 : 1)),
          _resonance(corner.diagonals.size() == 0 ? 3 : 2) {
        for (const Vec3f& edge : _edges) {
            _length += Length(edge);
        }
        for (const Vec3f& diagonal : _diagonals) {
            _length += Length(diagonal);
        }
    }

    bool OpenTangents(int face, Vec3f tangents[2]) const {
        if (_faceCount <= _resonance && !AreParallel(_edges.front(), _edges.back())) {
            // Nothing shrinks less than the ends, whose plane it is. In resonance what is between
            // them tends to the mean of both, but the edges' difference to that of the ends.
            for (int i = 0; i < 2; ++i) {
                tangents[i] = _edges.front() * static_cast<float>(_faceCount - face - i) +
                              _edges.back() * static_cast<float>(face + i);
            }
            return true;
        }
        // Where the ends are parallel the plane is theirs and the first wave's, however fast that
        // shrinks, and what of it the ends drive does not count.
        const Vec3f first = _faceCount <= _resonance ? _InnerWave(1) : _OpenWave(1);
        if (face > 0 && face < _faceCount - 1) {
            return _faceCount <= _resonance ? _MiddleTangents(first, tangents)
                                            : _Spread(first, _Turn(face), tangents);
        }
        tangents[0] = face == 0 ? _edges.front() : first;
        tangents[1] = face == 0 ? first : _edges.back();
        return !AreParallel(tangents[0], tangents[1]);
    }

    bool ClosedTangents(int face, Vec3f tangents[2]) const {
        const Vec3f sum = _ClosedWave(0, 0);
        for (int i = 0; i < 2; ++i) {
            tangents[i] = _ClosedWave(1, face + i);
        }
        // What all edges share shrinks least: they gather in a spike unless they cancel out.
        return _IsMoreThanRounding(sum) ? _Spread(sum, tangents[1] - tangents[0], tangents)
                                        : !AreParallel(tangents[0], tangents[1]);
    }

  private:
    WaveWeights _WeightsOf(double angle) const {
        return _diagonals.size() == 0 ? TriangleWeights(angle) : QuadWeights(angle);
    }

    /// What _InnerWave makes of a wave of height 1.
    double _InnerSquare(double angle) const {
        const double edge = _WeightsOf(angle).edge;
        return 0.5 * _faceCount * (_diagonals.size() == 0 ? 1 : edge + 4 / edge);
    }

    bool _IsMoreThanRounding(const Vec3f& sum) const { return Length(sum) > kParallel * _length; }

    /// The sum of all vectors but the ends, each weighed by its share too.
    template <typename Share>
    Vec3f _Sum(int firstEdge, const WaveWeights& weights, const Share& share) const {
        Vec3f sum;
        for (int j = firstEdge; j < _faceCount; ++j) {
            sum += _edges[j] * static_cast<float>(weights.edge * share(j));
        }
        for (int j = 0; j < static_cast<int>(_diagonals.size()); ++j) {
            sum += _diagonals[j] * static_cast<float>(weights.diagonal * share(j + 0.5));
        }
        return sum;
    }

    /// True for a closed corner that a single sharp edge cuts open.
    bool _HasOneEnd() const { return _edges.front() == _edges.back(); }

    /// A wave that is zero at the ends, but for what these drive: mode times half of it fits in
    /// between.
    Vec3f _InnerWave(int mode) const {
        const double angle = kPi * mode / _faceCount;
        return _Sum(1, _WeightsOf(angle), [angle](double j) { return std::sin(angle * j); });
    }

    /// What is left of such a wave. The ends alone are left of it if it is in resonance with them,
    /// shrinking by half as they do.
    Vec3f _OpenWave(int mode) const {
        const Vec3f ends = _edges.front() + _edges.back() * (mode % 2 != 0 ? 1.0f : -1.0f);
        if (_faceCount == _resonance * mode) {
            return ends;
        }
        const double end = _WeightsOf(kPi * mode / _faceCount).end;
        return _InnerWave(mode) + ends * static_cast<float>(end);
    }

    /// The middle one of three faces of Loop's scheme between parallel ends. The ends' difference
    /// shrinks less than the second wave, if there is one. If there is none both edges tend to the
    /// end, unless the wave is parallel to that.
    bool _MiddleTangents(const Vec3f& first, Vec3f tangents[2]) const {
        if (_HasOneEnd()) {
            const Vec3f turn = -_OpenWave(2);
            return _Spread(_edges.front(), turn, tangents) || _Spread(first, turn, tangents);
        }
        tangents[0] = _edges.front() - _edges.back();
        tangents[1] = first;
        return !AreParallel(tangents[0], tangents[1]);
    }

    /// What turns one edge of a face in between into the other, where the first wave shrinks least.
    Vec3f _Turn(int face) const {
        const double angle = kPi / _faceCount;
        if (_HasOneEnd() && _faceCount == 2 * face + 1) {
            // To either side of the middle the rest is alike, but for this wave.
            return -_OpenWave(2);
        }
        return _SecondOfOpen(face + 1) * static_cast<float>(std::sin(angle * face)) -
               _SecondOfOpen(face) * static_cast<float>(std::sin(angle * (face + 1)));
    }

    /// What shrinks least of an edge but for the first wave, in an open corner.
    Vec3f _SecondOfOpen(int edge) const {
        if (_faceCount < 2 * _resonance) {
            return _BetweenEnds(edge);  // The second wave shrinks by more than half.
        }
        const double angle = 2 * kPi / _faceCount;
        const auto share = static_cast<float>(std::sin(angle * edge));
        if (_faceCount == 2 * _resonance && _HasOneEnd()) {
            return _BetweenEnds(edge) +
                   _InnerWave(2) * (share / static_cast<float>(_InnerSquare(angle)));
        }
        return _OpenWave(2) * share;
    }

    /// What the ends alone make of an edge in between; it shrinks by half as they do.
    Vec3f _BetweenEnds(int edge) const {
        const double angle = kPi / _resonance, middle = 0.5 * _faceCount;
        if (_HasOneEnd()) {
            return _edges.front() *
                   static_cast<float>(std::cos(angle * (middle - edge)) / std::cos(angle * middle));
        }
        const double whole = std::sin(angle * _faceCount);
        return _edges.front() * static_cast<float>(std::sin(angle * (_faceCount - edge)) / whole) +
               _edges.back() * static_cast<float>(std::sin(angle * edge) / whole);
    }

    /// What is left of a wave that runs around the corner so many times, at an edge.
    Vec3f _ClosedWave(int mode, int edge) const {
        const double angle = 2 * kPi * mode / _faceCount;
        return _Sum(0, _WeightsOf(angle),
                    [angle, edge](double j) { return std::cos(angle * (j - edge)); });
    }

    /// Two tangents to either side of the direction that both edges of a face tend to.
    /// @param turn  what turns the one edge into the other
    bool _Spread(const Vec3f& direction, const Vec3f& turn, Vec3f tangents[2]) const {
        const Vec3f aside = Normalize(turn) * Length(direction);
        tangents[0] = direction - aside;
        tangents[1] = direction + aside;
        return _IsMoreThanRounding(turn) && !AreParallel(direction, turn);
    }

    const SharpCorner::Vectors& _edges;
    const SharpCorner::Vectors& _diagonals;
    const int _faceCount;
    /// How many faces an open corner has for each half of a wave that shrinks by half.
    const int _resonance;
    /// Of all vectors together.
    float _length = 0;
};

}  // namespace

bool CornerTangents(const SharpCorner& corner, int face, Vec3f* towardsEdge,
                    Vec3f* towardsNextEdge) {
    const CornerLimit limit(corner);
    Vec3f tangents[2];
    const bool isKnown =
        corner.isClosed ? limit.ClosedTangents(face, tangents) : limit.OpenTangents(face, tangents);
    *towardsEdge = tangents[0];
    *towardsNextEdge = tangents[1];
    return isKnown;
}

}  // namespace cc
