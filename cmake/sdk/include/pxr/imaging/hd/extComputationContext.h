#ifndef PXR_IMAGING_HD_EXT_COMPUTATION_CONTEXT_H
#define PXR_IMAGING_HD_EXT_COMPUTATION_CONTEXT_H

#include "pxr/base/tf/token.h"
#include "pxr/base/vt/value.h"
#include "pxr/imaging/hd/api.h"
#include "pxr/pxr.h"

PXR_NAMESPACE_OPEN_SCOPE

/// What a computation reads from and writes to while it runs (HdSceneDelegate's
/// InvokeExtComputation). Whoever runs it derives one.
class HdExtComputationContext {
  public:
    HD_API virtual ~HdExtComputationContext();

    /// An empty value if there is no such input, which is an error.
    virtual VtValue const &GetInputValue(TfToken const &name) const = 0;
    /// Null if there is no such input.
    virtual VtValue const *GetOptionalInputValuePtr(TfToken const &name) const = 0;
    virtual void SetOutputValue(TfToken const &name, VtValue const &output) = 0;
    /// Says that outputs are not to be used.
    virtual void RaiseComputationError() = 0;

  protected:
    HdExtComputationContext() = default;
};

PXR_NAMESPACE_CLOSE_SCOPE

#endif
