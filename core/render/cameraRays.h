#pragma once

#include "core/math/transform.h"
#include "core/scene/camera.h"
#include "core/trace/rayPacket.h"

namespace cc {

/// Makes the rays of a camera for a picture of some size. The parameter t of a ray is the distance
/// along the camera's view axis, so that clipping is a range of t and a hit's t is its depth.
class CameraRays {
  public:
    CameraRays(const Camera& camera, int width, int height);

    /// False if the camera's transform, window or clipping range can show nothing.
    bool IsValid() const { return _isValid; }

    /// Fills a lane with the ray through a point of the picture, in pixels from the lower left.
    void SetRay(double x, double y, int lane, RayPacket* rays) const;

    /// The t at which rays end.
    float FarEnd() const { return static_cast<float>(_far); }

    /// The depth AOV of a distance along the view axis: 0 at the near plane, 1 at the far plane.
    float ProjectedDepth(float t) const;

    /// Unit normal in camera space of a normal in the world.
    Vec3f CameraNormal(const Vec3f& worldNormal) const {
        return Normalize(_camera.cameraToWorld.NormalByInverse(worldNormal));
    }

  private:
    Camera _camera;
    double _pixelWidth, _pixelHeight;
    double _near, _far;
    bool _isValid;
};

}  // namespace cc
