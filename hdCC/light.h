#ifndef HDCC_LIGHT_H
#define HDCC_LIGHT_H

#include "core/scene/scene.h"

#include "pxr/imaging/hd/light.h"
#include "pxr/pxr.h"

PXR_NAMESPACE_OPEN_SCOPE

/// A UsdLux light. Distant and sphere lights shine; any other is warned about once and ignored.
class HdCCLight final : public HdLight {
  public:
    /// @param type  the sprim type: distantLight, sphereLight, domeLight, ...
    HdCCLight(TfToken const &type, SdfPath const &id);

    void Sync(HdSceneDelegate *delegate, HdRenderParam *param, HdDirtyBits *dirtyBits) override;
    void Finalize(HdRenderParam *param) override;
    HdDirtyBits GetInitialDirtyBitsMask() const override;

  private:
    cc::Light _MakeLight(HdSceneDelegate *delegate) const;

    TfToken _type;
    cc::Light *_light = nullptr;
};

PXR_NAMESPACE_CLOSE_SCOPE

#endif
