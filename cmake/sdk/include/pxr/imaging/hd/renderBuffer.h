#ifndef PXR_IMAGING_HD_RENDER_BUFFER_H
#define PXR_IMAGING_HD_RENDER_BUFFER_H

#include "pxr/base/gf/vec3i.h"
#include "pxr/base/vt/value.h"
#include "pxr/imaging/hd/api.h"
#include "pxr/imaging/hd/bprim.h"
#include "pxr/imaging/hd/types.h"
#include "pxr/pxr.h"

PXR_NAMESPACE_OPEN_SCOPE

/// An image that a render pass writes and the application reads. Its first row is the bottom one.
class HdRenderBuffer : public HdBprim {
  public:
    enum DirtyBits : HdDirtyBits {
        Clean = 0,
        DirtyDescription = 1 << 0,
        AllDirty = DirtyDescription
    };

    HD_API HdRenderBuffer(SdfPath const &id);
    HD_API ~HdRenderBuffer() override;

    HD_API HdDirtyBits GetInitialDirtyBitsMask() const override;

    /// Allocates when the description has changed.
    HD_API void Sync(HdSceneDelegate *sceneDelegate, HdRenderParam *renderParam,
                     HdDirtyBits *dirtyBits) override;
    HD_API void Finalize(HdRenderParam *renderParam) override;

    virtual bool Allocate(GfVec3i const &dimensions, HdFormat format, bool multiSampled) = 0;

    virtual unsigned int GetWidth() const = 0;
    virtual unsigned int GetHeight() const = 0;
    virtual unsigned int GetDepth() const = 0;
    virtual HdFormat GetFormat() const = 0;
    virtual bool IsMultiSampled() const = 0;

    /// The pixels, for as long as the buffer stays mapped.
    virtual void *Map() = 0;
    virtual void Unmap() = 0;
    virtual bool IsMapped() const = 0;

    /// Makes the mapped pixels show what has been rendered so far.
    virtual void Resolve() = 0;
    virtual bool IsConverged() const = 0;

    /// A handle for the application's graphics system; empty where there is none.
    HD_API virtual VtValue GetResource(bool multiSampled) const;

  protected:
    virtual void _Deallocate() = 0;
};

PXR_NAMESPACE_CLOSE_SCOPE

#endif
