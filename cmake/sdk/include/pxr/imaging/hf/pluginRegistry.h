#ifndef PXR_IMAGING_HF_PLUGIN_REGISTRY_H
#define PXR_IMAGING_HF_PLUGIN_REGISTRY_H

#include "pxr/base/tf/type.h"
#include "pxr/imaging/hf/api.h"
#include "pxr/imaging/hf/pluginBase.h"
#include "pxr/pxr.h"

#include <functional>

PXR_NAMESPACE_OPEN_SCOPE

class PlugRegistry;

/// A registry of plugins of one kind. Only the way to register is declared.
class HfPluginRegistry {
  public:
    HfPluginRegistry() = delete;
    HfPluginRegistry(HfPluginRegistry const &) = delete;
    HfPluginRegistry &operator=(HfPluginRegistry const &) = delete;

  protected:
    HF_API virtual ~HfPluginRegistry();
    HF_API virtual void _CollectAdditionalMetadata(PlugRegistry const &plugRegistry,
                                                   TfType const &pluginType);

    /// Tells the type system of T, and how to make one.
    template <typename T, typename PluginBaseType, typename... Bases>
    static void Define() {
        TfType type = TfType::Define<T, TfType::Bases<PluginBaseType, Bases...>>();
        _FactoryFn make = []() -> HfPluginBase * { return new T; };
        _SetFactory(type, make);
    }

  private:
    using _FactoryFn = std::function<HfPluginBase *()>;
    HF_API static void _SetFactory(TfType &type, _FactoryFn &func);
};

PXR_NAMESPACE_CLOSE_SCOPE

#endif
