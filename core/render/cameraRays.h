#pragma once

#include <array>

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

    /// True if rays start anywhere on a lens, not all at its centre.
    bool HasLens() const { return _hasLens; }

    /// Fills a lane with the ray through a point of the picture, in pixels from the lower left,
    /// and through the centre of the lens. It ends where the clipping range and planes say; if they
    /// leave nothing of it, tMax is below tMin.
    void SetRay(double x, double y, int lane, RayPacket* rays) const {
        SetLensRay(x, y, {0, 0}, lane, rays);
    }

    /// The same through another point of the lens.
    /// @param onLens  in the unit disk; without a lens it does not matter
    void SetLensRay(double x, double y, const Vec2f& onLens, int lane, RayPacket* rays) const;

    /// The depth AOV of a distance along the view axis: 0 at the near plane, 1 at the far plane.
    float ProjectedDepth(float t) const;

    /// What colour is multiplied by.
    float Exposure() const { return _camera.exposure; }

    /// Unit normal in camera space of a normal in the world.
    Vec3f CameraNormal(const Vec3f& worldNormal) const {
        return Normalize(_camera.cameraToWorld.NormalByInverse(worldNormal));
    }

  private:
    /// A point or direction in camera space.
    using Vector = std::array<double, 3>;

    void _Clip(const Vector& origin, const Vector& direction, float* tMin, float* tMax) const;

    Camera _camera;
    double _pixelWidth, _pixelHeight;
    double _near, _far;
    bool _hasLens;
    bool _isValid;
};

}  // namespace cc
