#pragma once

#include <vector>

#include "core/math/transform.h"
#include "core/scene/moving.h"

namespace cc {

/// Half of a camera's space: a point p is seen if Dot(normal, p) + offset >= 0.
struct ClipPlane {
    Vec3f normal;
    float offset = 0;
};

/// A perspective or orthographic camera that looks down its -z axis with +y up.
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
    /// What is seen lies on the visible side of all of these. Shadows know nothing of them.
    std::vector<ClipPlane> clipPlanes;
    /// Of a thin lens, in camera space: things at the focus distance along -z are sharp, others
    /// blurred. 0 is a pinhole; an orthographic camera has no lens.
    float lensRadius = 0, focusDistance = 0;
    /// What colour is multiplied by, coverage left out.
    float exposure = 1;
    /// When the samples of colour are taken, in frames from the one that is rendered: at times from
    /// shutterOpen to shutterClose. All else is seen at time 0.
    float shutterOpen = 0, shutterClose = 0;
    /// How cameraToWorld moves, if it does; it is itself the pose at time 0.
    Moving<AffineTransform> motion;

    /// The camera as it is at a time.
    Camera At(float time) const {
        Camera camera = *this;
        if (motion.IsMoving()) {
            const auto poses = motion.At(time);
            camera.cameraToWorld = AffineTransform::Lerp(poses.first, poses.second, poses.weight);
        }
        return camera;
    }
};

}  // namespace cc
