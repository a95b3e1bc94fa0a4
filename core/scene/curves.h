#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/scene/curveTopology.h"
#include "core/scene/movingPoints.h"
#include "core/scene/shape.h"
#include "core/trace/curveSegments.h"

namespace cc {

/// Curves in the scene: round tubes, or with normals flat ribbons that face them. A curve that
/// cannot be shown is left out by itself: one with too few vertices for its basis, with a point
/// that is not finite, or with a width that is negative or not finite.
class Curves final : public Shape {
  public:
    explicit Curves(std::string name);
    ~Curves() override;

    void SetTopology(CurveTopology topology);
    void SetPoints(std::vector<Vec3f> points) { SetMovingPoints(MovingPoints(std::move(points))); }
    /// Points that move (Moving). If their number does, they rest as they are at time 0.
    void SetMovingPoints(MovingPoints points);
    /// Diameters in object space, of one number. Without any they are 1.
    void SetWidths(Primvar widths);
    /// What ribbons face, of three numbers. Without any the curves are tubes.
    void SetNormals(Primvar normals);

    const Geometry* BuiltGeometry() const override { return _isUsable ? _segments.get() : nullptr; }
    uint32_t ElementOf(uint32_t primitive) const override { return _layout.CurveOf(primitive); }
    SurfaceValue Evaluate(const PrimvarField& primvar, const ShapePoint& at) const override;

  private:
    const char* _KindName() const override { return "curves"; }
    void _WriteOwnText(TextWriter* out) const override;
    const char* _Is() const override { return "the curves are"; }
    Geometry* _Geometry() override { return _segments.get(); }
    void _BuildGeometry(BuildReport* report) override;
    bool _GeometryMoves() const override { return _motion.IsMoving(); }
    void _Pose(float time) override;
    PrimvarSizes _Sizes() const override;
    size_t _OwnBytes() const override;

    /// What is wrong with topology and points; empty if they can be used.
    std::string _Check() const;
    /// The primvar, or null if there is none, or one that does not fit, which is told.
    const Primvar* _Fitting(const std::string& name, const Primvar& primvar, int arity,
                            const char* without, BuildReport* report) const;
    void _BuildMotion(BuildReport* report);
    std::vector<CurveSegment> _MakeSegments(const std::vector<Vec3f>& points,
                                            BuildReport* report) const;
    void _DropBadCurves(std::vector<CurveSegment>* segments, BuildReport* report) const;
    std::vector<RibbonNormals> _MakeNormals(BuildReport* report) const;
    /// A number of a primvar's values, as a segment has it, in Bezier form.
    void _Spread(const Primvar& primvar, int number, uint32_t segment, float values[4]) const;

    CurveTopology _topology;
    std::vector<Vec3f> _points;
    /// Kept while the points move; _points are those of time 0.
    MovingPoints _motion;
    Primvar _widths, _normals;
    bool _topologyChanged = false, _valuesChanged = false;

    CurveLayout _layout;
    std::unique_ptr<CurveSegments> _segments;
    bool _isUsable = false;
};

}  // namespace cc
