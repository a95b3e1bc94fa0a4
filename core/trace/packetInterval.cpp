#include "core/trace/packetInterval.h"

#include <algorithm>
#include <cmath>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/trace/packetInterval.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace cc {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// The least and the greatest of value(i) over vectors of rays that are not done.
template <class Value>
HWY_INLINE void MeasureActive(const ObjectRays& rays, const Value& value, float* least,
                              float* greatest) {
    const hn::CappedTag<float, 16> d;
    const auto infinity = hn::Set(d, std::numeric_limits<float>::infinity());
    auto low = infinity, high = hn::Neg(infinity);
    for (int i = 0; i < rays.count; i += static_cast<int>(hn::Lanes(d))) {
        const auto isActive = hn::Le(hn::Load(d, rays.tMin + i), hn::Load(d, rays.tMax + i));
        const auto v = value(d, i);
        low = hn::Min(low, hn::IfThenElse(isActive, v, infinity));
        high = hn::Max(high, hn::IfThenElse(isActive, v, hn::Neg(infinity)));
    }
    *least = hn::GetLane(hn::MinOfLanes(d, low));
    *greatest = hn::GetLane(hn::MaxOfLanes(d, high));
}

void MeasureValues(const ObjectRays& rays, const float* values, float* least, float* greatest) {
    MeasureActive(rays, [&](auto d, int i) { return hn::Load(d, values + i); }, least, greatest);
}

void MeasureRatios(const ObjectRays& rays, const float* values, const float* divisors, float* least,
                   float* greatest) {
    MeasureActive(
        rays,
        [&](auto d, int i) {
            return hn::Div(hn::Load(d, values + i), hn::Abs(hn::Load(d, divisors + i)));
        },
        least, greatest);
}

void MeasureProducts(const ObjectRays& rays, const float* values, const float* factors,
                     float* least, float* greatest) {
    MeasureActive(
        rays,
        [&](auto d, int i) {
            return hn::Mul(hn::Load(d, values + i), hn::Abs(hn::Load(d, factors + i)));
        },
        least, greatest);
}

}  // namespace HWY_NAMESPACE
}  // namespace cc
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cc {
namespace {

HWY_EXPORT(MeasureValues);
HWY_EXPORT(MeasureRatios);
HWY_EXPORT(MeasureProducts);

/// Widening of slopes and origins that covers the rounding of their arithmetic.
constexpr float kMargin = 1e-6f;

const float* Origins(const ObjectRays& rays, int axis) {
    return axis == 0 ? rays.originX : axis == 1 ? rays.originY : rays.originZ;
}
const float* Directions(const ObjectRays& rays, int axis) {
    return axis == 0 ? rays.directionX : axis == 1 ? rays.directionY : rays.directionZ;
}

}  // namespace

PacketInterval::PacketInterval(const ObjectRays& rays) {
    _ChooseAxis(rays);
    if (!IsValid()) {
        return;
    }
    HWY_DYNAMIC_DISPATCH(MeasureValues)(rays, Origins(rays, _axis), &_originMin, &_originMax);
    if (_reversed) {
        std::swap(_originMin, _originMax);
        _originMin = -_originMin;
        _originMax = -_originMax;
    }
    float farthest;
    HWY_DYNAMIC_DISPATCH(MeasureProducts)
    (rays, rays.tMin, Directions(rays, _axis), &_nearest, &farthest);
    _nearest -= kMargin * std::fabs(_nearest);
    _sides[0] = _MeasureSide(rays, (_axis + 1) % 3);
    _sides[1] = _MeasureSide(rays, (_axis + 2) % 3);
    UpdateReach(rays);
}

void PacketInterval::UpdateReach(const ObjectRays& rays) {
    if (!IsValid()) {
        return;
    }
    float nearest;
    HWY_DYNAMIC_DISPATCH(MeasureProducts)
    (rays, rays.tMax, Directions(rays, _axis), &nearest, &_reach);
    _reach += kMargin * std::fabs(_reach);
}

/// The axis along which every ray runs the same way, and the slowest of them is fastest.
void PacketInterval::_ChooseAxis(const ObjectRays& rays) {
    float best = 0;
    for (int axis = 0; axis < 3; ++axis) {
        float low, high;
        HWY_DYNAMIC_DISPATCH(MeasureRatios)
        (rays, Directions(rays, axis), rays.length, &low, &high);
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
    Slab side{axis, 0, 0, 0, 0};
    HWY_DYNAMIC_DISPATCH(MeasureValues)
    (rays, Origins(rays, axis), &side.originMin, &side.originMax);
    HWY_DYNAMIC_DISPATCH(MeasureRatios)
    (rays, Directions(rays, axis), Directions(rays, _axis), &side.slopeMin, &side.slopeMax);
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
#endif  // HWY_ONCE
