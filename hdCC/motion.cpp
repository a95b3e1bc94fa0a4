#include "hdCC/motion.h"

#include "pxr/imaging/hd/sceneDelegate.h"

#include "hdCC/convert.h"

PXR_NAMESPACE_OPEN_SCOPE

cc::Moving<cc::AffineTransform> HdCCSampleTransform(HdSceneDelegate *delegate, SdfPath const &id,
                                                    HdCCShutter const &shutter) {
    const auto matrices = HdCCSample<GfMatrix4d>(
        shutter,
        [&](size_t room, float *times, GfMatrix4d *values) {
            return delegate->SampleTransform(id, shutter.open, shutter.close, room, times, values);
        },
        [&] { return delegate->GetTransform(id); });
    return HdCCConvertPoses<cc::AffineTransform>(matrices, HdCCToTransform);
}

cc::Moving<GfMatrix4d> HdCCSampleInstancerTransform(HdSceneDelegate *delegate, SdfPath const &id,
                                                    HdCCShutter const &shutter) {
    return HdCCSample<GfMatrix4d>(
        shutter,
        [&](size_t room, float *times, GfMatrix4d *values) {
            return delegate->SampleInstancerTransform(id, shutter.open, shutter.close, room, times,
                                                      values);
        },
        [&] { return delegate->GetInstancerTransform(id); });
}

cc::Moving<VtValue> HdCCSamplePrimvar(HdSceneDelegate *delegate, SdfPath const &id,
                                      TfToken const &name, HdCCShutter const &shutter) {
    return HdCCSample<VtValue>(
        shutter,
        [&](size_t room, float *times, VtValue *values) {
            return delegate->SamplePrimvar(id, name, shutter.open, shutter.close, room, times,
                                           values);
        },
        [&] { return delegate->Get(id, name); });
}

PXR_NAMESPACE_CLOSE_SCOPE
