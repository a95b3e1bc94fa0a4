#ifndef HDCC_INSTANCER_H
#define HDCC_INSTANCER_H

#include "pxr/imaging/hd/instancer.h"
#include "pxr/pxr.h"

PXR_NAMESPACE_OPEN_SCOPE

/// Keeps track of its parent, so that Hydra is content. Prototypes are left out by the meshes.
class HdCCInstancer final : public HdInstancer {
  public:
    HdCCInstancer(HdSceneDelegate *delegate, SdfPath const &id);

    void Sync(HdSceneDelegate *delegate, HdRenderParam *param, HdDirtyBits *dirtyBits) override;
};

PXR_NAMESPACE_CLOSE_SCOPE

#endif
