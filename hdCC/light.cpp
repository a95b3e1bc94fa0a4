#include "hdCC/light.h"

#include <cmath>

#include "core/scene/lightUnits.h"

#include "pxr/base/tf/diagnostic.h"
#include "pxr/imaging/hd/sceneDelegate.h"

#include "hdCC/convert.h"
#include "hdCC/renderParam.h"

PXR_NAMESPACE_OPEN_SCOPE

HdCCLight::HdCCLight(TfToken const &type, SdfPath const &id) : HdLight(id), _type(type) {}

HdDirtyBits HdCCLight::GetInitialDirtyBitsMask() const { return AllDirty; }

template <class T>
static T _Parameter(HdSceneDelegate *delegate, SdfPath const &id, char const *name, T fallback) {
    const VtValue value = delegate->GetLightParamValue(id, TfToken(name));
    if (value.IsEmpty()) {
        return fallback;
    }
    const VtValue cast = VtValue::Cast<T>(value);
    if (cast.IsEmpty()) {
        TF_WARN("<%s>: inputs:%s has the type %s; it is ignored", id.GetText(), name,
                value.GetTypeName().c_str());
        return fallback;
    }
    return cast.UncheckedGet<T>();
}

static cc::LightUnits _ReadUnits(HdSceneDelegate *delegate, SdfPath const &id) {
    cc::LightUnits units;
    units.intensity = _Parameter(delegate, id, "intensity", units.intensity);
    units.exposure = _Parameter(delegate, id, "exposure", units.exposure);
    units.diffuse = _Parameter(delegate, id, "diffuse", units.diffuse);
    units.color = HdCCToVec3f(_Parameter(delegate, id, "color", GfVec3f(1)));
    units.normalize = _Parameter(delegate, id, "normalize", units.normalize);
    units.enableColorTemperature =
        _Parameter(delegate, id, "enableColorTemperature", units.enableColorTemperature);
    units.colorTemperature = _Parameter(delegate, id, "colorTemperature", units.colorTemperature);
    units.angle = _Parameter(delegate, id, "angle", units.angle);
    units.radius = _Parameter(delegate, id, "radius", units.radius);
    units.treatAsPoint = _Parameter(delegate, id, "treatAsPoint", units.treatAsPoint);
    return units;
}

cc::Light HdCCLight::_MakeLight(HdSceneDelegate *delegate) const {
    const SdfPath &id = GetId();
    const cc::AffineTransform transform = HdCCToTransform(delegate->GetTransform(id));
    cc::LightUnits units = _ReadUnits(delegate, id);
    units.scale = float(std::cbrt(std::fabs(transform.Determinant())));

    cc::Light light;
    light.castsShadows = _Parameter(delegate, id, "shadow:enable", true);
    light.kind = _type == "sphereLight" ? cc::Light::Kind::Sphere : cc::Light::Kind::Distant;
    light.direction = cc::Normalize(transform.Direction({0, 0, -1}));
    light.position = transform.Point({0, 0, 0});
    light.power = light.kind == cc::Light::Kind::Sphere ? cc::SphereLightPower(units)
                                                        : cc::DistantLightPower(units);

    const bool isPlaced = light.kind == cc::Light::Kind::Sphere ? cc::IsFinite(light.position)
                                                                : cc::Length(light.direction) > 0;
    if (!isPlaced || !cc::IsUsableLightPower(light.power)) {
        TF_WARN(
            "<%s>: the light's parameters or transform make no finite, non-negative power; "
            "it is ignored",
            id.GetText());
        light.power = {0, 0, 0};
        light.position = {0, 0, 0};
        light.direction = {0, 0, -1};
    }
    if (!delegate->GetVisible(id)) {
        light.power = {0, 0, 0};
    }
    return light;
}

void HdCCLight::Sync(HdSceneDelegate *delegate, HdRenderParam *param, HdDirtyBits *dirtyBits) {
    HdCCRenderParam *const shared = static_cast<HdCCRenderParam *>(param);
    if (_type != "distantLight" && _type != "sphereLight") {
        shared->WarnOnce(GetId(), "lights of the type " + _type.GetString() +
                                      " are not supported yet; it is ignored");
    } else {
        const HdCCRenderParam::SyncScope scope(param);
        if (!_light) {
            _light = shared->GetScene()->AddLight();
        }
        *_light = _MakeLight(delegate);
    }
    *dirtyBits = Clean;
}

void HdCCLight::Finalize(HdRenderParam *param) {
    if (_light) {
        const HdCCRenderParam::SyncScope scope(param);
        static_cast<HdCCRenderParam *>(param)->GetScene()->RemoveLight(_light);
        _light = nullptr;
    }
    HdLight::Finalize(param);
}

PXR_NAMESPACE_CLOSE_SCOPE
