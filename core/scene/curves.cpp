#include "core/scene/curves.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/scene/largestCoordinate.h"

namespace cc {
namespace {

/// What a curve has that is given no width.
constexpr float kDefaultWidth = 1;

void Tell(size_t count, const char* one, const char* many, std::vector<std::string>* lines) {
    if (count > 0) {
        lines->push_back(std::to_string(count) +
                         (count == 1 ? std::string(" curve ") + one + "; it is left out"
                                     : std::string(" curves ") + many + "; they are left out"));
    }
}

/// A segment's four values in Bezier form.
/// @param element  gives the number of a vertex
template <class Element>
void ToSegment(const CurveLayout& layout, uint32_t segment, const Element& element,
               float values[4]) {
    CurveControl controls[4];
    layout.Controls(segment, controls);
    for (int i = 0; i < 4; ++i) {
        const float a = element(controls[i].a);
        values[i] = controls[i].b == CurveControl::kNone ? a : 2 * a - element(controls[i].b);
    }
    ToBezier(layout.Basis(), values);
}

size_t BytesOf(const Primvar& primvar) {
    return primvar.values.capacity() * sizeof(float) + primvar.indices.capacity() * sizeof(int);
}

}  // namespace

Curves::Curves(std::string name) : Shape(std::move(name)) {}

Curves::~Curves() = default;

void Curves::SetTopology(CurveTopology topology) {
    _topology = std::move(topology);
    _topologyChanged = true;
}

void Curves::SetMovingPoints(MovingPoints points) {
    _points = PointsAt(points, 0);
    _motion = points.IsMoving() ? std::move(points) : MovingPoints();
    _valuesChanged = true;
}

void Curves::SetWidths(Primvar widths) {
    if (!(widths == _widths)) {
        _widths = std::move(widths);
        _valuesChanged = true;
    }
}

void Curves::SetNormals(Primvar normals) {
    if (!(normals == _normals)) {
        _normals = std::move(normals);
        _valuesChanged = true;
    }
}

std::string Curves::_Check() const {
    size_t sum = 0;
    for (const int count : _topology.vertexCounts) {
        if (count < 0) {
            return "has a curve of " + std::to_string(count) + " vertices";
        }
        sum += static_cast<size_t>(count);
    }
    if (sum > _points.size()) {
        return "has curves of " + std::to_string(sum) + " vertices and " +
               std::to_string(_points.size()) + " points";
    }
    return {};
}

void Curves::_BuildGeometry(BuildReport* report) {
    if (!_topologyChanged && !_valuesChanged) {
        return;
    }
    report->topLevelChanged = true;
    const bool isOther = std::exchange(_topologyChanged, false) || !_segments;
    _valuesChanged = _isUsable = false;
    const std::string error = _Check();
    if (!error.empty()) {
        report->lines.push_back(error + "; the curves are left out");
        _TakePrimvarsBack(/* ofInstancesOnly */ false);
        _segments.reset();
        return;
    }
    if (isOther) {
        _TakePrimvarsBack(/* ofInstancesOnly */ false);
        _segments.reset();
        _layout = CurveLayout(_topology);
        Tell(_layout.BadCount(), "has not as many vertices as its basis asks for",
             "have not as many vertices as their basis asks for", &report->lines);
    }
    std::vector<CurveSegment> segments = _MakeSegments(_points, report);
    std::vector<RibbonNormals> normals = _MakeNormals(report);
    if (_segments) {
        _segments->Move(std::move(segments), std::move(normals));
        report->work = GeometryWork::Moved;
    } else {
        _segments = std::make_unique<CurveSegments>(std::move(segments), std::move(normals));
        report->work = GeometryWork::Rebuilt;
    }
    _BuildMotion(report);
    _isUsable = !_segments->PrimitiveBvh().IsEmpty();
}

void Curves::_BuildMotion(BuildReport* report) {
    KeepIfPosesAgree(&_motion, &report->lines);
    if (!_motion.IsMoving()) {
        return;
    }
    std::vector<std::vector<CurveSegment>> poses;
    BuildReport saidBefore;
    for (const std::vector<Vec3f>& pose : _motion.Poses()) {
        poses.push_back(_MakeSegments(pose, &saidBefore));
    }
    _segments->SetPoses(std::move(poses));
}

void Curves::_Pose(float time) {
    if (_motion.IsMoving()) {
        BuildReport saidBefore;
        _segments->Pose(_MakeSegments(PointsAt(_motion, time), &saidBefore));
    }
}

const Primvar* Curves::_Fitting(const std::string& name, const Primvar& primvar, int arity,
                                const char* without, BuildReport* report) const {
    if (primvar.IsEmpty() || _layout.SegmentCount() == 0) {
        return nullptr;
    }
    std::string error = CheckPrimvarSize(name, primvar,
                                         {_layout.CurveCount(), _layout.VaryingCount(),
                                          _layout.VertexCount(), _layout.VaryingCount(), 0});
    if (error.empty() && primvar.arity != arity) {
        error = name + " have " + std::to_string(primvar.arity) + " numbers a value, not " +
                std::to_string(arity);
    }
    if (!error.empty()) {
        report->lines.push_back(error + "; " + without);
        return nullptr;
    }
    return &primvar;
}

void Curves::_Spread(const Primvar& primvar, int number, uint32_t segment, float values[4]) const {
    uint32_t ends[2] = {0, 0};
    switch (primvar.interpolation) {
        case Interpolation::Vertex:
            ToSegment(
                _layout, segment, [&](uint32_t i) { return primvar.Element(i)[number]; }, values);
            return;
        case Interpolation::Varying:
        case Interpolation::FaceVarying: _layout.Varying(segment, ends); break;
        case Interpolation::Uniform: ends[0] = ends[1] = _layout.CurveOf(segment); break;
        case Interpolation::Constant:
        case Interpolation::Instance: break;
    }
    values[0] = primvar.Element(ends[0])[number];
    values[1] = primvar.Element(ends[1])[number];
    ToBezier(CurveBasis::Linear, values);
}

std::vector<CurveSegment> Curves::_MakeSegments(const std::vector<Vec3f>& points,
                                                BuildReport* report) const {
    const Primvar* const widths = _Fitting("widths", _widths, 1, "widths of 1 are used", report);
    std::vector<CurveSegment> segments(_layout.SegmentCount());
    for (uint32_t s = 0; s < segments.size(); ++s) {
        CurveSegment& segment = segments[s];
        for (int axis = 0; axis < 3; ++axis) {
            float values[4];
            ToSegment(_layout, s, [&](uint32_t i) { return points[i][axis]; }, values);
            for (int i = 0; i < 4; ++i) {
                segment.points[i][axis] = values[i];
            }
        }
        std::fill_n(segment.radii, 4, kDefaultWidth / 2);
        if (widths) {
            _Spread(*widths, 0, s, segment.radii);
            std::transform(segment.radii, segment.radii + 4, segment.radii,
                           [](float width) { return width / 2; });
        }
        segment.previous = _layout.Previous(s);
        segment.next = _layout.Next(s);
        segment.pieces = 1;
    }
    _DropBadCurves(&segments, report);
    return segments;
}

void Curves::_DropBadCurves(std::vector<CurveSegment>* segments, BuildReport* report) const {
    std::vector<bool> hasBadPoints(_layout.CurveCount()), hasBadWidths(_layout.CurveCount());
    for (uint32_t s = 0; s < segments->size(); ++s) {
        const CurveSegment& segment = (*segments)[s];
        const auto isBad = [](float radius) {
            return !(radius >= 0 && radius <= kLargestCoordinate);
        };
        // Inner control points of a width that is never below zero may be.
        const bool hasBadEnd = isBad(segment.radii[0]) || isBad(segment.radii[3]) ||
                               !std::isfinite(segment.radii[1] + segment.radii[2]);
        if (!std::all_of(segment.points, segment.points + 4, IsUsable)) {
            hasBadPoints[_layout.CurveOf(s)] = true;
        } else if (hasBadEnd) {
            hasBadWidths[_layout.CurveOf(s)] = true;
        }
    }
    size_t badPoints = 0, badWidths = 0;
    for (size_t curve = 0; curve < _layout.CurveCount(); ++curve) {
        badPoints += hasBadPoints[curve];
        badWidths += !hasBadPoints[curve] && hasBadWidths[curve];
    }
    for (uint32_t s = 0; s < segments->size(); ++s) {
        const uint32_t curve = _layout.CurveOf(s);
        if (hasBadPoints[curve] || hasBadWidths[curve]) {
            (*segments)[s].pieces = 0;
        }
    }
    Tell(badPoints, "has points that are not finite or too far away",
         "have points that are not finite or too far away", &report->lines);
    Tell(badWidths, "has widths that are negative or not finite",
         "have widths that are negative or not finite", &report->lines);
}

std::vector<RibbonNormals> Curves::_MakeNormals(BuildReport* report) const {
    const Primvar* const normals = _Fitting("normals", _normals, 3, "tubes are shown", report);
    std::vector<RibbonNormals> result(normals ? _layout.SegmentCount() : 0);
    for (uint32_t s = 0; s < result.size(); ++s) {
        for (int axis = 0; axis < 3; ++axis) {
            float values[4];
            _Spread(*normals, axis, s, values);
            result[s].begin[axis] = values[0];
            result[s].end[axis] = values[3];
        }
    }
    return result;
}

SurfaceValue Curves::Evaluate(const PrimvarField& primvar, const ShapePoint& at) const {
    uint32_t ends[2];
    SurfaceValue result;
    switch (primvar.GetInterpolation()) {
        case Interpolation::Varying:
        case Interpolation::FaceVarying:
            _layout.Varying(at.primitive, ends);
            for (int i = 0; i < primvar.Arity(); ++i) {
                const float begin = primvar.Element(ends[0])[i], end = primvar.Element(ends[1])[i];
                result.value[i] = begin * (1 - at.u) + end * at.u;
                result.du[i] = end - begin;
            }
            return result;
        case Interpolation::Vertex:
            for (int i = 0; i < primvar.Arity(); ++i) {
                float values[4];
                ToSegment(
                    _layout, at.primitive, [&](uint32_t k) { return primvar.Element(k)[i]; },
                    values);
                result.value[i] = BezierValue(values, at.u);
                result.du[i] = BezierDerivative(values, at.u);
            }
            return result;
        case Interpolation::Uniform: return primvar.AtElement(_layout.CurveOf(at.primitive));
        case Interpolation::Instance: return primvar.AtElement(at.instance);
        case Interpolation::Constant: break;
    }
    return primvar.AtElement(0);
}

PrimvarSizes Curves::_Sizes() const {
    return {_layout.CurveCount(), _layout.VaryingCount(), _layout.VertexCount(),
            _layout.VaryingCount(), _PlaceCount()};
}

size_t Curves::_OwnBytes() const {
    return _layout.Bytes() + _points.capacity() * sizeof(Vec3f) + BytesOf(_motion) +
           BytesOf(_widths) + BytesOf(_normals) + _topology.vertexCounts.capacity() * sizeof(int);
}

}  // namespace cc
