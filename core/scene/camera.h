#pragma once

#include "core/math/transform.h"

namespace cc {

/// A pinhole or orthographic camera that looks down its -z axis with +y up.
struct Camera {
    AffineTransform cameraToWorld;
    bool orthographic = false;
    /// The window on the image plane: at distance 1 for a perspective camera, in camera space for
    /// an orthographic one. Pixel (0, 0) is at the lower left corner.
    Vec2f windowLower{-1, -1}, windowUpper{1, 1};
    /// If the window is a part of a larger picture: the window of that. How finely surfaces are cut
    /// depends on the whole.
    bool isCrop = false;
    Vec2f wholeLower{-1, -1}, wholeUpper{1, 1};
    /// Distances along -z between which surfaces are seen.
    float clipNear = 0.01f, clipFar = 1e6f;
};

}  // namespace cc
