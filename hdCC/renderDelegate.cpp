#include "hdCC/renderDelegate.h"

#include "pxr/base/gf/vec3f.h"
#include "pxr/base/gf/vec4f.h"
#include "pxr/base/tf/diagnostic.h"
#include "pxr/imaging/hd/aov.h"

#include "hdCC/basisCurves.h"
#include "hdCC/camera.h"
#include "hdCC/instancer.h"
#include "hdCC/light.h"
#include "hdCC/mesh.h"
#include "hdCC/passiveSprims.h"
#include "hdCC/pickCommand.h"
#include "hdCC/points.h"
#include "hdCC/renderBuffer.h"
#include "hdCC/renderPass.h"
#include "hdCC/renderSettings.h"
#include "hdCC/renderSettingsPrim.h"
#include "hdCC/renderStats.h"
#include "hdCC/writeCommand.h"

PXR_NAMESPACE_OPEN_SCOPE

HdCCRenderDelegate::HdCCRenderDelegate(HdRenderSettingsMap const &settings)
    : HdRenderDelegate(HdRenderSettingsMap()) {
    _PopulateDefaultSettings(GetRenderSettingDescriptors());
    for (auto const &setting : settings) {
        HdCCRenderDelegate::SetRenderSetting(setting.first, setting.second);
    }
}

static TfTokenVector _Tokens(std::initializer_list<char const *> names) {
    TfTokenVector tokens;
    for (char const *name : names) {
        tokens.emplace_back(name);
    }
    return tokens;
}

TfTokenVector const &HdCCRenderDelegate::GetSupportedRprimTypes() const {
    static const TfTokenVector types = _Tokens({"mesh", "basisCurves", "points"});
    return types;
}

TfTokenVector const &HdCCRenderDelegate::GetSupportedSprimTypes() const {
    // Without simpleLight: applications then give their camera light as a distantLight.
    static const TfTokenVector types =
        _Tokens({"camera", "material", "extComputation", "distantLight", "sphereLight", "domeLight",
                 "rectLight", "diskLight", "cylinderLight"});
    return types;
}

TfTokenVector const &HdCCRenderDelegate::GetSupportedBprimTypes() const {
    static const TfTokenVector types = _Tokens({"renderBuffer", "renderSettings"});
    return types;
}

// ---- Settings ----

HdRenderSettingDescriptorList HdCCRenderDelegate::GetRenderSettingDescriptors() const {
    return HdCCRenderSettingDescriptors();
}

TfTokenVector HdCCRenderDelegate::GetRenderSettingsNamespaces() const { return _Tokens({"hdcc"}); }

void HdCCRenderDelegate::SetRenderSetting(TfToken const &key, VtValue const &value) {
    if (!HdCCIsRenderSetting(key)) {
        HdRenderDelegate::SetRenderSetting(key, value);
        return;
    }
    VtValue checked;
    const std::string error = HdCCCheckRenderSetting(key, value, &checked);
    if (!error.empty()) {
        TF_RUNTIME_ERROR("%s", error.c_str());
        return;
    }
    _givenSettings[key] = checked;
    HdRenderDelegate::SetRenderSetting(key, checked);
}

void HdCCRenderDelegate::SetSceneSettings(SdfPath const &prim, VtDictionary const &settings) {
    _sceneSettings[prim] = settings;
}

void HdCCRenderDelegate::HeedSceneSettings(SdfPath const &prim) {
    const VtDictionary settings =
        _sceneSettings.count(prim) ? _sceneSettings[prim] : VtDictionary();
    if (settings == _heededSettings) {
        return;
    }
    _heededSettings = settings;

    std::map<TfToken, VtValue> values;
    for (HdRenderSettingDescriptor const &setting : GetRenderSettingDescriptors()) {
        values[setting.key] = setting.defaultValue;
    }
    for (auto const &[name, value] : settings) {
        const TfToken key(name);
        VtValue checked;
        const std::string error = HdCCCheckRenderSetting(key, value, &checked);
        if (!HdCCMayBeOfScene(key)) {
            TF_WARN("<%s>: a scene cannot set %s; it is ignored", prim.GetText(), name.c_str());
        } else if (!error.empty()) {
            TF_WARN("<%s>: %s", prim.GetText(), error.c_str());
        } else {
            values[key] = checked;
        }
    }
    for (auto const &[key, value] : values) {
        if (_givenSettings.count(key) == 0) {
            HdRenderDelegate::SetRenderSetting(key, value);
        }
    }
}

// ---- Control ----

bool HdCCRenderDelegate::IsPaused() const { return _param.GetRenderThread().IsPaused(); }

bool HdCCRenderDelegate::Pause() {
    _param.GetRenderThread().Pause();
    return true;
}

bool HdCCRenderDelegate::Resume() {
    _param.GetRenderThread().Resume();
    return true;
}

bool HdCCRenderDelegate::IsStopped() const { return _param.GetRenderThread().IsStopped(); }

bool HdCCRenderDelegate::Stop(bool blocking) {
    _param.GetRenderThread().Stop(blocking);
    return true;
}

bool HdCCRenderDelegate::Restart() {
    _param.GetRenderThread().Restart();
    return true;
}

// ---- Questions and commands ----

VtDictionary HdCCRenderDelegate::GetRenderStats() const {
    const int64_t done = _param.samplesDone, total = _param.samplesTotal, pixels = _param.pixels;
    const double fraction = total > 0 ? double(done) / double(total) : 0.0;

    const HdCCFrame none;
    const std::shared_ptr<const HdCCFrame> frame = _param.GetFrame();
    VtDictionary stats = HdCCRenderStats(frame ? *frame : none);
    stats["fractionDone"] = VtValue(fraction);
    stats["percentDone"] = VtValue(100 * fraction);
    stats["pixelsDone"] = VtValue(int64_t(fraction * double(pixels)));
    stats["pixelsTotal"] = VtValue(pixels);
    stats["pick"] = VtValue(_param.GetPicked());
    return stats;
}

HdCommandDescriptors HdCCRenderDelegate::GetCommandDescriptors() const {
    return {HdCCWriteCommandDescriptor(), HdCCPickCommandDescriptor()};
}

bool HdCCRenderDelegate::InvokeCommand(TfToken const &command, HdCommandArgs const &args) {
    std::string error;
    if (command == "write") {
        error = HdCCWriteFrame(_param.GetFrame().get(), args);
    } else if (command == "pick") {
        error = HdCCPick(&_param, args);
    } else {
        error = "there is no renderer command " + command.GetString();
    }
    if (!error.empty()) {
        TF_RUNTIME_ERROR("%s", error.c_str());
    }
    return error.empty();
}

HdAovDescriptor HdCCRenderDelegate::GetDefaultAovDescriptor(TfToken const &name) const {
    cc::Aov aov;
    if (!cc::AovFromName(name.GetString(), &aov)) {
        return HdAovDescriptor();
    }
    switch (aov.kind) {
        case cc::Aov::Color:
            return HdAovDescriptor(HdFormatFloat32Vec4, false, VtValue(GfVec4f(0)));
        case cc::Aov::Depth: return HdAovDescriptor(HdFormatFloat32, false, VtValue(1.0f));
        case cc::Aov::CameraDepth:
        case cc::Aov::Cost: return HdAovDescriptor(HdFormatFloat32, false, VtValue(0.0f));
        case cc::Aov::PrimId:
        case cc::Aov::InstanceId:
        case cc::Aov::ElementId:
        case cc::Aov::Material:
        case cc::Aov::Level:
        case cc::Aov::Fan: return HdAovDescriptor(HdFormatInt32, false, VtValue(-1));
        case cc::Aov::Normal:
        case cc::Aov::Neye:
        case cc::Aov::Primvar:
            return HdAovDescriptor(HdFormatFloat32Vec3, false, VtValue(GfVec3f(0)));
    }
    return HdAovDescriptor();
}

// ---- Prims and passes ----

HdRenderPassSharedPtr HdCCRenderDelegate::CreateRenderPass(HdRenderIndex *index,
                                                           HdRprimCollection const &collection) {
    // Not make_shared: the deleter must be this library's.
    return HdRenderPassSharedPtr(new HdCCRenderPass(index, collection, this));
}

HdInstancer *HdCCRenderDelegate::CreateInstancer(HdSceneDelegate *delegate, SdfPath const &id) {
    return new HdCCInstancer(delegate, id);
}

void HdCCRenderDelegate::DestroyInstancer(HdInstancer *instancer) { delete instancer; }

HdRprim *HdCCRenderDelegate::CreateRprim(TfToken const &type, SdfPath const &id) {
    const HdCCRenderParam::SyncScope scope(&_param);
    if (type == "mesh") {
        return new HdCCMesh(id, &_param);
    }
    if (type == "basisCurves") {
        return new HdCCBasisCurves(id, &_param);
    }
    return type == "points" ? new HdCCPoints(id, &_param) : nullptr;
}

void HdCCRenderDelegate::DestroyRprim(HdRprim *prim) { delete prim; }

HdSprim *HdCCRenderDelegate::CreateSprim(TfToken const &type, SdfPath const &id) {
    if (type == "camera") {
        return new HdCCCamera(id);
    }
    if (type == "material") {
        return new HdCCMaterial(id);
    }
    if (type == "extComputation") {
        return new HdCCExtComputation(id);
    }
    return new HdCCLight(type, id);
}

HdSprim *HdCCRenderDelegate::CreateFallbackSprim(TfToken const &type) {
    return CreateSprim(type, SdfPath());
}

void HdCCRenderDelegate::DestroySprim(HdSprim *prim) { delete prim; }

HdBprim *HdCCRenderDelegate::CreateBprim(TfToken const &type, SdfPath const &id) {
    if (type == "renderSettings") {
        return new HdCCRenderSettingsPrim(id, this);
    }
    return new HdCCRenderBuffer(id);
}

HdBprim *HdCCRenderDelegate::CreateFallbackBprim(TfToken const &type) {
    return CreateBprim(type, SdfPath());
}

void HdCCRenderDelegate::DestroyBprim(HdBprim *prim) { delete prim; }

PXR_NAMESPACE_CLOSE_SCOPE
