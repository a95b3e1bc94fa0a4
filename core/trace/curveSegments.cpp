#include "core/trace/curveSegments.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cc {
namespace {

constexpr float kPi = 3.14159265f;

/// How far pieces may be from their curve, in parts of its greatest radius there: a fortieth of the
/// width.
constexpr float kPieceError = 0.05f;
constexpr int kMostPieces = 64;
/// Segments that meet at a lesser cosine have a corner between them.
constexpr float kSmoothCosine = 0.999f;
/// A piece of a ribbon turns by no more than that, in radians.
constexpr float kMostTurn = 0.1f;
/// Boxes are that much larger than curves, in parts of their largest coordinate: hits round.
constexpr float kBoxSlack = 1e-6f;

float LargestRadius(const CurveSegment& segment) {
    return *std::max_element(segment.radii, segment.radii + 4);
}

/// Pieces of equal parameter length that stay close: their distance from the curve is at most an
/// eighth of the second derivative over their number squared.
int PieceCount(const CurveSegment& segment, const RibbonNormals* normals) {
    const auto& p = segment.points;
    const auto& r = segment.radii;
    const float second =
        6 * std::max(Length(p[0] - p[1] * 2 + p[2]), Length(p[1] - p[2] * 2 + p[3]));
    const float ofRadius =
        6 * std::max(std::fabs(r[0] - 2 * r[1] + r[2]), std::fabs(r[1] - 2 * r[2] + r[3]));
    float count = std::sqrt((second + ofRadius) / (8 * kPieceError * LargestRadius(segment)));
    if (normals) {
        const float cosine = Dot(Normalize(normals->begin), Normalize(normals->end));
        count = std::max(count, std::acos(std::clamp(cosine, -1.0f, 1.0f)) / kMostTurn);
    }
    return count < kMostPieces ? std::max(static_cast<int>(std::ceil(count)), 1) : kMostPieces;
}

Box3f BoxOf(const CurveSegment& segment) {
    Box3f box;
    if (segment.pieces == 0) {
        return box;
    }
    float largest = LargestRadius(segment);
    for (const Vec3f& p : segment.points) {
        box.Extend(p);
        largest = std::max({largest, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
    }
    const float by = LargestRadius(segment) + kBoxSlack * largest;
    box.lower = box.lower - Vec3f{by, by, by};
    box.upper = box.upper + Vec3f{by, by, by};
    return box;
}

std::vector<Box3f> BoxesOf(const std::vector<CurveSegment>& segments) {
    std::vector<Box3f> boxes(segments.size());
    std::transform(segments.begin(), segments.end(), boxes.begin(), BoxOf);
    return boxes;
}

/// A step from a piece to the curve: where on that a point is square to it.
float NearestParameter(const CurveSegment& segment, float u, const Vec3f& point) {
    const Vec3f tangent = segment.DerivativeAt(u);
    const float square = Dot(tangent, tangent);
    const float step = square > 0 ? Dot(point - segment.PointAt(u), tangent) / square : 0;
    return std::clamp(u + step, 0.0f, 1.0f);
}

/// Any unit vector square to a direction.
Vec3f AnyAcross(const Vec3f& direction) {
    const Vec3f axis =
        std::fabs(direction.x) < 0.6f * Length(direction) ? Vec3f{1, 0, 0} : Vec3f{0, 1, 0};
    const Vec3f across = Normalize(Cross(direction, axis));
    return across == Vec3f{} ? axis : across;
}

/// The part of v that is square to a direction.
Vec3f SquareTo(const Vec3f& direction, const Vec3f& v) {
    const float square = Dot(direction, direction);
    return square > 0 ? v - direction * (Dot(v, direction) / square) : v;
}

}  // namespace

Vec3f CurveSegment::PointAt(float u) const { return BezierValue(points, u); }

Vec3f CurveSegment::DerivativeAt(float u) const {
    const Vec3f derivative = BezierDerivative(points, u);
    // Control points that coincide leave none at an end; the chord is the next best.
    return Dot(derivative, derivative) > 0 ? derivative : points[3] - points[0];
}

float CurveSegment::RadiusAt(float u) const { return std::max(BezierValue(radii, u), 0.0f); }

float CurveSegment::RadiusDerivativeAt(float u) const { return BezierDerivative(radii, u); }

CurveSegments::CurveSegments(std::vector<CurveSegment> segments, std::vector<RibbonNormals> normals)
    : Geometry(GeometryKind::CurveSegments),
      _segments(std::move(segments)),
      _normals(std::move(normals)) {
    _Cut(&_segments);
    _bvh = Bvh(BoxesOf(_segments));
}

void CurveSegments::Move(std::vector<CurveSegment> segments, std::vector<RibbonNormals> normals) {
    _segments = std::move(segments);
    _normals = std::move(normals);
    _Cut(&_segments);
    _bvh.Move(BoxesOf(_segments));
}

void CurveSegments::SetPoses(std::vector<std::vector<CurveSegment>> poses) {
    std::vector<Box3f> boxes(_segments.size());
    for (std::vector<CurveSegment>& pose : poses) {
        _Cut(&pose);
        for (size_t i = 0; i < boxes.size(); ++i) {
            boxes[i].Extend(BoxOf(pose[i]));
        }
    }
    _bvh.Move(boxes);
}

void CurveSegments::Pose(std::vector<CurveSegment> segments) {
    _segments = std::move(segments);
    _Cut(&_segments);
}

void CurveSegments::_Cut(std::vector<CurveSegment>* segments) const {
    for (size_t i = 0; i < segments->size(); ++i) {
        CurveSegment& segment = (*segments)[i];
        const bool canBeHit = segment.pieces != 0 && LargestRadius(segment) > 0;
        const RibbonNormals* const normals = AreRibbons() ? &_normals[i] : nullptr;
        segment.pieces = canBeHit ? static_cast<uint8_t>(PieceCount(segment, normals)) : 0;
    }
}

Vec3f CurveSegments::_TangentAt(uint32_t index, float u) const {
    const CurveSegment& segment = _segments[index];
    Vec3f tangent = Normalize(segment.DerivativeAt(u));
    if (u == 0 && segment.previous != CurveSegment::kNone) {
        tangent += Normalize(_segments[segment.previous].DerivativeAt(1));
    } else if (u == 1 && segment.next != CurveSegment::kNone) {
        tangent += Normalize(_segments[segment.next].DerivativeAt(0));
    }
    return tangent;
}

bool CurveSegments::_HasCorner(uint32_t index) const {
    const CurveSegment& segment = _segments[index];
    return segment.next != CurveSegment::kNone &&
           Dot(Normalize(segment.DerivativeAt(1)),
               Normalize(_segments[segment.next].DerivativeAt(0))) < kSmoothCosine;
}

Vec3f CurveSegments::_FacingAt(uint32_t segment, float u) const {
    const RibbonNormals& normals = _normals[segment];
    return normals.begin * (1 - u) + normals.end * u;
}

Vec3f CurveSegments::AcrossAt(uint32_t segment, float u) const {
    const Vec3f tangent = _TangentAt(segment, u);
    const Vec3f across = Normalize(Cross(tangent, _FacingAt(segment, u)));
    return across == Vec3f{} ? AnyAcross(tangent) : across;
}

GeometryPoint CurveSegments::PointAt(const GeometryHit& hit, const Instance&,
                                     const LevelMetric&) const {
    return AreRibbons() ? _PointOnRibbon(hit) : _PointOnTube(hit);
}

GeometryPoint CurveSegments::_PointOnTube(const GeometryHit& hit) const {
    const CurveSegment& segment = _segments[hit.primitive];
    // Between segments that meet at an angle the tube is part of a sphere.
    const bool isJoint = hit.u == 1 && _HasCorner(hit.primitive);
    const float u = isJoint ? 1 : NearestParameter(segment, hit.u, hit.position);
    const Vec3f center = segment.PointAt(u), tangent = segment.DerivativeAt(u);
    const float radius = segment.RadiusAt(u), speed = Length(tangent);
    const float growth = segment.RadiusDerivativeAt(u);
    const Vec3f from = isJoint ? hit.position - center : SquareTo(tangent, hit.position - center);
    Vec3f outward = Normalize(from);
    if (outward == Vec3f{}) {
        outward = AnyAcross(tangent);
    }
    GeometryPoint point;
    // Just above or below the hit, also at the end of a curve, whose last piece may lean beyond it.
    point.position = hit.position + outward * (radius - Length(from));
    point.normal =
        isJoint || speed == 0 ? outward : Normalize(outward - tangent * (growth / (speed * speed)));
    point.du = tangent + outward * growth;
    point.dv = Normalize(Cross(tangent, outward)) * (2 * kPi * radius);
    point.isBehind = hit.v > 0.5f;
    return point;
}

GeometryPoint CurveSegments::_PointOnRibbon(const GeometryHit& hit) const {
    const CurveSegment& segment = _segments[hit.primitive];
    const Vec3f across = AcrossAt(hit.primitive, hit.u);
    const float width = 2 * segment.RadiusAt(hit.u);
    GeometryPoint point;
    point.position = segment.PointAt(hit.u) + across * (width * (hit.v - 0.5f));
    point.normal = Normalize(Cross(across, _TangentAt(hit.primitive, hit.u)));
    point.du = segment.DerivativeAt(hit.u);
    point.dv = across * width;
    point.isBehind = Dot(point.normal, hit.direction) > 0;
    return point;
}

size_t CurveSegments::Bytes() const {
    return _segments.capacity() * sizeof(CurveSegment) +
           _normals.capacity() * sizeof(RibbonNormals) + _bvh.Bytes();
}

}  // namespace cc
