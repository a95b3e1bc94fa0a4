#include "core/scene/points.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/scene/largestCoordinate.h"

namespace cc {
namespace {

/// What a point has that is given no width (UsdGeomPoints).
constexpr float kDefaultWidth = 1;

PrimvarSizes SizesOf(size_t points, size_t instances) {
    return {1, points, points, points, instances};
}

/// Says how many things of a kind are left out for a reason, if any are.
void Tell(size_t count, const char* one, const char* many, std::vector<std::string>* lines) {
    if (count > 0) {
        lines->push_back(std::to_string(count) + (count == 1 ? one : many) + " left out");
    }
}

}  // namespace

Points::Points(std::string name) : Shape(std::move(name)) {}

Points::~Points() = default;

void Points::SetMovingPoints(MovingPoints points) {
    _points = PointsAt(points, 0);
    _motion = points.IsMoving() ? std::move(points) : MovingPoints();
    _pointsChanged = true;
}

void Points::SetWidths(Primvar widths) {
    if (!(widths == _widths)) {
        _widths = std::move(widths);
        _widthsChanged = true;
    }
}

SurfaceValue Points::Evaluate(const PrimvarField& primvar, const ShapePoint& at) const {
    switch (primvar.GetInterpolation()) {
        case Interpolation::Varying:
        case Interpolation::Vertex:
        case Interpolation::FaceVarying: return primvar.AtElement(at.primitive);
        case Interpolation::Instance: return primvar.AtElement(at.instance);
        case Interpolation::Constant:
        case Interpolation::Uniform: break;
    }
    return primvar.AtElement(0);
}

void Points::_BuildGeometry(BuildReport* report) {
    if (!_pointsChanged && !_widthsChanged) {
        return;
    }
    report->topLevelChanged = true;
    if (!_pointsChanged) {
        _RecallPoints();
    }
    std::vector<Sphere> spheres = _MakeSpheres(_points, report);
    _points = {};
    _pointsChanged = _widthsChanged = false;
    if (_spheres && _spheres->PrimitiveCount() == spheres.size()) {
        _spheres->Move(std::move(spheres));
        report->work = GeometryWork::Moved;
    } else {
        _TakePrimvarsBack(/* ofInstancesOnly */ false);
        _spheres = std::make_unique<Spheres>(std::move(spheres));
        report->work = GeometryWork::Rebuilt;
    }
    _BuildMotion(report);
    _isUsable = !_spheres->PrimitiveBvh().IsEmpty();
}

void Points::_BuildMotion(BuildReport* report) {
    KeepIfPosesAgree(&_motion, &report->lines);
    if (!_motion.IsMoving()) {
        return;
    }
    std::vector<std::vector<Sphere>> poses;
    BuildReport saidBefore;
    for (const std::vector<Vec3f>& pose : _motion.Poses()) {
        poses.push_back(_MakeSpheres(pose, &saidBefore));
    }
    _spheres->SetPoses(poses);
}

void Points::_Pose(float time) {
    if (_motion.IsMoving()) {
        BuildReport saidBefore;
        _spheres->Pose(_MakeSpheres(PointsAt(_motion, time), &saidBefore));
    }
}

void Points::_RecallPoints() {
    _Pose(0);
    for (uint32_t i = 0; _spheres && i < _spheres->PrimitiveCount(); ++i) {
        _points.push_back(_spheres->At(i).center);
    }
}

std::vector<Sphere> Points::_MakeSpheres(const std::vector<Vec3f>& points,
                                         BuildReport* report) const {
    const bool hasPoints = !points.empty();
    std::string error;
    if (hasPoints && !_widths.IsEmpty()) {
        error = CheckPrimvarSize("widths", _widths, SizesOf(points.size(), 0));
        if (error.empty() && _widths.arity != 1) {
            error = "widths have " + std::to_string(_widths.arity) + " numbers a value, not 1";
        }
    }
    if (!error.empty()) {
        report->lines.push_back(error + "; widths of 1 are used");
    }
    const bool hasWidths = error.empty() && !_widths.IsEmpty();
    const bool isOneWidth = hasWidths && _widths.ElementCount() == 1;
    std::vector<Sphere> spheres(points.size());
    size_t badPoints = 0, badWidths = 0;
    for (size_t i = 0; i < points.size(); ++i) {
        const float width = hasWidths ? *_widths.Element(isOneWidth ? 0 : i) : kDefaultWidth;
        const bool isPointBad = !IsUsable(points[i]);
        const bool isWidthBad = !(width >= 0 && width <= kLargestCoordinate);
        spheres[i] = {points[i], isPointBad || isWidthBad ? 0 : width / 2};
        badPoints += isPointBad;
        badWidths += !isPointBad && isWidthBad;
    }
    Tell(badPoints, " point is not finite or too far away; it is",
         " points are not finite or too far away; they are", &report->lines);
    Tell(badWidths, " point has a width that is negative or not finite; it is",
         " points have widths that are negative or not finite; they are", &report->lines);
    return spheres;
}

PrimvarSizes Points::_Sizes() const { return SizesOf(_spheres->PrimitiveCount(), _PlaceCount()); }

size_t Points::_OwnBytes() const {
    return _points.capacity() * sizeof(Vec3f) + BytesOf(_motion) +
           _widths.values.capacity() * sizeof(float) + _widths.indices.capacity() * sizeof(int);
}

}  // namespace cc
