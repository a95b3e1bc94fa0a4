#pragma once

#include "core/trace/curveSegments.h"

namespace cc {

/// Part of a ray, and what it hits.
struct CurveRay {
    Vec3f origin, direction;
    float tMin, tMax;
    /// Where it hits; tMax is the distance then.
    float u = 0, v = 0;
};

/// A segment of a curve cut into pieces: cones, with parts of spheres where they meet at an angle,
/// or the quads of a ribbon. Neighbours share what they meet at, and leave no gap.
class CurvePieces {
  public:
    CurvePieces(const CurveSegments& segments, uint32_t segment);

    /// Finds the nearest hit of a ray in (tMin, tMax). Returns false if there is none.
    bool Intersect(CurveRay* ray) const;

  private:
    static constexpr int kMostPoints = 64 + 2;

    bool _IntersectCone(int piece, CurveRay* ray) const;
    bool _IntersectJoint(int piece, CurveRay* ray) const;
    bool _IntersectQuad(int piece, CurveRay* ray) const;

    bool _isRibbon;
    int _count;     ///< of pieces
    bool _hasNext;  ///< there is a point beyond the last piece
    Vec3f _points[kMostPoints];
    float _radii[kMostPoints];
    Vec3f _across[kMostPoints];  ///< of ribbons, as long as half their width
};

}  // namespace cc
