#ifndef PXR_IMAGING_CAMERA_UTIL_FRAMING_H
#define PXR_IMAGING_CAMERA_UTIL_FRAMING_H

#include "pxr/base/gf/matrix4d.h"
#include "pxr/base/gf/range2f.h"
#include "pxr/base/gf/rect2i.h"
#include "pxr/imaging/cameraUtil/api.h"
#include "pxr/imaging/cameraUtil/conformWindow.h"
#include "pxr/pxr.h"

PXR_NAMESPACE_OPEN_SCOPE

/// Where a camera's picture lies in a buffer: the window that the camera fills, and the pixels of
/// it that are wanted. The y axis of both points down.
class CameraUtilFraming final {
  public:
    CAMERAUTIL_API CameraUtilFraming();
    CAMERAUTIL_API CameraUtilFraming(GfRange2f const &displayWindow, GfRect2i const &dataWindow,
                                     float pixelAspectRatio = 1.0f);
    CAMERAUTIL_API explicit CameraUtilFraming(GfRect2i const &dataWindow);

    /// False when nothing is framed; the viewport is then what counts.
    CAMERAUTIL_API bool IsValid() const;

    CAMERAUTIL_API bool operator==(CameraUtilFraming const &other) const;
    CAMERAUTIL_API bool operator!=(CameraUtilFraming const &other) const;

    CAMERAUTIL_API GfRange2f ComputeFilmbackWindow(
        float cameraAspectRatio, CameraUtilConformWindowPolicy windowPolicy) const;
    CAMERAUTIL_API GfMatrix4d ApplyToProjectionMatrix(
        GfMatrix4d const &projectionMatrix, CameraUtilConformWindowPolicy windowPolicy) const;

    GfRange2f displayWindow;
    GfRect2i dataWindow;
    float pixelAspectRatio;
};

PXR_NAMESPACE_CLOSE_SCOPE

#endif
