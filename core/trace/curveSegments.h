#pragma once

#include <cstdint>
#include <vector>

#include "core/trace/geometry.h"

namespace cc {

/// A cubic Bezier curve of numbers or vectors at u in 0..1.
template <class T>
T BezierValue(const T p[4], float u) {
    const float w = 1 - u;
    return p[0] * (w * w * w) + p[1] * (3 * u * w * w) + p[2] * (3 * u * u * w) +
           p[3] * (u * u * u);
}

/// Its derivative by u.
template <class T>
T BezierDerivative(const T p[4], float u) {
    const float w = 1 - u;
    return (p[1] - p[0]) * (3 * w * w) + (p[2] - p[1]) * (6 * u * w) + (p[3] - p[2]) * (3 * u * u);
}

/// A cubic Bezier segment of a curve, and its radius, which is one too.
struct CurveSegment {
    static constexpr uint32_t kNone = 0xffffffffu;

    Vec3f points[4];
    float radii[4];
    /// The segments that it is joined to, or kNone.
    uint32_t previous = kNone, next = kNone;
    /// Pieces that it is cut into; 0 if it is not to be hit.
    uint8_t pieces = 0;

    Vec3f PointAt(float u) const;
    Vec3f DerivativeAt(float u) const;
    float RadiusAt(float u) const;
    float RadiusDerivativeAt(float u) const;
};

/// The directions that a flat ribbon faces at the ends of a segment.
struct RibbonNormals {
    Vec3f begin, end;
};

/// Segments of curves that rays can hit: round tubes, open at the ends of curves, or flat ribbons.
/// Hits have u, the parameter along the segment. v is 0 on the outer side of a tube and 1 on the
/// inner one; on a ribbon it runs across, from 0 to 1.
class CurveSegments final : public Geometry {
  public:
    /// Counts of pieces are found here, but for segments that have 0.
    /// @param normals  one a segment, for ribbons; none for tubes
    CurveSegments(std::vector<CurveSegment> segments, std::vector<RibbonNormals> normals);

    /// Takes other segments, as many as before: the BVH follows them (Bvh::Move).
    void Move(std::vector<CurveSegment> segments, std::vector<RibbonNormals> normals);

    /// Makes bounds hold for several poses of the segments, and for all that is between any two.
    /// @param poses  each has as many segments as before, of the same radii
    void SetPoses(std::vector<std::vector<CurveSegment>> poses);
    /// Moves the segments to between two of the poses.
    void Pose(std::vector<CurveSegment> segments);

    const CurveSegment& At(uint32_t segment) const { return _segments[segment]; }
    bool AreRibbons() const { return !_normals.empty(); }
    /// The unit direction of a ribbon's width at u, square to the curve; where two segments meet,
    /// both have the same.
    Vec3f AcrossAt(uint32_t segment, float u) const;

    size_t PrimitiveCount() const override { return _segments.size(); }
    GeometryPoint PointAt(const GeometryHit& hit, const Instance& instance,
                          const LevelMetric& levels) const override;
    size_t Bytes() const override;

  private:
    GeometryPoint _PointOnTube(const GeometryHit& hit) const;
    GeometryPoint _PointOnRibbon(const GeometryHit& hit) const;
    /// The direction of the curve at u, in the middle of both where segments meet.
    Vec3f _TangentAt(uint32_t segment, float u) const;
    /// True if a segment and the next meet at an angle.
    bool _HasCorner(uint32_t segment) const;
    /// The direction that a ribbon faces, before it is made square to the curve.
    Vec3f _FacingAt(uint32_t segment, float u) const;
    /// Finds into how many pieces segments are cut.
    void _Cut(std::vector<CurveSegment>* segments) const;

    std::vector<CurveSegment> _segments;
    std::vector<RibbonNormals> _normals;
};

}  // namespace cc
