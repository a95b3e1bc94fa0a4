#ifndef PXR_IMAGING_HF_PLUGIN_BASE_H
#define PXR_IMAGING_HF_PLUGIN_BASE_H

#include "pxr/imaging/hf/api.h"
#include "pxr/pxr.h"

PXR_NAMESPACE_OPEN_SCOPE

/// The base of plugins that a registry makes by name.
class HfPluginBase {
  public:
    HfPluginBase(HfPluginBase const &) = delete;
    HfPluginBase &operator=(HfPluginBase const &) = delete;
    HF_API virtual ~HfPluginBase();

  protected:
    HfPluginBase() = default;
};

PXR_NAMESPACE_CLOSE_SCOPE

#endif
