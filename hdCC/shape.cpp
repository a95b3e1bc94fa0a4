#include "hdCC/shape.h"

#include <utility>

#include "pxr/base/tf/diagnostic.h"
#include "pxr/base/tf/staticTokens.h"

#include "hdCC/computedPrimvar.h"
#include "hdCC/instancer.h"
#include "hdCC/motion.h"
#include "hdCC/primvars.h"

PXR_NAMESPACE_OPEN_SCOPE

TF_DEFINE_PRIVATE_TOKENS(_tokens, (points)(displayColor));

HdCCInstancer const *HdCCShapeSync::_Instancer(HdSceneDelegate *delegate) const {
    return static_cast<HdCCInstancer const *>(
        delegate->GetRenderIndex().GetInstancer(_instancerId));
}

void HdCCShapeSync::SyncInstances(HdSceneDelegate *delegate, SdfPath const &instancer) {
    _instancerId = instancer;
    HdCCInstancer const *const found = _Instancer(delegate);
    if (!found) {
        _shape->ClearInstances();
        _hasInstances = true;
        return;
    }
    cc::Moving<std::vector<cc::AffineTransform>> instances = found->ComputeInstances(_id);
    _hasInstances = !instances.Poses().front().empty();
    _shape->SetMovingInstances(std::move(instances));
}

void HdCCShapeSync::SyncTransform(HdSceneDelegate *delegate) {
    _shape->SetMovingTransform(HdCCSampleTransform(delegate, _id, _param->GetShutter()));
}

void HdCCShapeSync::SyncLateMotion() {
    if (_delegate) {
        _syncPoints(_delegate);
        SyncTransform(_delegate);
        SyncInstances(_delegate, _instancerId);
    }
}

void HdCCShapeSync::SyncPrimvars(HdSceneDelegate *delegate, TfTokenVector const &names,
                                 bool hasElements) {
    _delegate = delegate;
    _hasElements = hasElements;
    for (TfToken const &name : names) {
        _SyncPrimvar(name);
    }
}

void HdCCShapeSync::SyncLatePrimvar(TfToken const &name) {
    if (_delegate && name != _tokens->displayColor) {
        _SyncPrimvar(name);
    }
}

void HdCCShapeSync::_SyncPrimvar(TfToken const &name) {
    cc::Primvar primvar;
    std::string error;
    const bool isOwn =
        HdCCGetPrimvar(_delegate, _id, name,
                       {HdInterpolationConstant, HdInterpolationUniform, HdInterpolationVarying,
                        HdInterpolationVertex, HdInterpolationFaceVarying},
                       &primvar, &error);
    HdCCInstancer const *const instancer = _Instancer(_delegate);
    const bool isFound =
        isOwn || (instancer && instancer->FindPrimvar(_id, name, &primvar, &error));
    if (!error.empty()) {
        TF_WARN("<%s>: %s", _id.GetText(), error.c_str());
    } else if (isFound && primvar.IsEmpty() && _hasElements && _hasInstances) {
        TF_WARN("<%s>: primvars:%s has no values; it is ignored", _id.GetText(), name.GetText());
    }
    _shape->SetPrimvar(name.GetString(), std::move(primvar));
}

/// Points that a computation makes; an empty value if none makes them.
static cc::Moving<VtValue> _ComputedPoints(HdSceneDelegate *delegate, SdfPath const &id,
                                           HdCCShutter const &shutter) {
    const HdExtComputationPrimvarDescriptorVector primvars =
        delegate->GetExtComputationPrimvarDescriptors(id, HdInterpolationVertex);
    for (HdExtComputationPrimvarDescriptor const &primvar : primvars) {
        if (primvar.name == _tokens->points) {
            return HdCCSampleComputedPrimvar(delegate, primvar, shutter);
        }
    }
    return {};
}

bool HdCCSyncPoints(HdSceneDelegate *delegate, SdfPath const &id, char const *noun,
                    HdCCShutter const &shutter, cc::Moving<std::vector<cc::Vec3f>> *points) {
    const cc::Moving<VtValue> computed = _ComputedPoints(delegate, id, shutter);
    const cc::Moving<VtValue> values =
        computed.Poses().front().IsEmpty()
            ? HdCCSamplePrimvar(delegate, id, _tokens->points, shutter)
            : computed;
    bool arePoints = true;
    *points = HdCCConvertPoses<std::vector<cc::Vec3f>>(values, [&](VtValue const &value) {
        std::vector<cc::Vec3f> pose;
        if (!HdCCToVec3fs(value, &pose) && arePoints) {
            arePoints = false;
            TF_WARN("<%s>: points have the type %s, not point3f[]; the %s left out", id.GetText(),
                    value.GetTypeName().c_str(), noun);
        }
        return pose;
    });
    return arePoints;
}

cc::Primvar HdCCSyncValues(HdSceneDelegate *delegate, SdfPath const &id, TfToken const &name) {
    cc::Primvar values;
    std::string error;
    HdCCGetPrimvar(delegate, id, name,
                   {HdInterpolationConstant, HdInterpolationUniform, HdInterpolationVarying,
                    HdInterpolationVertex},
                   &values, &error);
    if (!error.empty()) {
        TF_WARN("<%s>: %s", id.GetText(), error.c_str());
    }
    return values;
}

PXR_NAMESPACE_CLOSE_SCOPE
