#ifndef HDCC_COMPUTED_PRIMVAR_H
#define HDCC_COMPUTED_PRIMVAR_H

#include "core/scene/moving.h"

#include "pxr/base/vt/value.h"
#include "pxr/imaging/hd/sceneDelegate.h"
#include "pxr/pxr.h"

#include "hdCC/shutter.h"

PXR_NAMESPACE_OPEN_SCOPE

/// What a computation makes of inputs that move, as UsdSkel's skinning makes points of joints: it
/// runs once for each time at which any of its inputs is known. Empty values if it fails.
cc::Moving<VtValue> HdCCSampleComputedPrimvar(HdSceneDelegate *delegate,
                                              HdExtComputationPrimvarDescriptor const &primvar,
                                              HdCCShutter const &shutter);

PXR_NAMESPACE_CLOSE_SCOPE

#endif
