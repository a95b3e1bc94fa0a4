#include "hdCC/rendererPlugin.h"

#include "pxr/base/tf/registryManager.h"
#include "pxr/base/tf/type.h"
#include "pxr/imaging/hd/rendererPluginRegistry.h"

#include "hdCC/renderDelegate.h"

PXR_NAMESPACE_OPEN_SCOPE

TF_REGISTRY_FUNCTION(TfType) { HdRendererPluginRegistry::Define<HdCCRendererPlugin>(); }

HdRenderDelegate *HdCCRendererPlugin::CreateRenderDelegate() {
    return new HdCCRenderDelegate(HdRenderSettingsMap());
}

HdRenderDelegate *HdCCRendererPlugin::CreateRenderDelegate(HdRenderSettingsMap const &settings) {
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
