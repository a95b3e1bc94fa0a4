#include "core/render/cameraRays.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cc {

CameraRays::CameraRays(const Camera& camera, int width, int height)
    : _camera(camera),
      _pixelWidth((double(camera.windowUpper.x) - camera.windowLower.x) / width),
      _pixelHeight((double(camera.windowUpper.y) - camera.windowLower.y) / height),
      // Nothing behind a perspective camera's eye is seen, whatever its clipping range says.
      _near(camera.orthographic ? camera.clipNear : std::max(camera.clipNear, 0.0f)),
      _far(std::min(camera.clipFar, std::numeric_limits<float>::max())) {
    AffineTransform worldToCamera;
    _isValid = camera.cameraToWorld.Invert(&worldToCamera) && std::isfinite(_pixelWidth) &&
               std::isfinite(_pixelHeight) && _near < _far;
}

void CameraRays::SetRay(double x, double y, int lane, RayPacket* rays) const {
    const AffineTransform& m = _camera.cameraToWorld;
    const double windowX = _camera.windowLower.x + x * _pixelWidth;
    const double windowY = _camera.windowLower.y + y * _pixelHeight;
    Vec3f origin, direction;
    for (int row = 0; row < 3; ++row) {
        const double across = m(row, 0) * windowX + m(row, 1) * windowY;
        const bool parallel = _camera.orthographic;
        origin[row] = static_cast<float>(m(row, 3) + (parallel ? across : 0));
        direction[row] = static_cast<float>((parallel ? 0 : across) - m(row, 2));
    }
    rays->originX[lane] = origin.x;
    rays->originY[lane] = origin.y;
    rays->originZ[lane] = origin.z;
    rays->directionX[lane] = direction.x;
    rays->directionY[lane] = direction.y;
    rays->directionZ[lane] = direction.z;
    rays->tMin[lane] = static_cast<float>(_near);
    rays->tMax[lane] = static_cast<float>(_far);
}

float CameraRays::ProjectedDepth(float t) const {
    // For a perspective camera (1/n - 1/t) / (1/n - 1/f), in a form that allows n = 0.
    const double depth =
        _camera.orthographic ? (t - _near) / (_far - _near) : (1 - _near / t) / (1 - _near / _far);
    return static_cast<float>(std::min(std::max(depth, 0.0), 1.0));
}

}  // namespace cc
