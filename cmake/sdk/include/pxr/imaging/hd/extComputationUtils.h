#ifndef PXR_IMAGING_HD_EXT_COMPUTATION_UTILS_H
#define PXR_IMAGING_HD_EXT_COMPUTATION_UTILS_H

#include "pxr/base/tf/token.h"
#include "pxr/base/vt/value.h"
#include "pxr/imaging/hd/api.h"
#include "pxr/imaging/hd/extComputation.h"
#include "pxr/imaging/hd/sceneDelegate.h"
#include "pxr/pxr.h"

#include <unordered_map>

PXR_NAMESPACE_OPEN_SCOPE

/// Runs computations on the CPU.
class HdExtComputationUtils {
  public:
    using ValueStore = std::unordered_map<TfToken, VtValue, TfToken::HashFunctor>;

    /// Values of computed primvars, by the primvars' names. The computations that they come from
    /// must have been created by the delegate, as sprims.
    HD_API static ValueStore GetComputedPrimvarValues(
        HdExtComputationPrimvarDescriptorVector const &compPrimvars,
        HdSceneDelegate *sceneDelegate);
};

PXR_NAMESPACE_CLOSE_SCOPE

#endif
