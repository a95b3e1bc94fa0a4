#ifndef PXR_IMAGING_HD_RENDERER_PLUGIN_H
#define PXR_IMAGING_HD_RENDERER_PLUGIN_H

#include "pxr/base/tf/token.h"
#include "pxr/imaging/hd/api.h"
#include "pxr/imaging/hd/renderDelegate.h"
#include "pxr/imaging/hd/version.h"
#include "pxr/imaging/hf/pluginBase.h"
#include "pxr/pxr.h"

#include <string>

PXR_NAMESPACE_OPEN_SCOPE

/// The way in: makes delegates for an application that has found the plugin by plugInfo.json.
class HdRendererPlugin : public HfPluginBase {
  public:
    HdRendererPlugin(HdRendererPlugin const &) = delete;
    HdRendererPlugin &operator=(HdRendererPlugin const &) = delete;

    HD_API TfToken GetPluginId() const;
    HD_API std::string GetDisplayName() const;

    virtual HdRenderDelegate *CreateRenderDelegate() = 0;
    HD_API virtual HdRenderDelegate *CreateRenderDelegate(HdRenderSettingsMap const &settingsMap);
    virtual void DeleteRenderDelegate(HdRenderDelegate *renderDelegate) = 0;

    /// From HD_API_VERSION 83 on this takes (HdRendererCreateArgs const &, std::string *).
    virtual bool IsSupported(bool gpuEnabled = true) const = 0;

  protected:
    HdRendererPlugin() = default;
    HD_API ~HdRendererPlugin() override;
};

PXR_NAMESPACE_CLOSE_SCOPE

#endif
