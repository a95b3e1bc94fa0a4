#pragma once

#include <string>

namespace cc {

/// How linear colour becomes display colour (usdrecord's --colorCorrectionMode).
enum class ColorCorrection { Disabled, SRGB, OpenColorIO };

/// What OpenColorIO mode converts by; empty fields take the configuration's defaults.
struct OpenColorIOOptions {
    std::string display, view, colorSpace, look;
};

/// Converts RGBA floats in place, from scene-linear Rec.709. The configuration is $OCIO, or
/// OpenColorIO's built-in one.
/// Returns an empty string, or one line that says what went wrong.
std::string ApplyDisplayTransform(ColorCorrection mode, const OpenColorIOOptions& options,
                                  float* rgba, int width, int height);

}  // namespace cc
