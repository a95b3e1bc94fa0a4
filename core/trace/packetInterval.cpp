#include "core/trace/packetInterval.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cc {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Widening of slopes and origins that covers the rounding of their arithmetic.
constexpr float kMargin = 1e-6f;

const float* Origins(const ObjectRays& rays, int axis) {
    return axis == 0 ? rays.originX : axis == 1 ? rays.originY : rays.originZ;
}
const float* Directions(const ObjectRays& rays, int axis) {
    return axis == 0 ? rays.directionX : axis == 1 ? rays.directionY : rays.directionZ;
}
bool IsActive(const ObjectRays& rays, int i) { return rays.tMin[i] <= rays.tMax[i]; }

}  // namespace

PacketInterval::PacketInterval(const ObjectRays& rays) {
    _ChooseAxis(rays);
    if (!IsValid()) {
        return;
    }
    const float* origins = Origins(rays, _axis);
    const float* directions = Directions(rays, _axis);
    _originMin = _nearest = kInfinity;
    _originMax = -kInfinity;
    for (int i = 0; i < rays.count; ++i) {
        if (IsActive(rays, i)) {
            const float origin = _reversed ? -origins[i] : origins[i];
            _originMin = std::min(_originMin, origin);
            _originMax = std::max(_originMax, origin);
            _nearest = std::min(_nearest, rays.tMin[i] * std::fabs(directions[i]));
        }
    }
    _nearest -= kMargin * std::fabs(_nearest);
    _sides[0] = _MeasureSide(rays, (_axis + 1) % 3);
    _sides[1] = _MeasureSide(rays, (_axis + 2) % 3);
    UpdateReach(rays);
}

void PacketInterval::UpdateReach(const ObjectRays& rays) {
    if (!IsValid()) {
        return;
    }
    const float* directions = Directions(rays, _axis);
    _reach = -kInfinity;
    for (int i = 0; i < rays.count; ++i) {
        if (IsActive(rays, i)) {
            _reach = std::max(_reach, rays.tMax[i] * std::fabs(directions[i]));
        }
    }
    _reach += kMargin * std::fabs(_reach);
}

/// The axis along which every ray runs the same way, and the slowest of them is fastest.
void PacketInterval::_ChooseAxis(const ObjectRays& rays) {
    float best = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const float* directions = Directions(rays, axis);
        float low = kInfinity, high = -kInfinity;
        for (int i = 0; i < rays.count; ++i) {
            if (IsActive(rays, i)) {
                const float d = directions[i] / rays.length[i];
                low = std::min(low, d);
                high = std::max(high, d);
            }
        }
        const float speed = low > 0 ? low : high < 0 ? -high : 0;
        // Below this slopes get so steep that nothing is culled.
        if (speed > best && speed > 1e-3f && speed <= 1.1f) {
            best = speed;
            _axis = axis;
            _reversed = high < 0;
        }
    }
}

PacketInterval::Slab PacketInterval::_MeasureSide(const ObjectRays& rays, int axis) const {
    const float* origins = Origins(rays, axis);
    const float* directions = Directions(rays, axis);
    const float* along = Directions(rays, _axis);
    Slab side{axis, kInfinity, -kInfinity, kInfinity, -kInfinity};
    for (int i = 0; i < rays.count; ++i) {
        if (IsActive(rays, i)) {
            const float slope = directions[i] / std::fabs(along[i]);
            side.originMin = std::min(side.originMin, origins[i]);
            side.originMax = std::max(side.originMax, origins[i]);
            side.slopeMin = std::min(side.slopeMin, slope);
            side.slopeMax = std::max(side.slopeMax, slope);
        }
    }
    const float slopeMargin =
        kMargin * std::max(std::fabs(side.slopeMin), std::fabs(side.slopeMax));
    const float originMargin =
        kMargin * std::max(std::fabs(side.originMin), std::fabs(side.originMax));
    side.slopeMin -= slopeMargin;
    side.slopeMax += slopeMargin;
    side.originMin -= originMargin;
    side.originMax += originMargin;
    return side;
}

bool PacketInterval::Culls(const Box3f& box) const {
    if (!IsValid()) {
        return false;
    }
    const float low = _reversed ? -box.upper[_axis] : box.lower[_axis];
    const float high = _reversed ? -box.lower[_axis] : box.upper[_axis];
    const float far = high - _originMin;
    const float near = std::max(low - _originMax, 0.0f);
    if (far < _nearest || near > _reach) {
        return true;
    }
    for (const Slab& side : _sides) {
        const float least = side.originMin + std::min(side.slopeMin * near, side.slopeMin * far);
        const float most = side.originMax + std::max(side.slopeMax * near, side.slopeMax * far);
        if (least > box.upper[side.axis] || most < box.lower[side.axis]) {
            return true;
        }
    }
    return false;
}

}  // namespace cc
