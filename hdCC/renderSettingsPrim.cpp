#include "hdCC/renderSettingsPrim.h"

#include "pxr/base/tf/staticTokens.h"
#include "pxr/base/vt/dictionary.h"
#include "pxr/imaging/hd/sceneDelegate.h"

#include "hdCC/renderDelegate.h"

PXR_NAMESPACE_OPEN_SCOPE

TF_DEFINE_PRIVATE_TOKENS(_tokens, (namespacedSettings));

HdCCRenderSettingsPrim::HdCCRenderSettingsPrim(SdfPath const &id, HdCCRenderDelegate *delegate)
    : HdBprim(id), _delegate(delegate) {}

HdDirtyBits HdCCRenderSettingsPrim::GetInitialDirtyBitsMask() const { return ~HdDirtyBits(0); }

void HdCCRenderSettingsPrim::Sync(HdSceneDelegate *delegate, HdRenderParam *,
                                  HdDirtyBits *dirtyBits) {
    const VtValue settings = delegate->Get(GetId(), _tokens->namespacedSettings);
    _delegate->SetSceneSettings(GetId(), settings.GetWithDefault(VtDictionary()));
    *dirtyBits = 0;
}

void HdCCRenderSettingsPrim::Finalize(HdRenderParam *param) {
    _delegate->SetSceneSettings(GetId(), VtDictionary());
    HdBprim::Finalize(param);
}

PXR_NAMESPACE_CLOSE_SCOPE
