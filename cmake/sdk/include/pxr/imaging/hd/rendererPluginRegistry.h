#ifndef PXR_IMAGING_HD_RENDERER_PLUGIN_REGISTRY_H
#define PXR_IMAGING_HD_RENDERER_PLUGIN_REGISTRY_H

#include "pxr/imaging/hd/api.h"
#include "pxr/imaging/hd/renderDelegate.h"
#include "pxr/imaging/hf/pluginRegistry.h"
#include "pxr/pxr.h"

PXR_NAMESPACE_OPEN_SCOPE

class HdRendererPlugin;

/// Where renderer plugins make themselves known.
class HdRendererPluginRegistry final : public HfPluginRegistry {
  public:
    /// Called from a TF_REGISTRY_FUNCTION(TfType) in the plugin.
    template <typename T, typename... Bases>
    static void Define() {
        HfPluginRegistry::Define<T, HdRendererPlugin, Bases...>();
    }

  private:
    HdRendererPluginRegistry() = delete;
    ~HdRendererPluginRegistry() override;
    void _CollectAdditionalMetadata(PlugRegistry const &plugRegistry,
                                    TfType const &pluginType) override;
};

PXR_NAMESPACE_CLOSE_SCOPE

#endif
