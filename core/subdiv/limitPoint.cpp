#include "core/subdiv/limitPoint.h"

#include <utility>

#include "core/subdiv/bezierPatch.h"
#include "core/subdiv/extraordinaryPatch.h"
#include "core/subdiv/irregularPatch.h"
#include "core/subdiv/triangleLimit.h"

namespace cc {
namespace {

/// Halvings towards an extraordinary vertex before its own limit stands in for the surface.
constexpr int kMaxHalvings = 20;

/// A regular piece of an extraordinary patch, and where in it a parameter lies.
struct RegularPiece {
    bool isRegular = false;
    BezierPatch patch;
    float u = 0, v = 0;
    /// Parameter lengths of the patch in one of the piece.
    float scale = 1;
};

/// Subdivides until (u, v) lies in a regular quarter. Gives up very near the extraordinary vertex.
RegularPiece FindRegularPiece(ExtraordinaryPatch* patch, float u, float v) {
    RegularPiece piece;
    for (int halving = 0; halving < kMaxHalvings; ++halving) {
        ExtraordinaryPatch::RegularQuarters quarters;
        patch->Subdivide(&quarters);
        u *= 2;
        v *= 2;
        piece.scale *= 2;
        if (u >= 1 || v >= 1) {
            const int quarter = u < 1 ? 2 : v < 1 ? 0 : 1;
            piece.isRegular = true;
            piece.patch = BezierPatch::FromBSpline(quarters.points[quarter]);
            piece.u = u >= 1 ? u - 1 : u;
            piece.v = v >= 1 ? v - 1 : v;
            break;
        }
    }
    return piece;
}

/// The normal where derivatives are parallel or one vanishes (a collapsed edge): that of a step
/// inside the patch.
Vec3f NormalInside(const BezierPatch& patch, float u, float v) {
    constexpr float kStep = 1e-3f;
    const float insideU = u + (0.5f - u) * kStep, insideV = v + (0.5f - v) * kStep;
    return Normalize(
        Cross(patch.DerivativeU(insideU, insideV), patch.DerivativeV(insideU, insideV)));
}

LimitPoint EvaluateBezier(const BezierPatch& patch, float u, float v) {
    LimitPoint point;
    point.position = patch.Position(u, v);
    point.du = patch.DerivativeU(u, v);
    point.dv = patch.DerivativeV(u, v);
    const Vec3f normal = Cross(point.du, point.dv);
    // Relative to the tangents' lengths, what rounding leaves of parallel tangents is no normal.
    if (Length(normal) > 1e-6f * Length(point.du) * Length(point.dv)) {
        point.normal = Normalize(normal);
    } else {
        point.normal = NormalInside(patch, u, v);
    }
    return point;
}

LimitPoint EvaluateExtraordinary(const ExtraordinaryPatch& patch, float u, float v) {
    // With the extraordinary vertex's limit in the origin, subdivision towards it keeps its
    // relative precision however small the patch gets.
    const Vec3f origin = patch.LimitPosition();
    ExtraordinaryPatch local = patch;
    local.Translate(-origin);
    const RegularPiece piece = FindRegularPiece(&local, u, v);
    LimitPoint point;
    if (piece.isRegular) {
        point = EvaluateBezier(piece.patch, piece.u, piece.v);
        point.position += origin;
        point.du *= piece.scale;
        point.dv *= piece.scale;
    } else {
        point.position = origin;
        patch.LimitTangents(&point.du, &point.dv);
        point.normal = Normalize(Cross(point.du, point.dv));
    }
    return point;
}

/// Evaluates a patch whose extraordinary vertex is at a corner other than (0,0).
LimitPoint EvaluateTurned(const ExtraordinaryPatch& patch, int corner, float u, float v) {
    switch (corner) {
        case 1: {
            LimitPoint point = EvaluateExtraordinary(patch, v, 1 - u);
            std::swap(point.du, point.dv);
            point.du = -point.du;
            return point;
        }
        case 2: {
            LimitPoint point = EvaluateExtraordinary(patch, 1 - u, 1 - v);
            point.du = -point.du;
            point.dv = -point.dv;
            return point;
        }
        case 3: {
            LimitPoint point = EvaluateExtraordinary(patch, 1 - v, u);
            std::swap(point.du, point.dv);
            point.dv = -point.dv;
            return point;
        }
        default: return EvaluateExtraordinary(patch, u, v);
    }
}

bool IsCorner(float u, float v) { return (u == 0 || u == 1) && (v == 0 || v == 1); }

int NearestCorner(float u, float v) { return v < 0.5f ? (u < 0.5f ? 0 : 1) : (u < 0.5f ? 3 : 2); }

/// Evaluates a corner by its masks. Returns false if they are not known, or if derivatives are: a
/// regular corner has them.
bool EvaluateByMasks(const IrregularPatch& patch, int corner, LimitPoint* point) {
    const VertexRing& ring = patch.rings[corner];
    Vec3f towardsNext, towardsPrevious;
    if (ring.IsRegular() ||
        !ring.LimitTangents(patch.faces[corner], &towardsNext, &towardsPrevious)) {
        return false;
    }
    point->position = ring.LimitPosition();
    point->normal = Normalize(Cross(towardsNext, towardsPrevious));
    const bool isTurned = corner % 2 != 0;
    point->du = isTurned ? towardsPrevious : towardsNext;
    point->dv = isTurned ? towardsNext : towardsPrevious;
    // Towards the corner's neighbours is along u or v, or against them.
    point->du *= corner == 1 || corner == 2 ? -1.0f : 1.0f;
    point->dv *= corner >= 2 ? -1.0f : 1.0f;
    return true;
}

/// A patch so small that it is flat.
LimitPoint EvaluateTiny(const IrregularPatch& patch, int corner) {
    Vec3f corners[4];
    patch.LimitCorners(corners);
    return EvaluateBezier(BezierPatch::FromBilinear(corners), corner == 1 || corner == 2 ? 1 : 0,
                          corner >= 2 ? 1 : 0);
}

/// Evaluates a patch if it is a B-spline or has one extraordinary vertex, or at a corner whose
/// masks are known. Returns false otherwise.
bool EvaluateIfSimple(const IrregularPatch& patch, float u, float v, LimitPoint* point) {
    Vec3f bspline[16];
    if (patch.ToBSpline(bspline)) {
        *point = EvaluateBezier(BezierPatch::FromBSpline(bspline), u, v);
        return true;
    }
    ExtraordinaryPatch::Points points;
    const int corner = patch.ToExtraordinary(&points);
    if (corner >= 0) {
        const ExtraordinaryPatch turned(points.data(), patch.rings[corner].FaceCount());
        *point = EvaluateTurned(turned, corner, u, v);
        return true;
    }
    return IsCorner(u, v) && EvaluateByMasks(patch, NearestCorner(u, v), point);
}

/// Subdivides towards (u, v) until the surface there is simple, or so small that it is flat.
LimitPoint EvaluateIrregular(const IrregularPatch& patch, float u, float v) {
    // About the nearest corner, so that small parts near it keep their relative precision.
    const int nearest = NearestCorner(u, v);
    const Vec3f origin = patch.rings[nearest].LimitPosition();
    IrregularPatch local = patch;
    local.Translate(-origin);
    LimitPoint point;
    float scale = 1;
    bool isDone = EvaluateIfSimple(local, u, v, &point);
    for (int halving = 0; halving < kMaxHalvings && !isDone; ++halving) {
        IrregularPatch quarters[4];
        local.Subdivide(quarters);
        u *= 2;
        v *= 2;
        scale *= 2;
        const bool isHighU = u > 1 || (u == 1 && nearest % 3 != 0);
        const bool isHighV = v > 1 || (v == 1 && nearest >= 2);
        u -= isHighU;
        v -= isHighV;
        local = quarters[isHighV ? (isHighU ? 2 : 3) : (isHighU ? 1 : 0)];
        isDone = EvaluateIfSimple(local, u, v, &point);
    }
    if (!isDone && !EvaluateByMasks(local, nearest, &point)) {
        point = EvaluateTiny(local, nearest);
    }
    point.position += origin;
    point.du *= scale;
    point.dv *= scale;
    return point;
}

LimitPoint EvaluateFlat(const uint32_t* indices, const Vec3f* values, float u, float v) {
    const Vec3f &a = values[indices[0]], &b = values[indices[1]], &c = values[indices[2]];
    LimitPoint point;
    point.position = a * (1 - u - v) + (b * u + c * v);
    point.du = b - a;
    point.dv = c - a;
    // Scaled first, lest the product of small sides vanish.
    point.normal = Normalize(Cross(Normalize(point.du), Normalize(point.dv)));
    return point;
}

}  // namespace

LimitPoint EvaluateLimit(const PatchTable& patches, uint32_t patch, const Vec3f* values, float u,
                         float v) {
    LimitPoint point;
    switch (patches.At(patch).kind) {
        case PatchKind::Regular:
        case PatchKind::Bilinear:
            point = EvaluateBezier(GatherBezier(patches, patch, values), u, v);
            break;
        case PatchKind::Extraordinary:
            point = EvaluateExtraordinary(GatherExtraordinary(patches, patch, values), u, v);
            break;
        case PatchKind::Irregular:
            point = EvaluateIrregular(GatherIrregular(patches, patch, values), u, v);
            break;
        case PatchKind::RegularTriangle:
        case PatchKind::IrregularTriangle:
            point = EvaluateTriangle(patches, patch, values, u, v);
            break;
        case PatchKind::FlatTriangle:
            point = EvaluateFlat(patches.Indices(patch), values, u, v);
            break;
    }
    if (patches.IsLeftHanded()) {
        point.normal = -point.normal;
    }
    return point;
}

LimitPoint ByFaceParameter(const PatchTable& patches, uint32_t patch, LimitPoint point) {
    if (patches.IsTriangle(patch)) {
        return point;
    }
    const Patch& p = patches.At(patch);
    // The chain rule through PatchTable::ToFace.
    const Vec3f du = point.du, dv = point.dv;
    switch (p.rotation) {
        case 1: point.du = -dv, point.dv = du; break;
        case 2: point.du = -du, point.dv = -dv; break;
        case 3: point.du = dv, point.dv = -du; break;
        default: break;
    }
    const auto cells = static_cast<float>(1 << (p.depth - p.isSubQuad));
    point.du *= cells;
    point.dv *= cells;
    return point;
}

Vec3f EvaluateLimitValue(const PatchTable& patches, uint32_t patch, const Vec3f* values, float u,
                         float v) {
    return EvaluateLimit(patches, patch, values, u, v).position;
}

}  // namespace cc
