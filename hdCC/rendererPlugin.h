#ifndef HDCC_RENDERER_PLUGIN_H
#define HDCC_RENDERER_PLUGIN_H

#include "pxr/imaging/hd/rendererPlugin.h"
#include "pxr/imaging/hd/version.h"
#include "pxr/pxr.h"

PXR_NAMESPACE_OPEN_SCOPE

/// What Hydra finds through plugInfo.json. It renders on the CPU: it is supported with a GPU and
/// without.
class HdCCRendererPlugin final : public HdRendererPlugin {
  public:
    HdCCRendererPlugin() = default;

    HdRenderDelegate *CreateRenderDelegate() override;
    HdRenderDelegate *CreateRenderDelegate(HdRenderSettingsMap const &settings) override;
    void DeleteRenderDelegate(HdRenderDelegate *delegate) override;

#if HD_API_VERSION >= 83
    bool IsSupported(HdRendererCreateArgs const &args, std::string *reasonWhyNot) const override;
#else
    bool IsSupported(bool gpuEnabled) const override;
#endif
};

PXR_NAMESPACE_CLOSE_SCOPE

#endif
