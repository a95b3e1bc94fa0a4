#include "core/subdiv/triangleLimit.h"

#include "core/subdiv/bezierTriangle.h"
#include "core/subdiv/irregularTriangle.h"

namespace cc {
namespace {

/// Halvings towards a corner before its own limit stands in for the surface.
constexpr int kMaxHalvings = 20;

/// The unit normal over two tangents, which may be tiny: zero if they are parallel but for
/// rounding.
Vec3f NormalOver(const Vec3f& du, const Vec3f& dv) {
    const Vec3f normal = Cross(Normalize(du), Normalize(dv));
    return Length(normal) > 1e-6f ? Normalize(normal) : Vec3f{};
}

/// The normal where derivatives are parallel or one vanishes (a collapsed edge): that of a step
/// inside the patch.
Vec3f NormalInside(const BezierTriangle& patch, float u, float v) {
    constexpr float kStep = 1e-3f;
    const float insideU = u + (1 / 3.0f - u) * kStep, insideV = v + (1 / 3.0f - v) * kStep;
    return NormalOver(patch.DerivativeU(insideU, insideV), patch.DerivativeV(insideU, insideV));
}

LimitPoint EvaluateBezier(const BezierTriangle& patch, float u, float v) {
    LimitPoint point;
    point.position = patch.Position(u, v);
    point.du = patch.DerivativeU(u, v);
    point.dv = patch.DerivativeV(u, v);
    point.normal = NormalOver(point.du, point.dv);
    if (point.normal == Vec3f{}) {
        point.normal = NormalInside(patch, u, v);
    }
    return point;
}

/// @param corner  of the triangle, which the tangents are at
LimitPoint WithTangents(const Vec3f& position, int corner, const Vec3f& towardsNext,
                        const Vec3f& towardsPrevious) {
    LimitPoint point;
    point.position = position;
    point.normal = NormalOver(towardsNext, towardsPrevious);
    // Towards the next corner is along u at the first, along v - u at the second, against v at the
    // third.
    switch (corner) {
        case 0: point.du = towardsNext, point.dv = towardsPrevious; break;
        case 1: point.du = -towardsPrevious, point.dv = towardsNext - towardsPrevious; break;
        default: point.du = towardsPrevious - towardsNext, point.dv = -towardsNext; break;
    }
    return point;
}

/// Evaluates a corner by its masks. Returns false if they are not known, or if derivatives are: a
/// regular corner has them.
bool EvaluateByMasks(const IrregularTriangle& patch, int corner, LimitPoint* point) {
    const TriangleRing& ring = patch.rings[corner];
    Vec3f towardsNext, towardsPrevious;
    if (ring.IsRegular() ||
        !ring.LimitTangents(patch.faces[corner], &towardsNext, &towardsPrevious)) {
        return false;
    }
    *point = WithTangents(ring.LimitPosition(), corner, towardsNext, towardsPrevious);
    return true;
}

/// A triangle so small that it is flat.
LimitPoint EvaluateTiny(const IrregularTriangle& patch, int corner) {
    Vec3f corners[3];
    patch.LimitCorners(corners);
    return WithTangents(corners[corner], corner, corners[(corner + 1) % 3] - corners[corner],
                        corners[(corner + 2) % 3] - corners[corner]);
}

bool IsCorner(float u, float v) { return (u == 0 || u == 1) && (v == 0 || v == 1); }

int NearestCorner(float u, float v) {
    const float w = 1 - u - v;
    return w >= u && w >= v ? 0 : u >= v ? 1 : 2;
}

/// Evaluates a triangle if it is regular, or at a corner whose masks are known. Returns false
/// otherwise.
bool EvaluateIfSimple(const IrregularTriangle& patch, float u, float v, LimitPoint* point) {
    Vec3f spline[12];
    if (patch.ToBoxSpline(spline)) {
        *point = EvaluateBezier(BezierTriangle::FromBoxSpline(spline), u, v);
        return true;
    }
    return IsCorner(u, v) && EvaluateByMasks(patch, NearestCorner(u, v), point);
}

/// Which part of a split a point of the parameters lies in, at a corner in that corner's.
int PartAt(float u, float v) { return u >= 0.5f ? 1 : v >= 0.5f ? 2 : u + v <= 0.5f ? 0 : 3; }

/// Subdivides towards (u, v) until the surface there is simple, or so small that it is flat.
LimitPoint EvaluateIrregular(const IrregularTriangle& patch, float u, float v) {
    // About the nearest corner, so that small parts near it keep their relative precision.
    const int nearest = NearestCorner(u, v);
    const Vec3f origin = patch.rings[nearest].LimitPosition();
    IrregularTriangle local = patch;
    local.Translate(-origin);
    LimitPoint point;
    float scale = 1;
    bool isDone = EvaluateIfSimple(local, u, v, &point);
    for (int halving = 0; halving < kMaxHalvings && !isDone; ++halving) {
        IrregularTriangle parts[4];
        local.Subdivide(parts);
        const int i = PartAt(u, v);
        const SubTriangle part = SubTriangle().Split(i);
        u = (u - part.u) / part.size;
        v = (v - part.v) / part.size;
        scale /= part.size;
        local = parts[i];
        isDone = EvaluateIfSimple(local, u, v, &point);
    }
    const int last = NearestCorner(u, v);
    if (!isDone && !EvaluateByMasks(local, last, &point)) {
        point = EvaluateTiny(local, last);
    }
    point.position += origin;
    point.du *= scale;
    point.dv *= scale;
    return point;
}

}  // namespace

LimitPoint EvaluateTriangle(const PatchTable& patches, uint32_t patch, const Vec3f* values, float u,
                            float v) {
    if (patches.At(patch).kind == PatchKind::RegularTriangle) {
        return EvaluateBezier(GatherBezierTriangle(patches, patch, values), u, v);
    }
    return EvaluateIrregular(GatherIrregularTriangle(patches, patch, values), u, v);
}

}  // namespace cc
