#include "core/trace/objectRays.h"

#include <cmath>

namespace cc {
namespace {

/// The reciprocal for slab tests: of a zero, large but finite, so that zero times it is zero.
float SafeInverse(float d) {
    constexpr float kTiny = 1e-30f;
    return 1 / (std::fabs(d) < kTiny ? std::copysign(kTiny, d) : d);
}

void FillDone(int lane, ObjectRays* out) {
    out->originX[lane] = out->originY[lane] = out->originZ[lane] = 0;
    out->directionX[lane] = out->directionY[lane] = out->directionZ[lane] = 1;
    out->inverseX[lane] = out->inverseY[lane] = out->inverseZ[lane] = 1;
    out->length[lane] = 1;
    out->tMin[lane] = 0;
    out->tMax[lane] = -1;
}

}  // namespace

void TransformRays(const RayPacket& rays, const AffineTransform& worldToObject, ObjectRays* out) {
    const AffineTransform& m = worldToObject;
    out->count = rays.count;
    for (int i = 0; i < rays.count; ++i) {
        // Doubles: origin and translation may be large and nearly cancel.
        const double ox = rays.originX[i], oy = rays.originY[i], oz = rays.originZ[i];
        const double dx = rays.directionX[i], dy = rays.directionY[i], dz = rays.directionZ[i];
        out->originX[i] = static_cast<float>(m(0, 0) * ox + m(0, 1) * oy + m(0, 2) * oz + m(0, 3));
        out->originY[i] = static_cast<float>(m(1, 0) * ox + m(1, 1) * oy + m(1, 2) * oz + m(1, 3));
        out->originZ[i] = static_cast<float>(m(2, 0) * ox + m(2, 1) * oy + m(2, 2) * oz + m(2, 3));
        const auto x = static_cast<float>(m(0, 0) * dx + m(0, 1) * dy + m(0, 2) * dz);
        const auto y = static_cast<float>(m(1, 0) * dx + m(1, 1) * dy + m(1, 2) * dz);
        const auto z = static_cast<float>(m(2, 0) * dx + m(2, 1) * dy + m(2, 2) * dz);
        out->directionX[i] = x;
        out->directionY[i] = y;
        out->directionZ[i] = z;
        out->inverseX[i] = SafeInverse(x);
        out->inverseY[i] = SafeInverse(y);
        out->inverseZ[i] = SafeInverse(z);
        out->length[i] = std::sqrt(x * x + y * y + z * z);
        out->tMin[i] = rays.tMin[i];
        out->tMax[i] = rays.tMax[i];
    }
    const int end = (rays.count + 15) & ~15;
    for (int i = rays.count; i < end; ++i) {
        FillDone(i, out);
    }
}

}  // namespace cc
