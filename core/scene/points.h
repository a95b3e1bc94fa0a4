#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/scene/movingPoints.h"
#include "core/scene/shape.h"
#include "core/trace/spheres.h"

namespace cc {

/// Points in the scene that are shown as spheres. A point that cannot be shown is left out by
/// itself: one that is not finite, or has a width that is negative or not finite.
class Points final : public Shape {
  public:
    explicit Points(std::string name);
    ~Points() override;

    void SetPoints(std::vector<Vec3f> points) { SetMovingPoints(MovingPoints(std::move(points))); }
    /// Points that move (Moving). If their number does, they rest as they are at time 0.
    void SetMovingPoints(MovingPoints points);
    /// Diameters in object space: of one number, constant or one a point. Without any they are 1.
    void SetWidths(Primvar widths);

    const Geometry* BuiltGeometry() const override { return _isUsable ? _spheres.get() : nullptr; }
    uint32_t ElementOf(uint32_t primitive) const override { return primitive; }
    SurfaceValue Evaluate(const PrimvarField& primvar, const ShapePoint& at) const override;

  private:
    const char* _KindName() const override { return "points"; }
    void _WriteOwnText(TextWriter* out) const override;
    const char* _Is() const override { return "the points are"; }
    Geometry* _Geometry() override { return _spheres.get(); }
    void _BuildGeometry(BuildReport* report) override;
    bool _GeometryMoves() const override { return _motion.IsMoving(); }
    void _Pose(float time) override;
    PrimvarSizes _Sizes() const override;
    size_t _OwnBytes() const override;

    /// Takes the centres back that wait in the spheres.
    void _RecallPoints();
    void _BuildMotion(BuildReport* report);
    std::vector<Sphere> _MakeSpheres(const std::vector<Vec3f>& points, BuildReport* report) const;

    /// Wait here until they are built; then the spheres have them.
    std::vector<Vec3f> _points;
    bool _pointsChanged = false;
    /// Kept while the points move.
    MovingPoints _motion;
    Primvar _widths;
    bool _widthsChanged = false;

    std::unique_ptr<Spheres> _spheres;
    bool _isUsable = false;
};

}  // namespace cc
