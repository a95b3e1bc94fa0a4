#ifndef HDCC_RENDER_SETTINGS_PRIM_H
#define HDCC_RENDER_SETTINGS_PRIM_H

#include "pxr/imaging/hd/bprim.h"
#include "pxr/pxr.h"

PXR_NAMESPACE_OPEN_SCOPE

class HdCCRenderDelegate;

/// A UsdRenderSettings prim: hands its hdcc: attributes to the delegate, which heeds those of the
/// active prim.
///
/// It is a plain HdBprim and not an HdRenderSettings, whose products and purposes the application
/// sees to.
class HdCCRenderSettingsPrim final : public HdBprim {
  public:
    HdCCRenderSettingsPrim(SdfPath const &id, HdCCRenderDelegate *delegate);

    void Sync(HdSceneDelegate *delegate, HdRenderParam *param, HdDirtyBits *dirtyBits) override;
    void Finalize(HdRenderParam *param) override;
    HdDirtyBits GetInitialDirtyBitsMask() const override;

  private:
    HdCCRenderDelegate *_delegate;
};

PXR_NAMESPACE_CLOSE_SCOPE

#endif
