#include "core/trace/packetInterval.h"

#include <algorithm>
#include <cmath>
#include <limits>

#ifndef CC_TRACE_PACKET_INTERVAL_ONCE
#define CC_TRACE_PACKET_INTERVAL_ONCE
namespace cc {
namespace {

struct FloatRange {
    float least, greatest;
};

/// Of rays as functions of the distance along an axis; sides are the two axes after it.
struct IntervalRanges {
    FloatRange near, origins[3], slopes[2];
};

const float* Origins(const ObjectRays& rays, int axis) {
    return axis == 0 ? rays.originX : axis == 1 ? rays.originY : rays.originZ;
}
const float* Directions(const ObjectRays& rays, int axis) {
    return axis == 0 ? rays.directionX : axis == 1 ? rays.directionY : rays.directionZ;
}

}  // namespace
}  // namespace cc
#endif

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/trace/packetInterval.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace cc {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<float, 16>;
using V = hn::Vec<Tag>;

/// The least and the greatest of values of rays that are not done.
class Range {
  public:
    HWY_INLINE Range()
        : _low(hn::Set(Tag(), std::numeric_limits<float>::infinity())), _high(hn::Neg(_low)) {}

    HWY_INLINE void Add(hn::Mask<Tag> isActive, V values) {
        const V infinity = hn::Set(Tag(), std::numeric_limits<float>::infinity());
        _low = hn::Min(_low, hn::IfThenElse(isActive, values, infinity));
        _high = hn::Max(_high, hn::IfThenElse(isActive, values, hn::Neg(infinity)));
    }
    HWY_INLINE FloatRange Reduce() const {
        return {hn::GetLane(hn::MinOfLanes(Tag(), _low)),
                hn::GetLane(hn::MaxOfLanes(Tag(), _high))};
    }

  private:
    V _low, _high;
};

/// Calls add(isActive, first) for vectors of rays.
template <class Add>
HWY_INLINE void ForActive(const ObjectRays& rays, const Add& add) {
    const Tag d;
    for (int i = 0; i < rays.count; i += static_cast<int>(hn::Lanes(d))) {
        add(hn::Le(hn::Load(d, rays.tMin + i), hn::Load(d, rays.tMax + i)), i);
    }
}

void MeasureDirections(const ObjectRays& rays, FloatRange directions[3], FloatRange* length) {
    const Tag d;
    Range x, y, z, lengths;
    ForActive(rays, [&](hn::Mask<Tag> isActive, int i) {
        x.Add(isActive, hn::Load(d, rays.directionX + i));
        y.Add(isActive, hn::Load(d, rays.directionY + i));
        z.Add(isActive, hn::Load(d, rays.directionZ + i));
        lengths.Add(isActive, hn::Load(d, rays.length + i));
    });
    directions[0] = x.Reduce();
    directions[1] = y.Reduce();
    directions[2] = z.Reduce();
    *length = lengths.Reduce();
}

void MeasureAlong(const ObjectRays& rays, int axis, IntervalRanges* ranges) {
    const Tag d;
    const int axes[3] = {axis, (axis + 1) % 3, (axis + 2) % 3};
    Range near, origins[3], slopes[2];
    ForActive(rays, [&](hn::Mask<Tag> isActive, int i) {
        const V speed = hn::Abs(hn::Load(d, Directions(rays, axis) + i));
        near.Add(isActive, hn::Mul(hn::Load(d, rays.tMin + i), speed));
        for (int k = 0; k < 3; ++k) {
            origins[k].Add(isActive, hn::Load(d, Origins(rays, axes[k]) + i));
        }
        for (int k = 0; k < 2; ++k) {
            slopes[k].Add(isActive, hn::Div(hn::Load(d, Directions(rays, axes[k + 1]) + i), speed));
        }
    });
    ranges->near = near.Reduce();
    for (int k = 0; k < 3; ++k) {
        ranges->origins[k] = origins[k].Reduce();
    }
    for (int k = 0; k < 2; ++k) {
        ranges->slopes[k] = slopes[k].Reduce();
    }
}

void MeasureReach(const ObjectRays& rays, int axis, float* reach) {
    const Tag d;
    Range far;
    ForActive(rays, [&](hn::Mask<Tag> isActive, int i) {
        far.Add(isActive, hn::Mul(hn::Load(d, rays.tMax + i),
                                  hn::Abs(hn::Load(d, Directions(rays, axis) + i))));
    });
    *reach = far.Reduce().greatest;
}

}  // namespace HWY_NAMESPACE
}  // namespace cc
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cc {
namespace {

HWY_EXPORT(MeasureDirections);
HWY_EXPORT(MeasureAlong);
HWY_EXPORT(MeasureReach);

/// Widening of slopes and origins that covers the rounding of their arithmetic.
constexpr float kMargin = 1e-6f;

float Margin(const FloatRange& range) {
    return kMargin * std::max(std::fabs(range.least), std::fabs(range.greatest));
}

}  // namespace

PacketInterval::PacketInterval(const ObjectRays& rays) {
    _ChooseAxis(rays);
    if (!IsValid()) {
        return;
    }
    IntervalRanges ranges;
    HWY_DYNAMIC_DISPATCH(MeasureAlong)(rays, _axis, &ranges);
    _originMin = ranges.origins[0].least;
    _originMax = ranges.origins[0].greatest;
    if (_reversed) {
        std::swap(_originMin, _originMax);
        _originMin = -_originMin;
        _originMax = -_originMax;
    }
    _nearest = ranges.near.least - kMargin * std::fabs(ranges.near.least);
    for (int i = 0; i < 2; ++i) {
        const FloatRange origins = ranges.origins[i + 1], slopes = ranges.slopes[i];
        _sides[i] = {(_axis + 1 + i) % 3, origins.least - Margin(origins),
                     origins.greatest + Margin(origins), slopes.least - Margin(slopes),
                     slopes.greatest + Margin(slopes)};
    }
    UpdateReach(rays);
}

void PacketInterval::UpdateReach(const ObjectRays& rays) {
    if (!IsValid()) {
        return;
    }
    HWY_DYNAMIC_DISPATCH(MeasureReach)(rays, _axis, &_reach);
    _reach += kMargin * std::fabs(_reach);
}

/// The axis along which every ray runs the same way, and the slowest of them is fastest.
void PacketInterval::_ChooseAxis(const ObjectRays& rays) {
    FloatRange directions[3], length;
    HWY_DYNAMIC_DISPATCH(MeasureDirections)(rays, directions, &length);
    // Below this slopes get so steep that nothing is culled.
    float best = 1e-3f * length.greatest;
    for (int axis = 0; axis < 3; ++axis) {
        const FloatRange& range = directions[axis];
        const float speed = range.least > 0      ? range.least
                            : range.greatest < 0 ? -range.greatest
                                                 : 0;
        // A packet without rays has no range.
        if (speed > best && std::isfinite(speed)) {
            best = speed;
            _axis = axis;
            _reversed = range.greatest < 0;
        }
    }
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
