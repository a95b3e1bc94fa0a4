#ifndef PXR_IMAGING_HD_RESOURCE_REGISTRY_H
#define PXR_IMAGING_HD_RESOURCE_REGISTRY_H

#include "pxr/base/tf/token.h"
#include "pxr/base/vt/dictionary.h"
#include "pxr/imaging/hd/api.h"
#include "pxr/imaging/hd/version.h"
#include "pxr/pxr.h"

#include <memory>
#include <string>

PXR_NAMESPACE_OPEN_SCOPE

using HdResourceRegistrySharedPtr = std::shared_ptr<class HdResourceRegistry>;

/// Storage that delegates of a graphics card share.
///
/// Not to be made here: its size is unknown. A CPU delegate returns a null one, on every OpenUSD.
class HdResourceRegistry {
  public:
    HdResourceRegistry() = delete;
    HdResourceRegistry(HdResourceRegistry const &) = delete;
    HdResourceRegistry &operator=(HdResourceRegistry const &) = delete;
    HD_API virtual ~HdResourceRegistry();

    HD_API virtual void InvalidateShaderRegistry();
    HD_API virtual void ReloadResource(TfToken const &resourceType, std::string const &path);
    HD_API virtual VtDictionary GetResourceAllocation() const;

  protected:
    HD_API virtual void _Commit();
    HD_API virtual void _GarbageCollect();
};

PXR_NAMESPACE_CLOSE_SCOPE

#endif
