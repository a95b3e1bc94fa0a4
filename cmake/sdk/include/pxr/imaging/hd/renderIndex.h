#ifndef PXR_IMAGING_HD_RENDER_INDEX_H
#define PXR_IMAGING_HD_RENDER_INDEX_H

#include "pxr/base/tf/token.h"
#include "pxr/imaging/hd/api.h"
#include "pxr/imaging/hd/changeTracker.h"
#include "pxr/imaging/hd/resourceRegistry.h"
#include "pxr/imaging/hd/sceneIndex.h"
#include "pxr/imaging/hd/version.h"
#include "pxr/pxr.h"
#include "pxr/usd/sdf/path.h"

#include <string>
#include <vector>

PXR_NAMESPACE_OPEN_SCOPE

class HdBprim;
class HdDriver;
class HdInstancer;
class HdRenderDelegate;
class HdRprim;
class HdSprim;

using HdDriverVector = std::vector<HdDriver *>;

/// All prims that a delegate has been asked to make, by path.
///
/// An application makes it and puts prims into it; for delegates there are look-ups. Its members
/// are not declared.
class HdRenderIndex final {
  public:
    HdRenderIndex() = delete;
    HdRenderIndex(HdRenderIndex const &) = delete;
    HdRenderIndex &operator=(HdRenderIndex const &) = delete;

    HD_API static HdRenderIndex *New(HdRenderDelegate *renderDelegate,
                                     HdDriverVector const &drivers,
                                     std::string const &instanceName = std::string(),
                                     std::string const &appName = std::string());
    HD_API ~HdRenderIndex();

    HD_API HdRprim const *GetRprim(SdfPath const &id) const;
    HD_API HdSprim *GetSprim(TfToken const &typeId, SdfPath const &id) const;
    HD_API HdBprim *GetBprim(TfToken const &typeId, SdfPath const &id) const;
    HD_API HdInstancer *GetInstancer(SdfPath const &id) const;

    /// The prim whose id a pixel of the primId output holds.
    HD_API SdfPath GetRprimPathFromPrimId(int primId) const;
    HD_API SdfPathVector GetRprimSubtree(SdfPath const &root);
    HD_API TfToken GetRenderTag(SdfPath const &id) const;

    HD_API HdRenderDelegate *GetRenderDelegate() const;
    HD_API HdResourceRegistrySharedPtr GetResourceRegistry() const;
    HD_API std::string GetInstanceName() const;
    HD_API HdSceneIndexBaseRefPtr GetTerminalSceneIndex() const;
};

PXR_NAMESPACE_CLOSE_SCOPE

#endif
