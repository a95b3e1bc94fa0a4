#ifndef HDCC_MOTION_H
#define HDCC_MOTION_H

#include "core/math/transform.h"
#include "core/scene/moving.h"

#include "pxr/base/gf/matrix4d.h"
#include "pxr/base/tf/token.h"
#include "pxr/base/vt/value.h"
#include "pxr/pxr.h"
#include "pxr/usd/sdf/path.h"

#include "hdCC/shutter.h"

PXR_NAMESPACE_OPEN_SCOPE

class HdSceneDelegate;

/// @name What a scene delegate has while a shutter is open
/// Where it is closed, what there is at the frame's own time, at rest.
/// @{

cc::Moving<cc::AffineTransform> HdCCSampleTransform(HdSceneDelegate *delegate, SdfPath const &id,
                                                    HdCCShutter const &shutter);
cc::Moving<GfMatrix4d> HdCCSampleInstancerTransform(HdSceneDelegate *delegate, SdfPath const &id,
                                                    HdCCShutter const &shutter);
/// Empty values if there is no such primvar.
cc::Moving<VtValue> HdCCSamplePrimvar(HdSceneDelegate *delegate, SdfPath const &id,
                                      TfToken const &name, HdCCShutter const &shutter);

/// @}

PXR_NAMESPACE_CLOSE_SCOPE

#endif
