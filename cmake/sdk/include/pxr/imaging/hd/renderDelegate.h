#ifndef PXR_IMAGING_HD_RENDER_DELEGATE_H
#define PXR_IMAGING_HD_RENDER_DELEGATE_H

#include "pxr/base/tf/hashmap.h"
#include "pxr/base/tf/refPtr.h"
#include "pxr/base/tf/token.h"
#include "pxr/base/vt/dictionary.h"
#include "pxr/base/vt/value.h"
#include "pxr/imaging/hd/aov.h"
#include "pxr/imaging/hd/api.h"
#include "pxr/imaging/hd/changeTracker.h"
#include "pxr/imaging/hd/command.h"
#include "pxr/imaging/hd/resourceRegistry.h"
#include "pxr/imaging/hd/version.h"
#include "pxr/pxr.h"
#include "pxr/usd/sdf/path.h"

#include <memory>
#include <string>
#include <vector>

PXR_NAMESPACE_OPEN_SCOPE

class HdBprim;
class HdContainerDataSource;
class HdDriver;
class HdInstancer;
class HdRenderIndex;
class HdRenderPass;
class HdRenderPassState;
class HdRprim;
class HdRprimCollection;
class HdSceneDelegate;
class HdSceneIndexBase;
class HdSprim;

using HdContainerDataSourceHandle = std::shared_ptr<HdContainerDataSource>;
using HdDriverVector = std::vector<HdDriver *>;
using HdRenderPassSharedPtr = std::shared_ptr<HdRenderPass>;
using HdRenderPassStateSharedPtr = std::shared_ptr<HdRenderPassState>;
using HdSceneIndexBaseRefPtr = TfRefPtr<HdSceneIndexBase>;

/// Whatever a delegate wants all its prims to be given at Sync, such as the scene they build.
class HdRenderParam {
  public:
    HdRenderParam() = default;
    HdRenderParam(HdRenderParam const &) = delete;
    HdRenderParam &operator=(HdRenderParam const &) = delete;
    HD_API virtual ~HdRenderParam();

    // A channel from applications to the delegate, newer than 24.11: an override of these must
    // depend on PXR_VERSION. May be called by any thread.
    HD_API virtual bool SetArbitraryValue(TfToken const &key, VtValue const &value);
    HD_API virtual VtValue GetArbitraryValue(TfToken const &key) const;
    HD_API virtual bool HasArbitraryValue(TfToken const &key) const;
    HD_API virtual bool IsValid() const;
};

using HdRenderSettingsMap = TfHashMap<TfToken, VtValue, TfToken::HashFunctor>;

/// A render setting as an application shows it: a name for people, its key, and its default.
struct HdRenderSettingDescriptor {
    std::string name;
    TfToken key;
    VtValue defaultValue;
};

using HdRenderSettingDescriptorList = std::vector<HdRenderSettingDescriptor>;

/// A renderer behind Hydra: makes the prims that it supports and the passes that draw them.
class HdRenderDelegate {
  public:
    HdRenderDelegate(HdRenderDelegate const &) = delete;
    HdRenderDelegate &operator=(HdRenderDelegate const &) = delete;
    HD_API virtual ~HdRenderDelegate();

    HD_API virtual void SetDrivers(HdDriverVector const &drivers);

    virtual TfTokenVector const &GetSupportedRprimTypes() const = 0;
    virtual TfTokenVector const &GetSupportedSprimTypes() const = 0;
    virtual TfTokenVector const &GetSupportedBprimTypes() const = 0;

    HD_API virtual HdRenderParam *GetRenderParam() const;

    /// May be null.
    virtual HdResourceRegistrySharedPtr GetResourceRegistry() const = 0;

    // Settings. The version grows with every change, so that a pass can tell.
    HD_API virtual void SetRenderSetting(TfToken const &key, VtValue const &value);
    HD_API virtual VtValue GetRenderSetting(TfToken const &key) const;
    template <typename T>
    T GetRenderSetting(TfToken const &key, T const &defValue) const {
        VtValue value = GetRenderSetting(key);
        return value.Cast<T>().GetWithDefault(defValue);
    }
    HD_API virtual HdRenderSettingDescriptorList GetRenderSettingDescriptors() const;
    HD_API virtual unsigned int GetRenderSettingsVersion() const;

    HD_API virtual VtDictionary GetRenderStats() const;
    HD_API virtual HdContainerDataSourceHandle GetCapabilities() const;

    // Control of a rendering that goes on in other threads.
    HD_API virtual bool IsPauseSupported() const;
    HD_API virtual bool IsPaused() const;
    HD_API virtual bool Pause();
    HD_API virtual bool Resume();
    HD_API virtual bool IsStopSupported() const;
    HD_API virtual bool IsStopped() const;
    HD_API virtual bool Stop(bool blocking = true);
    HD_API virtual bool Restart();

    virtual HdRenderPassSharedPtr CreateRenderPass(HdRenderIndex *index,
                                                   HdRprimCollection const &collection) = 0;
    HD_API virtual HdRenderPassStateSharedPtr CreateRenderPassState() const;

    // Prims are made and destroyed here and only here. A fallback prim stands in for one that a
    // scene names and does not have.
    virtual HdInstancer *CreateInstancer(HdSceneDelegate *delegate, SdfPath const &id) = 0;
    virtual void DestroyInstancer(HdInstancer *instancer) = 0;
    virtual HdRprim *CreateRprim(TfToken const &typeId, SdfPath const &rprimId) = 0;
    virtual void DestroyRprim(HdRprim *rprim) = 0;
    virtual HdSprim *CreateSprim(TfToken const &typeId, SdfPath const &sprimId) = 0;
    virtual HdSprim *CreateFallbackSprim(TfToken const &typeId) = 0;
    virtual void DestroySprim(HdSprim *sprim) = 0;
    virtual HdBprim *CreateBprim(TfToken const &typeId, SdfPath const &bprimId) = 0;
    virtual HdBprim *CreateFallbackBprim(TfToken const &typeId) = 0;
    virtual void DestroyBprim(HdBprim *bprim) = 0;

    /// Called by one thread, after all prims have been synced and before any pass executes.
    virtual void CommitResources(HdChangeTracker *tracker) = 0;

    // Which materials, settings and primvars the delegate wants to be given.
    HD_API virtual TfToken GetMaterialBindingPurpose() const;
    HD_API virtual TfToken GetMaterialNetworkSelector() const;
    HD_API virtual TfTokenVector GetMaterialRenderContexts() const;
    HD_API virtual TfTokenVector GetRenderSettingsNamespaces() const;
    HD_API virtual bool IsPrimvarFilteringNeeded() const;
    HD_API virtual TfTokenVector GetShaderSourceTypes() const;

    /// What an output would be. An invalid format says that there is none of that name.
    HD_API virtual HdAovDescriptor GetDefaultAovDescriptor(TfToken const &name) const;

    HD_API virtual HdCommandDescriptors GetCommandDescriptors() const;
    HD_API virtual bool InvokeCommand(TfToken const &command,
                                      HdCommandArgs const &args = HdCommandArgs());

    /// The name in plugInfo.json; set after construction.
    std::string const &GetRendererDisplayName() { return _displayName; }

    // For delegates that read the scene index themselves.
    HD_API virtual void SetTerminalSceneIndex(HdSceneIndexBaseRefPtr const &terminalSceneIndex);
    HD_API virtual void Update();

    /// Whether sprims or bprims of a type may be synced by several threads at once.
    HD_API virtual bool IsParallelSyncEnabled(TfToken const &primType) const;

  protected:
    HD_API HdRenderDelegate();
    HD_API HdRenderDelegate(HdRenderSettingsMap const &settingsMap);

    /// Sets what is not set yet to its default.
    HD_API void _PopulateDefaultSettings(HdRenderSettingDescriptorList const &defaultSettings);

    HdRenderSettingsMap _settingsMap;
    unsigned int _settingsVersion;

  private:
    std::string _displayName;
};

PXR_NAMESPACE_CLOSE_SCOPE

#endif
