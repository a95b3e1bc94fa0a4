#include "hdCC/cameraOptics.h"

#include <algorithm>
#include <cmath>

#include "pxr/base/gf/vec3f.h"
#include "pxr/base/gf/vec4f.h"
#include "pxr/base/tf/stringUtils.h"

#include "hdCC/convert.h"

PXR_NAMESPACE_OPEN_SCOPE

bool HdCCCameraOptics::operator==(HdCCCameraOptics const &b) const {
    return lensRadius == b.lensRadius && focusDistance == b.focusDistance &&
           exposure == b.exposure && shutter == b.shutter && clipPlanes == b.clipPlanes;
}

void HdCCCameraOptics::Apply(cc::Camera *camera) const {
    camera->lensRadius = lensRadius;
    camera->focusDistance = focusDistance;
    camera->exposure = exposure;
    camera->shutterOpen = shutter.open;
    camera->shutterClose = shutter.close;
    for (GfVec4d const &plane : clipPlanes) {
        camera->clipPlanes.push_back(
            {HdCCToVec3f(GfVec3f(float(plane[0]), float(plane[1]), float(plane[2]))),
             float(plane[3])});
    }
}

static void _ReadLens(HdCamera const &camera, HdCCCameraOptics *optics,
                      std::vector<std::string> *warnings) {
    const float fStop = camera.GetFStop(), focusDistance = camera.GetFocusDistance();
    if (fStop == 0 || camera.GetProjection() == HdCamera::Orthographic) {
        return;
    }
    if (!(fStop > 0) || !std::isfinite(fStop)) {
        warnings->push_back(TfStringPrintf("fStop is %g; everything is in focus", fStop));
        return;
    }
    if (!(focusDistance > 0) || !std::isfinite(focusDistance)) {
        warnings->push_back(
            TfStringPrintf("focusDistance is %g, though fStop asks for depth of field; everything "
                           "is in focus",
                           focusDistance));
        return;
    }
    const float radius = camera.GetFocalLength() / (2 * fStop);
    if (!(radius > 0) || !std::isfinite(radius)) {
        warnings->push_back(
            TfStringPrintf("there is no lens of focalLength %g and fStop %g; "
                           "everything is in focus",
                           camera.GetFocalLength(), fStop));
        return;
    }
    optics->lensRadius = radius;
    optics->focusDistance = focusDistance;
}

static float _ReadExposure(HdCamera const &camera, std::vector<std::string> *warnings) {
#if PXR_VERSION >= 2505
    const float scale = camera.GetLinearExposureScale();
#else
    const float scale = std::exp2(camera.GetExposure());
#endif
    if (scale >= 0 && std::isfinite(scale)) {
        return scale;
    }
    warnings->push_back(
        TfStringPrintf("exposure comes to a factor of %g; colours are left as they are", scale));
    return 1;
}

static HdCCShutter _ReadShutter(HdCamera const &camera, std::vector<std::string> *warnings) {
    const HdCCShutter shutter{float(camera.GetShutterOpen()), float(camera.GetShutterClose())};
    if (shutter.open <= shutter.close && std::isfinite(shutter.open) &&
        std::isfinite(shutter.close)) {
        return shutter;
    }
    warnings->push_back(
        TfStringPrintf("shutter:open is %g and shutter:close is %g; nothing is blurred by motion",
                       shutter.open, shutter.close));
    return {};
}

/// A plane whose numbers are so large or small that single precision loses them counts as none.
static bool _IsPlane(GfVec4d const &plane) {
    const GfVec4f p(plane);
    const bool isFinite =
        std::all_of(p.data(), p.data() + 4, [](float x) { return std::isfinite(x); });
    return isFinite && (p[0] != 0 || p[1] != 0 || p[2] != 0);
}

HdCCCameraOptics HdCCReadOptics(HdCamera const &camera, std::vector<GfVec4d> const &clipPlanes,
                                std::vector<std::string> *warnings) {
    HdCCCameraOptics optics;
    _ReadLens(camera, &optics, warnings);
    optics.exposure = _ReadExposure(camera, warnings);
    optics.shutter = _ReadShutter(camera, warnings);
    for (GfVec4d const &plane : clipPlanes) {
        if (_IsPlane(plane)) {
            optics.clipPlanes.push_back(plane);
        } else {
            warnings->push_back(
                TfStringPrintf("(%g, %g, %g, %g) is no clipping plane; it is "
                               "ignored",
                               plane[0], plane[1], plane[2], plane[3]));
        }
    }
    return optics;
}

PXR_NAMESPACE_CLOSE_SCOPE
