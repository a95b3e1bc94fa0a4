#include "hdCC/camera.h"

#include "hdCC/convert.h"
#include "hdCC/motion.h"

PXR_NAMESPACE_OPEN_SCOPE

void HdCCCamera::Sync(HdSceneDelegate *delegate, HdRenderParam *param, HdDirtyBits *dirtyBits) {
    _delegate = delegate;
    HdCamera::Sync(delegate, param, dirtyBits);
}

cc::Moving<cc::AffineTransform> HdCCCamera::SampleTransform(HdCCShutter const &shutter) const {
    if (!_delegate || !shutter.IsOpen()) {
        return cc::Moving<cc::AffineTransform>(HdCCToTransform(GetTransform()));
    }
    return HdCCSampleTransform(_delegate, GetId(), shutter);
}

PXR_NAMESPACE_CLOSE_SCOPE
