#include "core/trace/objectRays.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/trace/objectRays.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace cc {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Rows of a transform times points (with translation) or directions (without). Doubles: origin
/// and translation may be large and nearly cancel. A plain loop, which compilers vectorize.
void TransformComponents(const AffineTransform& m, bool isPoint, int count,
                         const float* HWY_RESTRICT x, const float* HWY_RESTRICT y,
                         const float* HWY_RESTRICT z, float* HWY_RESTRICT outX,
                         float* HWY_RESTRICT outY, float* HWY_RESTRICT outZ) {
    double row[3][4];
    for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 4; ++c) {
            row[r][c] = c < 3 || isPoint ? m(r, c) : 0;
        }
    }
    float* const out[3] = {outX, outY, outZ};
    for (int r = 0; r < 3; ++r) {
        const double a = row[r][0], b = row[r][1], c = row[r][2], d = row[r][3];
        float* HWY_RESTRICT to = out[r];
        for (int i = 0; i < count; ++i) {
            to[i] = static_cast<float>(a * x[i] + b * y[i] + c * z[i] + d);
        }
    }
}

/// Reciprocals for slab tests: of a zero, large but finite, so that zero times it is zero.
void InvertDirections(const float* direction, int count, float* inverse) {
    const hn::CappedTag<float, 16> d;
    const auto tiny = hn::Set(d, 1e-30f);
    for (int i = 0; i < count; i += static_cast<int>(hn::Lanes(d))) {
        const auto v = hn::Load(d, direction + i);
        const auto safe = hn::IfThenElse(hn::Lt(hn::Abs(v), tiny), hn::CopySign(tiny, v), v);
        hn::Store(hn::Div(hn::Set(d, 1.0f), safe), d, inverse + i);
    }
}

void MeasureDirections(ObjectRays* rays, int count) {
    const hn::CappedTag<float, 16> d;
    for (int i = 0; i < count; i += static_cast<int>(hn::Lanes(d))) {
        const auto x = hn::Load(d, rays->directionX + i), y = hn::Load(d, rays->directionY + i),
                   z = hn::Load(d, rays->directionZ + i);
        const auto square = hn::Add(hn::Add(hn::Mul(x, x), hn::Mul(y, y)), hn::Mul(z, z));
        hn::Store(hn::Sqrt(square), d, rays->length + i);
    }
}

void CopyRays(const RayPacket& rays, ObjectRays* out) {
    std::copy(rays.originX, rays.originX + rays.count, out->originX);
    std::copy(rays.originY, rays.originY + rays.count, out->originY);
    std::copy(rays.originZ, rays.originZ + rays.count, out->originZ);
    std::copy(rays.directionX, rays.directionX + rays.count, out->directionX);
    std::copy(rays.directionY, rays.directionY + rays.count, out->directionY);
    std::copy(rays.directionZ, rays.directionZ + rays.count, out->directionZ);
}

void Transform(const RayPacket& rays, const AffineTransform& worldToObject, ObjectRays* out) {
    const int count = rays.count;
    if (worldToObject == AffineTransform()) {
        CopyRays(rays, out);
    } else {
        TransformComponents(worldToObject, true, count, rays.originX, rays.originY, rays.originZ,
                            out->originX, out->originY, out->originZ);
        TransformComponents(worldToObject, false, count, rays.directionX, rays.directionY,
                            rays.directionZ, out->directionX, out->directionY, out->directionZ);
    }
    const int padded = (count + 15) & ~15;
    for (int i = count; i < padded; ++i) {
        out->originX[i] = out->originY[i] = out->originZ[i] = 0;
        out->directionX[i] = out->directionY[i] = out->directionZ[i] = 1;
        out->tMin[i] = 0;
        out->tMax[i] = -1;
    }
    for (int i = 0; i < count; ++i) {
        out->tMin[i] = rays.tMin[i];
        out->tMax[i] = rays.tMax[i];
    }
    InvertDirections(out->directionX, padded, out->inverseX);
    InvertDirections(out->directionY, padded, out->inverseY);
    InvertDirections(out->directionZ, padded, out->inverseZ);
    MeasureDirections(out, padded);
}

}  // namespace HWY_NAMESPACE
}  // namespace cc
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cc {

HWY_EXPORT(Transform);

void TransformRays(const RayPacket& rays, const AffineTransform& worldToObject, ObjectRays* out) {
    out->count = rays.count;
    HWY_DYNAMIC_DISPATCH(Transform)(rays, worldToObject, out);
}

}  // namespace cc
#endif  // HWY_ONCE
