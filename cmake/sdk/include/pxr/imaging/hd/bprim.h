#ifndef PXR_IMAGING_HD_BPRIM_H
#define PXR_IMAGING_HD_BPRIM_H

#include "pxr/imaging/hd/api.h"
#include "pxr/imaging/hd/types.h"
#include "pxr/imaging/hd/version.h"
#include "pxr/pxr.h"
#include "pxr/usd/sdf/path.h"

PXR_NAMESPACE_OPEN_SCOPE

class HdRenderParam;
class HdSceneDelegate;

/// A prim that is a buffer of data, such as an image that is rendered into.
class HdBprim {
  public:
    HD_API HdBprim(SdfPath const &id);
    HD_API virtual ~HdBprim();

    SdfPath const &GetId() const { return _id; }

    /// Brings the prim up to date with the scene, and clears the bits it has dealt with.
    virtual void Sync(HdSceneDelegate *sceneDelegate, HdRenderParam *renderParam,
                      HdDirtyBits *dirtyBits) = 0;

    /// Called before the prim is destroyed, to take it out of what refers to it.
    HD_API virtual void Finalize(HdRenderParam *renderParam);

    /// The bits that a new prim starts with.
    virtual HdDirtyBits GetInitialDirtyBitsMask() const = 0;

  private:
    SdfPath _id;
};

PXR_NAMESPACE_CLOSE_SCOPE

#endif
