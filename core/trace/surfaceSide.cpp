#include "core/trace/surfaceSide.h"

#include <algorithm>
#include <cmath>

namespace cc {
namespace {

/// Below this cosine between ray and normal, the limit surface may turn away from a ray that hit
/// the side of a triangle that faces it. The coarser the triangles, the more they may be off.
float GrazingCosine(int level) { return level < 2 ? 1 / static_cast<float>(1 << level) : 0.25f; }

/// Normal of the traced triangle that a point of a patch lies on, in object space and of any
/// length. The patch has so many segments along u and v.
/// @param corner  gives the surface at parameters
template <class Corner>
Vec3f NormalInQuad(const Corner& corner, int segments, float u, float v) {
    const float size = 1 / static_cast<float>(segments);
    const float u0 = std::min(std::floor(u * segments), segments - 1.0f) * size;
    const float v0 = std::min(std::floor(v * segments), segments - 1.0f) * size;
    // Quads are cut from (0,0) to (1,1).
    const Vec3f origin = corner(u0, v0);
    const Vec3f diagonal = corner(u0 + size, v0 + size) - origin;
    return u - u0 > v - v0 ? Cross(corner(u0 + size, v0) - origin, diagonal)
                           : Cross(diagonal, corner(u0, v0 + size) - origin);
}

/// The same in a triangular patch: it is cut into upright triangles and, between those, turned
/// ones.
template <class Corner>
Vec3f NormalInTriangle(const Corner& corner, int segments, float u, float v) {
    const float size = 1 / static_cast<float>(segments);
    float column = std::floor(u * segments), row = std::floor(v * segments);
    // On the long edge there is no triangle further on.
    if (column + row >= segments) {
        (row > 0 ? row : column) -= 1;
    }
    const bool isTurned =
        column + row + 1 < segments && (u * segments - column) + (v * segments - row) > 1;
    const float turn = isTurned ? -size : size;
    const float u0 = (column + isTurned) * size, v0 = (row + isTurned) * size;
    const Vec3f origin = corner(u0, v0);
    return Cross(corner(u0 + turn, v0) - origin, corner(u0, v0 + turn) - origin);
}

Vec3f TriangleNormal(const Surface& surface, uint32_t patch, float u, float v, int level) {
    const PatchTable& patches = surface.Patches();
    const int splits = level - patches.At(patch).depth;
    const auto corner = [&](float cu, float cv) {
        return EvaluateLimitValue(patches, patch, surface.PatchPoints().data(), cu, cv);
    };
    return patches.IsTriangle(patch) ? NormalInTriangle(corner, 1 << splits, u, v)
                                     : NormalInQuad(corner, 1 << splits, u, v);
}

}  // namespace

bool IsInnerSide(const Surface& surface, const GeometryHit& hit, const LimitPoint& limit,
                 const PatchLevels& levels) {
    const Vec3f direction = Normalize(hit.direction);
    const float cosine = Dot(limit.normal, direction);
    if (std::fabs(cosine) > GrazingCosine(levels.Coarsest())) {
        return cosine > 0;
    }
    // At silhouettes the triangle decides: a flipped normal would be lit from the far side.
    const Vec3f normal = TriangleNormal(surface, hit.primitive, hit.u, hit.v, levels.interior);
    const float orientation = Dot(normal, limit.normal);
    return orientation == 0 ? cosine > 0 : (Dot(normal, direction) > 0) == (orientation > 0);
}

}  // namespace cc
