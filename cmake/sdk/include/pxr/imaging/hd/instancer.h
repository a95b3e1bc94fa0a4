#ifndef PXR_IMAGING_HD_INSTANCER_H
#define PXR_IMAGING_HD_INSTANCER_H

#include "pxr/base/tf/token.h"
#include "pxr/imaging/hd/api.h"
#include "pxr/imaging/hd/types.h"
#include "pxr/imaging/hd/version.h"
#include "pxr/pxr.h"
#include "pxr/usd/sdf/path.h"

#include <mutex>

PXR_NAMESPACE_OPEN_SCOPE

class HdRenderIndex;
class HdRenderParam;
class HdRprim;
class HdSceneDelegate;

/// Places copies of prototypes. An instancer whose parent is not empty is itself copied.
class HdInstancer {
  public:
    HD_API HdInstancer(HdSceneDelegate *delegate, SdfPath const &id);
    HD_API virtual ~HdInstancer();

    SdfPath const &GetId() const { return _id; }
    SdfPath const &GetParentId() const { return _parentId; }
    HdSceneDelegate *GetDelegate() const { return _delegate; }

    HD_API static int GetInstancerNumLevels(HdRenderIndex &index, HdRprim const &rprim);
    HD_API static TfTokenVector const &GetBuiltinPrimvarNames();

    HD_API virtual void Sync(HdSceneDelegate *sceneDelegate, HdRenderParam *renderParam,
                             HdDirtyBits *dirtyBits);
    HD_API virtual void Finalize(HdRenderParam *renderParam);
    HD_API virtual HdDirtyBits GetInitialDirtyBitsMask() const;

    /// Syncs an instancer and all above it, once, whichever prototype's thread comes first.
    HD_API static void _SyncInstancerAndParents(HdRenderIndex &renderIndex,
                                                SdfPath const &instancerId);

  protected:
    /// Fetches the parent's path.
    HD_API void _UpdateInstancer(HdSceneDelegate *delegate, HdDirtyBits *dirtyBits);

  private:
    HdSceneDelegate *_delegate;
    SdfPath _id;
    SdfPath _parentId;
    std::mutex _instanceLock;
};

PXR_NAMESPACE_CLOSE_SCOPE

#endif
