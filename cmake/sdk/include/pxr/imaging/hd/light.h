#ifndef PXR_IMAGING_HD_LIGHT_H
#define PXR_IMAGING_HD_LIGHT_H

#include "pxr/imaging/hd/api.h"
#include "pxr/imaging/hd/sprim.h"
#include "pxr/imaging/hd/version.h"
#include "pxr/pxr.h"
#include "pxr/usd/sdf/path.h"

#include <string>

PXR_NAMESPACE_OPEN_SCOPE

/// A light of any kind. Its parameters are asked of the scene delegate by name.
class HdLight : public HdSprim {
  public:
    enum DirtyBits : HdDirtyBits {
        Clean = 0,
        DirtyTransform = 1 << 0,
        DirtyParams = 1 << 1,
        DirtyShadowParams = 1 << 2,
        DirtyCollection = 1 << 3,
        DirtyResource = 1 << 4,
        DirtyInstancer = 1 << 16,
        AllDirty = DirtyTransform | DirtyParams | DirtyShadowParams | DirtyCollection |
                   DirtyResource | DirtyInstancer
    };

    HD_API HdLight(SdfPath const &id);
    HD_API ~HdLight() override;

    SdfPath const &GetInstancerId() const { return _instancerId; }
    HD_API void _UpdateInstancer(HdSceneDelegate *sceneDelegate, HdDirtyBits *dirtyBits);
    HD_API static std::string StringifyDirtyBits(HdDirtyBits dirtyBits);

  private:
    SdfPath _instancerId;
};

PXR_NAMESPACE_CLOSE_SCOPE

#endif
