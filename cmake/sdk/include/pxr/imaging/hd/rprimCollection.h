#ifndef PXR_IMAGING_HD_RPRIM_COLLECTION_H
#define PXR_IMAGING_HD_RPRIM_COLLECTION_H

#include "pxr/base/tf/token.h"
#include "pxr/imaging/hd/api.h"
#include "pxr/imaging/hd/repr.h"
#include "pxr/imaging/hd/version.h"
#include "pxr/pxr.h"
#include "pxr/usd/sdf/path.h"

#include <cstddef>

PXR_NAMESPACE_OPEN_SCOPE

/// Which prims a render pass draws: those below some paths and not below others.
class HdRprimCollection {
  public:
    HD_API HdRprimCollection();
    HD_API HdRprimCollection(TfToken const &name, HdReprSelector const &reprSelector,
                             bool forcedRepr = false, TfToken const &materialTag = TfToken());
    HD_API HdRprimCollection(HdRprimCollection const &col);
    HD_API virtual ~HdRprimCollection();

    TfToken const &GetName() const { return _name; }
    HdReprSelector const &GetReprSelector() const { return _reprSelector; }
    bool IsForcedRepr() const { return _forcedRepr; }

    HD_API SdfPathVector const &GetRootPaths() const;
    HD_API SdfPathVector const &GetExcludePaths() const;
    HD_API TfToken const &GetMaterialTag() const;

    HD_API size_t ComputeHash() const;
    HD_API bool operator==(HdRprimCollection const &other) const;
    HD_API bool operator!=(HdRprimCollection const &other) const;

  private:
    TfToken _name;
    HdReprSelector _reprSelector;
    bool _forcedRepr;
    TfToken _materialTag;
    SdfPathVector _rootPaths;
    SdfPathVector _excludePaths;
};

PXR_NAMESPACE_CLOSE_SCOPE

#endif
