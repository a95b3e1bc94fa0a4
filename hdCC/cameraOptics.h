#ifndef HDCC_CAMERA_OPTICS_H
#define HDCC_CAMERA_OPTICS_H

#include <string>
#include <vector>

#include "core/scene/camera.h"

#include "pxr/base/gf/vec4d.h"
#include "pxr/imaging/hd/camera.h"
#include "pxr/pxr.h"

#include "hdCC/shutter.h"

PXR_NAMESPACE_OPEN_SCOPE

/// What a camera has beyond its matrices and clipping range: lens, exposure, shutter, clipping
/// planes.
struct HdCCCameraOptics {
    float lensRadius = 0, focusDistance = 0;  ///< in the scene's unit; 0 is a pinhole
    float exposure = 1;                       ///< a factor
    HdCCShutter shutter;
    std::vector<GfVec4d> clipPlanes;  ///< in camera space, all of them usable

    bool operator==(HdCCCameraOptics const &b) const;

    void Apply(cc::Camera *camera) const;
};

/// Whatever makes no sense is left out.
/// @param clipPlanes  that the render pass has enabled
/// @param warnings    gets a line for each thing that is left out
HdCCCameraOptics HdCCReadOptics(HdCamera const &camera, std::vector<GfVec4d> const &clipPlanes,
                                std::vector<std::string> *warnings);

PXR_NAMESPACE_CLOSE_SCOPE

#endif
