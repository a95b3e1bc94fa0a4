#ifndef HDCC_SHUTTER_H
#define HDCC_SHUTTER_H

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/scene/moving.h"

#include "pxr/pxr.h"

PXR_NAMESPACE_OPEN_SCOPE

/// When a camera takes its picture: in frames from the one that is rendered.
struct HdCCShutter {
    float open = 0, close = 0;

    bool IsOpen() const { return open < close; }
    bool operator==(HdCCShutter const &b) const { return open == b.open && close == b.close; }
};

/// Asks a scene delegate for the samples of a value while a shutter is open. Samples that are all
/// alike are one.
/// @param ask   called with how many there is room for, and the room for times and values; it
///              returns how many there are, as the Sample methods of HdSceneDelegate do
/// @param rest  gives the value at the frame's own time: all that there is if the shutter is
///              closed, or at the time code Default
template <class T, class Ask, class Rest>
cc::Moving<T> HdCCSample(HdCCShutter const &shutter, Ask const &ask, Rest const &rest) {
    if (!shutter.IsOpen()) {
        return cc::Moving<T>(rest());
    }
    constexpr size_t kRoom = 4;
    std::vector<float> times(kRoom);
    std::vector<T> values(kRoom);
    size_t count = ask(kRoom, times.data(), values.data());
    if (count > kRoom) {
        times.resize(count);
        values.resize(count);
        count = std::min(count, ask(count, times.data(), values.data()));
    }
    std::vector<float> rising;
    std::vector<T> poses;
    for (size_t i = 0; i < count; ++i) {
        if (std::isfinite(times[i]) && (rising.empty() || times[i] > rising.back())) {
            rising.push_back(times[i]);
            poses.push_back(std::move(values[i]));
        }
    }
    if (poses.empty()) {
        return cc::Moving<T>(rest());
    }
    const bool isAtRest = std::all_of(poses.begin(), poses.end(),
                                      [&](T const &pose) { return pose == poses.front(); });
    return isAtRest ? cc::Moving<T>(std::move(poses.front()))
                    : cc::Moving<T>(std::move(rising), std::move(poses));
}

/// The same motion in another type.
template <class To, class From, class Convert>
cc::Moving<To> HdCCConvertPoses(cc::Moving<From> const &moving, Convert const &convert) {
    std::vector<To> poses;
    for (From const &pose : moving.Poses()) {
        poses.push_back(convert(pose));
    }
    return {moving.Times(), std::move(poses)};
}

PXR_NAMESPACE_CLOSE_SCOPE

#endif
