#ifndef PXR_IMAGING_HD_RENDER_PASS_H
#define PXR_IMAGING_HD_RENDER_PASS_H

#include "pxr/base/tf/token.h"
#include "pxr/imaging/hd/api.h"
#include "pxr/imaging/hd/rprimCollection.h"
#include "pxr/imaging/hd/version.h"
#include "pxr/pxr.h"

#include <memory>

PXR_NAMESPACE_OPEN_SCOPE

class HdRenderIndex;

using HdRenderPassSharedPtr = std::shared_ptr<class HdRenderPass>;
using HdRenderPassStateSharedPtr = std::shared_ptr<class HdRenderPassState>;

/// Renders a collection. An application executes it again and again until it is converged.
class HdRenderPass {
  public:
    HD_API HdRenderPass(HdRenderIndex *index, HdRprimCollection const &collection);
    HdRenderPass(HdRenderPass const &) = delete;
    HdRenderPass &operator=(HdRenderPass const &) = delete;
    HD_API virtual ~HdRenderPass();

    HdRprimCollection const &GetRprimCollection() const { return _collection; }
    HdRenderIndex *GetRenderIndex() const { return _renderIndex; }

    HD_API virtual bool IsConverged() const;

  protected:
    /// Renders, or lets a rendering that goes on in other threads be seen.
    virtual void _Execute(HdRenderPassStateSharedPtr const &renderPassState,
                          TfTokenVector const &renderTags) = 0;

    /// Called when the collection has been replaced.
    HD_API virtual void _MarkCollectionDirty();
    HD_API virtual void _Sync();

  private:
    HdRenderIndex *const _renderIndex;
    HdRprimCollection _collection;
};

PXR_NAMESPACE_CLOSE_SCOPE

#endif
