#include "core/render/levelView.h"

#include <algorithm>
#include <cmath>

namespace cc {

LevelView MakeLevelView(const Camera& camera, int width, int height) {
    LevelView view{};
    const AffineTransform& m = camera.cameraToWorld;
    view.eye = {m(0, 3), m(1, 3), m(2, 3)};
    const Vec3f axis{static_cast<float>(-m(0, 2)), static_cast<float>(-m(1, 2)),
                     static_cast<float>(-m(2, 2))};
    const float unit = Length(axis);
    view.forward = axis * (1 / unit);
    view.isOrthographic = camera.orthographic;
    const Vec2f lower = camera.isCrop ? camera.wholeLower : camera.windowLower;
    const Vec2f upper = camera.isCrop ? camera.wholeUpper : camera.windowUpper;
    const float x = std::max(std::fabs(lower.x), std::fabs(upper.x));
    const float y = std::max(std::fabs(lower.y), std::fabs(upper.y));
    view.leastCosine = 1 / std::sqrt(1 + x * x + y * y);
    view.pixels = std::max(
        static_cast<float>(width) / std::fabs(camera.windowUpper.x - camera.windowLower.x),
        static_cast<float>(height) / std::fabs(camera.windowUpper.y - camera.windowLower.y));
    if (camera.orthographic) {
        view.pixels /= unit;  // windows are in camera space
    } else {
        // Off the axis a step away from the eye moves a point in the picture, too.
        view.pixels /= view.leastCosine;
    }
    return view;
}

}  // namespace cc
