#ifndef PXR_IMAGING_HD_EXT_COMPUTATION_H
#define PXR_IMAGING_HD_EXT_COMPUTATION_H

#include "pxr/imaging/hd/api.h"
#include "pxr/imaging/hd/sceneDelegate.h"
#include "pxr/imaging/hd/sprim.h"
#include "pxr/pxr.h"

#include <cstddef>
#include <string>

PXR_NAMESPACE_OPEN_SCOPE

/// A computation that makes primvars of other values, as skinning does of rest points and joints.
///
/// The library's class is complete: a delegate makes it and lets it sync itself.
class HdExtComputation : public HdSprim {
  public:
    enum DirtyBits : HdDirtyBits {
        Clean = 0,
        DirtyInputDesc = 1 << 0,
        DirtyOutputDesc = 1 << 1,
        DirtyElementCount = 1 << 2,
        DirtySceneInput = 1 << 3,
        DirtyCompInput = 1 << 4,
        DirtyKernel = 1 << 5,
        DirtyDispatchCount = 1 << 6,
        AllDirty = DirtyInputDesc | DirtyOutputDesc | DirtyElementCount | DirtySceneInput |
                   DirtyCompInput | DirtyKernel | DirtyDispatchCount
    };

    HdExtComputation() = delete;
    HdExtComputation(HdExtComputation const &) = delete;
    HdExtComputation &operator=(HdExtComputation const &) = delete;
    HD_API HdExtComputation(SdfPath const &id);
    HD_API ~HdExtComputation() override;

    HD_API void Sync(HdSceneDelegate *sceneDelegate, HdRenderParam *renderParam,
                     HdDirtyBits *dirtyBits) override;
    HD_API HdDirtyBits GetInitialDirtyBitsMask() const override;

  private:
    size_t _dispatchCount;
    size_t _elementCount;
    TfTokenVector _sceneInputNames;
    HdExtComputationInputDescriptorVector _computationInputs;
    HdExtComputationOutputDescriptorVector _computationOutputs;
    std::string _gpuKernelSource;
};

PXR_NAMESPACE_CLOSE_SCOPE

#endif
