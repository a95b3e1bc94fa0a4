#pragma once

#include <cmath>

namespace cc {

/// What the ring of a smooth interior vertex weighs in its tangent towards one of its edges, under
/// Catmull-Clark (Halstead et al. 1993). Diagonal j is between edges j and j + 1.
class SmoothTangentMask {
  public:
    SmoothTangentMask(int valence, int towardsEdge)
        : _angle(2 * 3.14159265358979323846 / valence),
          _towards(towardsEdge),
          _edge(1 + std::cos(_angle) +
                std::cos(_angle / 2) * std::sqrt(2 * (9 + std::cos(_angle)))) {}

    float Edge(int j) const { return static_cast<float>(_edge * _Cosine(j)); }
    float Diagonal(int j) const { return static_cast<float>(_Cosine(j) + _Cosine(j + 1)); }

  private:
    double _Cosine(int j) const { return std::cos(_angle * (j - _towards)); }

    double _angle;
    int _towards;
    double _edge;
};

}  // namespace cc
