#ifndef PXR_IMAGING_HD_RPRIM_H
#define PXR_IMAGING_HD_RPRIM_H

#include "pxr/base/gf/bbox3d.h"
#include "pxr/base/gf/range3d.h"
#include "pxr/base/tf/token.h"
#include "pxr/base/vt/array.h"
#include "pxr/base/vt/types.h"
#include "pxr/base/vt/value.h"
#include "pxr/imaging/hd/api.h"
#include "pxr/imaging/hd/changeTracker.h"
#include "pxr/imaging/hd/repr.h"
#include "pxr/imaging/hd/sceneDelegate.h"
#include "pxr/imaging/hd/types.h"
#include "pxr/imaging/hd/version.h"
#include "pxr/pxr.h"
#include "pxr/usd/sdf/path.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

PXR_NAMESPACE_OPEN_SCOPE

class HdBufferArrayRange;
class HdRenderParam;

/// What the library keeps of a prim for its own drawing; visibility and path are read from here.
struct HdRprimSharedData {
    std::vector<std::shared_ptr<HdBufferArrayRange>> barContainer;
    GfBBox3d bounds;
    int instancerLevels;
    bool visible;
    SdfPath rprimID;
    std::vector<std::pair<VtIntArray, TfTokenVector>> fvarTopologyToPrimvarVector;
};

/// A prim that is geometry.
class HdRprim {
  public:
    HD_API HdRprim(SdfPath const &id);
    HD_API virtual ~HdRprim();

    virtual HdDirtyBits GetInitialDirtyBitsMask() const = 0;

    /// Brings the prim up to date with the scene. Called by several threads, for different prims.
    virtual void Sync(HdSceneDelegate *delegate, HdRenderParam *renderParam, HdDirtyBits *dirtyBits,
                      TfToken const &reprToken) = 0;

    /// Called before the prim is destroyed, to take it out of what refers to it.
    HD_API virtual void Finalize(HdRenderParam *renderParam);

    SdfPath const &GetId() const { return _sharedData.rprimID; }
    int32_t GetPrimId() const { return _primId; }
    HD_API void SetPrimId(int32_t primId);
    SdfPath const &GetInstancerId() const { return _instancerId; }
    SdfPath const &GetMaterialId() const { return _materialId; }
    HD_API void SetMaterialId(SdfPath const &materialId);
    HdReprSelector const &GetReprSelector() const { return _authoredReprSelector; }
    TfToken const &GetRenderTag() const { return _renderTag; }
    bool IsVisible() const { return _sharedData.visible; }

    /// Primvars that a kind of geometry always has, such as points.
    HD_API virtual TfTokenVector const &GetBuiltinPrimvarNames() const = 0;

    // The scene delegate's answers for this prim.
    GfRange3d GetExtent(HdSceneDelegate *d) const { return d->GetExtent(GetId()); }
    VtValue GetPrimvar(HdSceneDelegate *d, TfToken const &name) const {
        return d->Get(GetId(), name);
    }
    VtValue GetIndexedPrimvar(HdSceneDelegate *d, TfToken const &name, VtIntArray *indices) const {
        return d->GetIndexedPrimvar(GetId(), name, indices);
    }
    HdPrimvarDescriptorVector GetPrimvarDescriptors(HdSceneDelegate *d, HdInterpolation i) const {
        return d->GetPrimvarDescriptors(GetId(), i);
    }

    HD_API void UpdateReprSelector(HdSceneDelegate *delegate, HdDirtyBits *dirtyBits);
    HD_API virtual void UpdateRenderTag(HdSceneDelegate *delegate, HdRenderParam *renderParam);

  protected:
    using _ReprVector = std::vector<std::pair<TfToken, HdReprSharedPtr>>;

    /// Adds the bits that follow from those given: new topology means new points.
    virtual HdDirtyBits _PropagateDirtyBits(HdDirtyBits bits) const = 0;

    /// Called when a way of drawing is first asked for; it must then be among `_reprs`.
    virtual void _InitRepr(TfToken const &reprToken, HdDirtyBits *dirtyBits) = 0;

    HD_API HdReprSharedPtr const &_GetRepr(TfToken const &reprToken) const;
    HD_API void _UpdateVisibility(HdSceneDelegate *sceneDelegate, HdDirtyBits *dirtyBits);
    HD_API void _UpdateInstancer(HdSceneDelegate *sceneDelegate, HdDirtyBits *dirtyBits);

  private:
    SdfPath _instancerId;
    SdfPath _materialId;
    int32_t _primId;

  protected:
    HdRprimSharedData _sharedData;
    HdReprSelector _authoredReprSelector;
    TfToken _renderTag;
    _ReprVector _reprs;
};

PXR_NAMESPACE_CLOSE_SCOPE

#endif
