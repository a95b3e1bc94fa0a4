#ifndef HDCC_PASSIVE_SPRIMS_H
#define HDCC_PASSIVE_SPRIMS_H

#include "pxr/imaging/hd/extComputation.h"
#include "pxr/imaging/hd/material.h"
#include "pxr/pxr.h"

PXR_NAMESPACE_OPEN_SCOPE

// Prims that need nothing beyond Hydra's own class. They are derived all the same: what this
// library makes with new, it must delete itself.

/// A computation, such as UsdSkel's skinning, that meshes ask for their points.
class HdCCExtComputation final : public HdExtComputation {
  public:
    explicit HdCCExtComputation(SdfPath const &id) : HdExtComputation(id) {}
};

/// A material. Surfaces are shaded with their displayColor for now.
class HdCCMaterial final : public HdMaterial {
  public:
    explicit HdCCMaterial(SdfPath const &id) : HdMaterial(id) {}

    void Sync(HdSceneDelegate *, HdRenderParam *, HdDirtyBits *dirtyBits) override {
        *dirtyBits = Clean;
    }
    HdDirtyBits GetInitialDirtyBitsMask() const override { return AllDirty; }
};

PXR_NAMESPACE_CLOSE_SCOPE

#endif
