#pragma once

#include "core/math/vec.h"

namespace cc {

/// A light with hard shadows: infinitely far away, or a sphere seen as a point.
struct Light {
    enum class Kind { Distant, Sphere };

    Kind kind = Kind::Distant;
    /// Distant: unit direction in which light travels. Sphere: unused.
    Vec3f direction{0, 0, -1};
    /// Sphere: its centre in the world. Distant: unused.
    Vec3f position;
    /// Distant: irradiance on a surface that faces the light.
    /// Sphere: radiant intensity, irradiance times squared distance.
    /// Linear RGB; how UsdLux intensity, exposure, radius, angle and normalize make it is the
    /// caller's business.
    Vec3f power{1, 1, 1};
    bool castsShadows = true;
};

}  // namespace cc
