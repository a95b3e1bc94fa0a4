#include "core/trace/curvePieces.h"

#include <algorithm>
#include <cmath>

namespace cc {
namespace {

/// In doubles: cones are thin, and far from where rays begin.
struct Vec3d {
    double x, y, z;

    Vec3d(double a, double b, double c) : x(a), y(b), z(c) {}
    explicit Vec3d(const Vec3f& v) : x(v.x), y(v.y), z(v.z) {}

    Vec3d operator-(const Vec3d& b) const { return {x - b.x, y - b.y, z - b.z}; }
    Vec3d operator+(const Vec3d& b) const { return {x + b.x, y + b.y, z + b.z}; }
    Vec3d operator*(double s) const { return {x * s, y * s, z * s}; }
};

double Dot(const Vec3d& a, const Vec3d& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

Vec3d Cross(const Vec3d& a, const Vec3d& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// A ray that begins where it is nearest to a point, so that large numbers do not cancel.
struct NearRay {
    NearRay(const CurveRay& ray, const Vec3f& point)
        : direction(ray.direction),
          square(Dot(direction, direction)),
          shift(Dot(Vec3d(point) - Vec3d(ray.origin), direction) / square),
          origin(Vec3d(ray.origin) + direction * shift - Vec3d(point)) {}

    Vec3d direction;
    double square;  ///< of the direction's length
    double shift;   ///< of t
    Vec3d origin;   ///< from the point
};

/// Both solutions of a t^2 + 2 b t + c = 0 in order; false if there are none.
bool SolveQuadratic(double a, double b, double c, double roots[2]) {
    const double discriminant = b * b - a * c;
    if (!(discriminant >= 0)) {
        return false;
    }
    const double q = -(b + std::copysign(std::sqrt(discriminant), b));
    if (q == 0) {
        return false;
    }
    // Where a vanishes, one of them is beyond all numbers.
    roots[0] = c / q;
    roots[1] = a == 0 ? roots[0] : q / a;
    if (roots[0] > roots[1]) {
        std::swap(roots[0], roots[1]);
    }
    return true;
}

bool IsWithin(double t, const CurveRay& ray) { return t > ray.tMin && t < ray.tMax; }

}  // namespace

CurvePieces::CurvePieces(const CurveSegments& segments, uint32_t index) {
    const CurveSegment& segment = segments.At(index);
    _isRibbon = segments.AreRibbons();
    _count = segment.pieces;
    _hasNext = segment.next != CurveSegment::kNone && segments.At(segment.next).pieces > 0;
    for (int i = 0; i <= _count; ++i) {
        const float u = static_cast<float>(i) / static_cast<float>(_count);
        // Bit for bit what the next segment begins with.
        const bool isNext = i == _count && _hasNext;
        const CurveSegment& owner = isNext ? segments.At(segment.next) : segment;
        const float ownU = isNext ? 0 : u;
        _points[i] = owner.PointAt(ownU);
        _radii[i] = owner.RadiusAt(ownU);
        if (_isRibbon) {
            _across[i] = segments.AcrossAt(isNext ? segment.next : index, ownU) * _radii[i];
        }
    }
    if (_hasNext) {
        const CurveSegment& next = segments.At(segment.next);
        _points[_count + 1] = next.PointAt(1 / static_cast<float>(next.pieces));
    }
}

bool CurvePieces::Intersect(CurveRay* ray) const {
    bool isHit = false;
    for (int piece = 0; piece < _count; ++piece) {
        if (_isRibbon) {
            isHit |= _IntersectQuad(piece, ray);
            continue;
        }
        isHit |= _IntersectCone(piece, ray);
        if (piece + 1 < _count || _hasNext) {
            isHit |= _IntersectJoint(piece, ray);
        }
    }
    return isHit;
}

bool CurvePieces::_IntersectCone(int piece, CurveRay* ray) const {
    const NearRay near(*ray, _points[piece]);
    const Vec3d along = Vec3d(_points[piece + 1]) - Vec3d(_points[piece]);
    const double length = std::sqrt(Dot(along, along));
    const double reach = length + std::max(_radii[piece], _radii[piece + 1]);
    if (!(length > 0) || Dot(near.origin, near.origin) > reach * reach) {
        return false;
    }
    const Vec3d axis = along * (1 / length);
    const double radius = _radii[piece];
    const double slope = (_radii[piece + 1] - radius) / length;
    // At t the ray is at a height along the axis, and as far from it as the cone is wide there.
    const double height = Dot(near.origin, axis), rise = Dot(near.direction, axis);
    const double width = radius + slope * height, growth = slope * rise;
    const double a = near.square - rise * rise - growth * growth;
    const double b = Dot(near.origin, near.direction) - height * rise - width * growth;
    const double c = Dot(near.origin, near.origin) - height * height - width * width;
    double roots[2];
    if (!SolveQuadratic(a, b, c, roots)) {
        return false;
    }
    for (const double root : roots) {
        const double t = root + near.shift, at = height + root * rise;
        if (!IsWithin(t, *ray) || !(at >= 0 && at <= length) || width + growth * root < 0) {
            continue;
        }
        ray->tMax = static_cast<float>(t);
        ray->u = (static_cast<float>(piece) + static_cast<float>(at / length)) /
                 static_cast<float>(_count);
        // The gradient of what is zero on the cone.
        ray->v = a * root + b > 0 ? 1.0f : 0.0f;
        return true;
    }
    return false;
}

bool CurvePieces::_IntersectJoint(int piece, CurveRay* ray) const {
    const Vec3f& center = _points[piece + 1];
    const double radius = _radii[piece + 1];
    const NearRay near(*ray, center);
    const double square = radius * radius - Dot(near.origin, near.origin);
    if (!(square > 0)) {
        return false;
    }
    const Vec3d before = Vec3d(center) - Vec3d(_points[piece]);
    const Vec3d after = Vec3d(_points[piece + 2]) - Vec3d(center);
    const double half = std::sqrt(square / near.square);
    for (const double root : {-half, half}) {
        const Vec3d from = near.origin + near.direction * root;
        // Only what lies beyond the end of one piece and before the begin of the other.
        if (IsWithin(root + near.shift, *ray) && Dot(from, before) >= 0 && Dot(from, after) <= 0) {
            ray->tMax = static_cast<float>(root + near.shift);
            ray->u = static_cast<float>(piece + 1) / static_cast<float>(_count);
            ray->v = root > 0 ? 1.0f : 0.0f;
            return true;
        }
    }
    return false;
}

bool CurvePieces::_IntersectQuad(int piece, CurveRay* ray) const {
    const NearRay near(*ray, _points[piece]);
    const Vec3d d = near.direction;
    // From the ray's near point: the ends of the quad's two edges across.
    Vec3d corners[2][2] = {{Vec3d(0, 0, 0), Vec3d(0, 0, 0)}, {Vec3d(0, 0, 0), Vec3d(0, 0, 0)}};
    for (int end = 0; end < 2; ++end) {
        const Vec3d middle = Vec3d(_points[piece + end]) - Vec3d(_points[piece]) - near.origin;
        const Vec3d half(_across[piece + end]);
        corners[end][0] = middle - half;
        corners[end][1] = middle + half;
    }
    // Two triangles on either side of one diagonal; edges that are shared are tested alike.
    const auto side = [&](const Vec3d& a, const Vec3d& b) { return Dot(Cross(a, b), d); };
    const Vec3d &a = corners[0][0], &b = corners[0][1], &c = corners[1][1], &e = corners[1][0];
    const double ab = side(a, b), bc = side(b, c), ca = side(c, a), ce = side(c, e),
                 ea = side(e, a);
    const auto isInside = [](double x, double y, double z) {
        return (x >= 0 && y >= 0 && z >= 0) || (x <= 0 && y <= 0 && z <= 0);
    };
    const auto take = [&](const Vec3d& p, const Vec3d& q, const Vec3d& r, double u, double v) {
        const Vec3d normal = Cross(q - p, r - p);
        const double slope = Dot(normal, d);
        const double t = slope == 0 ? -1 : Dot(normal, p) / slope + near.shift;
        if (slope == 0 || !IsWithin(t, *ray)) {
            return false;
        }
        ray->tMax = static_cast<float>(t);
        ray->u = (static_cast<float>(piece) + static_cast<float>(u)) / static_cast<float>(_count);
        ray->v = static_cast<float>(v);
        return true;
    };
    // Weights of corners: each is the side of the edge that faces it.
    const double first = ab + bc + ca, second = -ca + ce + ea;
    if (first != 0 && isInside(ab, bc, ca)) {
        return take(a, b, c, ab / first, (ca + ab) / first);
    }
    if (second != 0 && isInside(-ca, ce, ea)) {
        return take(a, c, e, (ea - ca) / second, ea / second);
    }
    return false;
}

}  // namespace cc
