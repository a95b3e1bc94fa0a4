#include "hdCC/rendererPlugin.h"

#include <mutex>
#include <string>

#include "pxr/base/tf/diagnostic.h"
#include "pxr/base/tf/getenv.h"
#include "pxr/base/tf/registryManager.h"
#include "pxr/base/tf/type.h"
#include "pxr/imaging/hd/rendererPluginRegistry.h"

#include "core/trace/simdTargets.h"
#include "hdCC/renderDelegate.h"

PXR_NAMESPACE_OPEN_SCOPE

TF_REGISTRY_FUNCTION(TfType) { HdRendererPluginRegistry::Define<HdCCRendererPlugin>(); }

/// Heeds HDCC_SIMD_TARGET. Once: kernels of another delegate may be running later.
static void _ChooseSimdTarget() {
    static std::once_flag once;
    std::call_once(once, [] {
        const std::string error = cc::UseSimdTarget(TfGetenv("HDCC_SIMD_TARGET"));
        if (!error.empty()) {
            TF_WARN("HDCC_SIMD_TARGET: %s; the best one is used", error.c_str());
        }
    });
}

HdRenderDelegate *HdCCRendererPlugin::CreateRenderDelegate() {
    return CreateRenderDelegate(HdRenderSettingsMap());
}

HdRenderDelegate *HdCCRendererPlugin::CreateRenderDelegate(HdRenderSettingsMap const &settings) {
    _ChooseSimdTarget();
    return new HdCCRenderDelegate(settings);
}

void HdCCRendererPlugin::DeleteRenderDelegate(HdRenderDelegate *delegate) { delete delegate; }

#if HD_API_VERSION >= 83
bool HdCCRendererPlugin::IsSupported(HdRendererCreateArgs const &, std::string *) const {
    return true;
}
#else
bool HdCCRendererPlugin::IsSupported(bool) const { return true; }
#endif

PXR_NAMESPACE_CLOSE_SCOPE
