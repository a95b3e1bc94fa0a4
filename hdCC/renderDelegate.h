#ifndef HDCC_RENDER_DELEGATE_H
#define HDCC_RENDER_DELEGATE_H

#include <map>

#include "pxr/base/tf/token.h"
#include "pxr/base/vt/dictionary.h"
#include "pxr/imaging/hd/command.h"
#include "pxr/imaging/hd/renderDelegate.h"
#include "pxr/pxr.h"
#include "pxr/usd/sdf/path.h"

#include "hdCC/renderParam.h"

PXR_NAMESPACE_OPEN_SCOPE

/// Makes Hydra's prims and passes, keeps the settings, answers questions.
class HdCCRenderDelegate final : public HdRenderDelegate {
  public:
    explicit HdCCRenderDelegate(HdRenderSettingsMap const &settings);

    TfTokenVector const &GetSupportedRprimTypes() const override;
    TfTokenVector const &GetSupportedSprimTypes() const override;
    TfTokenVector const &GetSupportedBprimTypes() const override;
    HdRenderParam *GetRenderParam() const override { return &_param; }
    HdCCRenderParam *GetSharedParam() { return &_param; }
    HdResourceRegistrySharedPtr GetResourceRegistry() const override { return nullptr; }

    /// Refuses, by name, a setting that does not exist or a value that is not allowed; the old
    /// value stays.
    void SetRenderSetting(TfToken const &key, VtValue const &value) override;
    HdRenderSettingDescriptorList GetRenderSettingDescriptors() const override;
    TfTokenVector GetRenderSettingsNamespaces() const override;

    /// Remembers the settings that a UsdRenderSettings prim says; empty ones forget the prim.
    void SetSceneSettings(SdfPath const &prim, VtDictionary const &settings);
    /// Makes the settings of a prim those that hold where SetRenderSetting has said nothing.
    void HeedSceneSettings(SdfPath const &prim);

    /// @name Control of the frame that renders in the background
    /// All may be called at any time. Who waits for a picture to converge waits for Resume too, but
    /// not for Restart: what is stopped is converged.
    /// @{
    bool IsPauseSupported() const override { return true; }
    bool IsPaused() const override;
    /// Holds whatever renders in the background, until Resume; edits show a coarse picture.
    bool Pause() override;
    bool Resume() override;
    bool IsStopSupported() const override { return true; }
    /// True if nothing renders in the background.
    bool IsStopped() const override;
    /// Leaves the frame as it is, until Restart or an edit.
    bool Stop(bool blocking = true) override;
    /// Goes on with the frame where it was left.
    bool Restart() override;
    /// @}

    /// May be called from any thread, while a frame renders too.
    VtDictionary GetRenderStats() const override;
    HdCommandDescriptors GetCommandDescriptors() const override;
    bool InvokeCommand(TfToken const &command, HdCommandArgs const &args) override;
    HdAovDescriptor GetDefaultAovDescriptor(TfToken const &name) const override;

    HdRenderPassSharedPtr CreateRenderPass(HdRenderIndex *index,
                                           HdRprimCollection const &collection) override;
    HdInstancer *CreateInstancer(HdSceneDelegate *delegate, SdfPath const &id) override;
    void DestroyInstancer(HdInstancer *instancer) override;
    HdRprim *CreateRprim(TfToken const &type, SdfPath const &id) override;
    void DestroyRprim(HdRprim *prim) override;
    HdSprim *CreateSprim(TfToken const &type, SdfPath const &id) override;
    HdSprim *CreateFallbackSprim(TfToken const &type) override;
    void DestroySprim(HdSprim *prim) override;
    HdBprim *CreateBprim(TfToken const &type, SdfPath const &id) override;
    HdBprim *CreateFallbackBprim(TfToken const &type) override;
    void DestroyBprim(HdBprim *prim) override;
    void CommitResources(HdChangeTracker *) override {}

  private:
    mutable HdCCRenderParam _param;

    /// What SetRenderSetting and the constructor were given, which the scene cannot override.
    std::map<TfToken, VtValue> _givenSettings;
    std::map<SdfPath, VtDictionary> _sceneSettings;
    VtDictionary _heededSettings;
};

PXR_NAMESPACE_CLOSE_SCOPE

#endif
