#include "core/subdiv/limitPoint.h"

#include <vector>

#include "core/subdiv/bezierPatch.h"
#include "core/subdiv/extraordinaryPatch.h"

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

ExtraordinaryPatch GatherExtraordinary(const PatchTable& patches, uint32_t patch,
                                       const Vec3f* values) {
    const uint32_t* indices = patches.Indices(patch);
    std::vector<Vec3f> points(patches.IndexCount(patch));
    for (size_t i = 0; i < points.size(); ++i) {
        points[i] = values[indices[i]];
    }
    return ExtraordinaryPatch(points.data(), patches.At(patch).valence);
}

/// The patch moved by -origin. With the extraordinary vertex's limit in the origin, subdivision
/// towards it keeps its relative precision however small the patch gets.
ExtraordinaryPatch MovedToOrigin(const ExtraordinaryPatch& patch, const Vec3f& origin) {
    std::vector<Vec3f> points = patch.Points();
    for (Vec3f& p : points) {
        p = p - origin;
    }
    return ExtraordinaryPatch(points.data(), patch.Valence());
}

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

/// Tangents where a derivative vanishes (a collapsed edge): taken a step inside the patch.
void MendTangents(const BezierPatch& patch, float u, float v, LimitPoint* point) {
    constexpr float kStep = 1e-3f;
    const float insideU = u + (0.5f - u) * kStep, insideV = v + (0.5f - v) * kStep;
    point->du = patch.DerivativeU(insideU, insideV);
    point->dv = patch.DerivativeV(insideU, insideV);
    point->normal = Normalize(Cross(point->du, point->dv));
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
        MendTangents(patch, u, v, &point);
    }
    return point;
}

}  // namespace

LimitPoint EvaluateLimit(const PatchTable& patches, uint32_t patch, const Vec3f* values, float u,
                         float v) {
    LimitPoint point;
    if (patches.At(patch).kind != PatchKind::Extraordinary) {
        point = EvaluateBezier(GatherBezier(patches, patch, values), u, v);
    } else {
        const ExtraordinaryPatch extraordinary = GatherExtraordinary(patches, patch, values);
        const Vec3f origin = extraordinary.LimitPosition();
        ExtraordinaryPatch local = MovedToOrigin(extraordinary, origin);
        const RegularPiece piece = FindRegularPiece(&local, u, v);
        if (piece.isRegular) {
            point = EvaluateBezier(piece.patch, piece.u, piece.v);
            point.position += origin;
            point.du *= piece.scale;
            point.dv *= piece.scale;
        } else {
            point.position = origin;
            extraordinary.LimitTangents(&point.du, &point.dv);
            point.normal = Normalize(Cross(point.du, point.dv));
        }
    }
    if (patches.IsLeftHanded()) {
        point.normal = -point.normal;
    }
    return point;
}

Vec3f EvaluateLimitValue(const PatchTable& patches, uint32_t patch, const Vec3f* values, float u,
                         float v) {
    if (patches.At(patch).kind != PatchKind::Extraordinary) {
        return GatherBezier(patches, patch, values).Position(u, v);
    }
    ExtraordinaryPatch extraordinary = GatherExtraordinary(patches, patch, values);
    const RegularPiece piece = FindRegularPiece(&extraordinary, u, v);
    return piece.isRegular ? piece.patch.Position(piece.u, piece.v)
                           : extraordinary.LimitPosition();
}

}  // namespace cc
