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
      _far(std::min(camera.clipFar, std::numeric_limits<float>::max())),
      _hasLens(!camera.orthographic && camera.lensRadius > 0 && camera.focusDistance > 0) {
    AffineTransform worldToCamera;
    _isValid = camera.cameraToWorld.Invert(&worldToCamera) && std::isfinite(_pixelWidth) &&
               std::isfinite(_pixelHeight) && _near < _far;
}

void CameraRays::SetLensRay(double x, double y, const Vec2f& onLens, int lane,
                            RayPacket* rays) const {
    const AffineTransform& m = _camera.cameraToWorld;
    const double windowX = _camera.windowLower.x + x * _pixelWidth;
    const double windowY = _camera.windowLower.y + y * _pixelHeight;
    const bool parallel = _camera.orthographic;
    Vector start{}, toward{0, 0, -1};
    (parallel ? start : toward)[0] = windowX;
    (parallel ? start : toward)[1] = windowY;
    if (_hasLens) {
        // All rays of a point of the picture meet at the focus distance.
        start[0] = double(_camera.lensRadius) * onLens.x;
        start[1] = double(_camera.lensRadius) * onLens.y;
        toward[0] -= start[0] / _camera.focusDistance;
        toward[1] -= start[1] / _camera.focusDistance;
    }
    Vec3f origin, direction;
    for (int row = 0; row < 3; ++row) {
        origin[row] = static_cast<float>(m(row, 3) + (m(row, 0) * start[0] + m(row, 1) * start[1]));
        direction[row] =
            static_cast<float>((m(row, 0) * toward[0] + m(row, 1) * toward[1]) - m(row, 2));
    }
    rays->originX[lane] = origin.x;
    rays->originY[lane] = origin.y;
    rays->originZ[lane] = origin.z;
    rays->directionX[lane] = direction.x;
    rays->directionY[lane] = direction.y;
    rays->directionZ[lane] = direction.z;
    _Clip(start, toward, &rays->tMin[lane], &rays->tMax[lane]);
}

void CameraRays::_Clip(const Vector& origin, const Vector& direction, float* tMin,
                       float* tMax) const {
    double low = _near, high = _far;
    for (const ClipPlane& plane : _camera.clipPlanes) {
        double at = plane.offset, slope = 0;
        for (int axis = 0; axis < 3; ++axis) {
            at += plane.normal[axis] * origin[axis];
            slope += plane.normal[axis] * direction[axis];
        }
        if (slope > 0) {
            low = std::max(low, -at / slope);
        } else if (slope < 0) {
            high = std::min(high, -at / slope);
        } else if (at < 0) {
            high = -std::numeric_limits<double>::infinity();
        }
    }
    // What is left of a ray may lie beyond the numbers that single precision has.
    constexpr double kLargest = std::numeric_limits<float>::max();
    const bool isEmpty = !(low <= high) || low > kLargest;
    *tMin = isEmpty ? 0 : static_cast<float>(low);
    *tMax = isEmpty ? -1 : static_cast<float>(high);
}

float CameraRays::ProjectedDepth(float t) const {
    // For a perspective camera (1/n - 1/t) / (1/n - 1/f), in a form that allows n = 0.
    const double depth =
        _camera.orthographic ? (t - _near) / (_far - _near) : (1 - _near / t) / (1 - _near / _far);
    return static_cast<float>(std::min(std::max(depth, 0.0), 1.0));
}

}  // namespace cc
