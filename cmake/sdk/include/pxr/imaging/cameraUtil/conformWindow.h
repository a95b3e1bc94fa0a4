#ifndef PXR_IMAGING_CAMERA_UTIL_CONFORM_WINDOW_H
#define PXR_IMAGING_CAMERA_UTIL_CONFORM_WINDOW_H

#include "pxr/imaging/cameraUtil/api.h"
#include "pxr/pxr.h"

PXR_NAMESPACE_OPEN_SCOPE

class GfMatrix4d;
class GfRange2d;
class GfVec2d;
class GfVec4d;

/// How a camera's window gives way to an image of another shape.
enum CameraUtilConformWindowPolicy {
    CameraUtilMatchVertically = 0,
    CameraUtilMatchHorizontally = 1,
    CameraUtilFit = 2,
    CameraUtilCrop = 3,
    CameraUtilDontConform = 4
};

/// The window, the sizes of a window, or the projection, changed to a given aspect ratio.
CAMERAUTIL_API GfRange2d CameraUtilConformedWindow(GfRange2d const &window,
                                                   CameraUtilConformWindowPolicy policy,
                                                   double targetAspect);
CAMERAUTIL_API GfVec4d CameraUtilConformedWindow(GfVec4d const &window,
                                                 CameraUtilConformWindowPolicy policy,
                                                 double targetAspect);
CAMERAUTIL_API GfVec2d CameraUtilConformedWindow(GfVec2d const &window,
                                                 CameraUtilConformWindowPolicy policy,
                                                 double targetAspect);
CAMERAUTIL_API GfMatrix4d CameraUtilConformedWindow(GfMatrix4d const &projectionMatrix,
                                                    CameraUtilConformWindowPolicy policy,
                                                    double targetAspect);

PXR_NAMESPACE_CLOSE_SCOPE

#endif
