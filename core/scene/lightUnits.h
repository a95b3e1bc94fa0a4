#pragma once

#include <algorithm>
#include <cmath>

#include "core/math/vec.h"

namespace cc {

/// What UsdLux says about how bright a light is; initial values are the schema's.
struct LightUnits {
    float intensity = 1, exposure = 0, diffuse = 1;
    Vec3f color{1, 1, 1};
    bool normalize = false;
    bool enableColorTemperature = false;
    float colorTemperature = 6500;  ///< kelvin
    float angle = 0.53f;            ///< degrees, of a distant light
    float radius = 0.5f;            ///< of a sphere light, in its own space
    float scale = 1;                ///< of the light's transform
    bool treatAsPoint = false;
};

/// Linear Rec.709 colour of a black body, of the same luminance as white. The temperature is
/// clamped to 1000..10000 kelvin. The Planckian locus is Krystek's rational fit (1985).
inline Vec3f BlackbodyColor(float kelvin) {
    const double t = std::isfinite(kelvin) ? std::min(std::max(double(kelvin), 1e3), 1e4) : 6500;
    const double u = (0.860117757 + 1.54118254e-4 * t + 1.28641212e-7 * t * t) /
                     (1 + 8.42420235e-4 * t + 7.08145163e-7 * t * t);
    const double v = (0.317398726 + 4.22806245e-5 * t + 4.20481691e-8 * t * t) /
                     (1 - 2.89741816e-5 * t + 1.61456053e-7 * t * t);
    const double X = 3 * u / (2 * v), Y = 1, Z = (2 - u / 2 - 5 * v) / v;
    const double r = 3.2404542 * X - 1.5371385 * Y - 0.4985314 * Z;
    const double g = -0.9692660 * X + 1.8760108 * Y + 0.0415560 * Z;
    const double b = 0.0556434 * X - 0.2040259 * Y + 1.0572252 * Z;
    return {float(std::max(r, 0.0)), float(std::max(g, 0.0)), float(std::max(b, 0.0))};
}

/// Radiance that the light's surface emits, before normalize.
inline Vec3f LightRadiance(const LightUnits& units) {
    Vec3f radiance = units.color * (units.intensity * std::exp2(units.exposure) * units.diffuse);
    return units.enableColorTemperature ? radiance * BlackbodyColor(units.colorTemperature)
                                        : radiance;
}

/// Irradiance on a surface that faces a distant light: the radiance integrated over its cone, or
/// the radiance itself if it is normalized or has no size.
inline Vec3f DistantLightPower(const LightUnits& units) {
    constexpr double kPi = 3.14159265358979323846;
    const double halfAngle = std::min(std::fabs(double(units.angle)), 360.0) * (kPi / 360);
    const double sine2 = std::sin(halfAngle) * std::sin(halfAngle);
    const double area = kPi * (halfAngle <= kPi / 2 ? sine2 : 2 - sine2);
    const bool hasSize = !units.normalize && units.angle != 0;
    return LightRadiance(units) * (hasSize ? float(area) : 1.0f);
}

/// Radiant intensity of a sphere light seen from afar: the radiance times the area of its disk,
/// over the area of its surface if it is normalized. A point without size counts as normalized.
inline Vec3f SphereLightPower(const LightUnits& units) {
    constexpr float kPi = 3.14159265358979323846f;
    const float radius = std::fabs(units.radius * units.scale);
    const bool isNormalized = units.normalize || (units.treatAsPoint && radius == 0);
    return LightRadiance(units) * (isNormalized ? 0.25f : kPi * radius * radius);
}

/// True if every component is finite and none is negative.
inline bool IsUsableLightPower(const Vec3f& power) {
    return IsFinite(power) && power.x >= 0 && power.y >= 0 && power.z >= 0;
}

}  // namespace cc
