#ifndef HDCC_RENDER_PASS_H
#define HDCC_RENDER_PASS_H

#include <vector>

#include "core/scene/camera.h"

#include "pxr/base/gf/matrix4d.h"
#include "pxr/base/gf/range1f.h"
#include "pxr/base/gf/rect2i.h"
#include "pxr/base/tf/token.h"
#include "pxr/base/vt/value.h"
#include "pxr/imaging/hd/renderPass.h"
#include "pxr/imaging/hd/renderPassState.h"
#include "pxr/pxr.h"

#include "hdCC/renderBuffer.h"

PXR_NAMESPACE_OPEN_SCOPE

class HdCCRenderDelegate;
class HdCCRenderParam;
struct HdCCFrame;

/// Renders a frame whole inside Execute, if anything that it shows has changed.
///
/// Whatever is wrong with camera, buffers or scene, the pass is converged when Execute returns.
class HdCCRenderPass final : public HdRenderPass {
  public:
    HdCCRenderPass(HdRenderIndex *index, HdRprimCollection const &collection,
                   HdCCRenderDelegate *delegate);

    bool IsConverged() const override { return _converged; }

  protected:
    void _Execute(HdRenderPassStateSharedPtr const &state,
                  TfTokenVector const &renderTags) override;

  private:
    /// An AOV and the buffer that wants it.
    struct _Target {
        TfToken aov;
        HdCCRenderBuffer *buffer;
        int bufferVersion;
        VtValue clearValue;

        bool operator==(_Target const &b) const;
    };

    /// All that decides what the pixels are.
    struct _Picture {
        int sceneVersion = 0;
        unsigned int settingsVersion = 0;
        TfTokenVector renderTags;
        SdfPath cameraId;
        GfMatrix4d worldToView{1}, projection{1};
        GfRange1f clippingRange;
        /// What the projection covers, in pixels of the buffers from the bottom up.
        GfRect2i window;
        std::vector<_Target> targets;

        bool operator==(_Picture const &b) const;
    };

    _Picture _Describe(HdRenderPassStateSharedPtr const &state,
                       TfTokenVector const &renderTags) const;
    void _AskForPrimvars(HdRenderPassState const &state);
    GfRect2i _VisibleWindow() const;
    /// After the scene was built.
    std::vector<cc::Aov> _FilmAovs() const;
    bool _MakeCamera(GfRect2i const &visible, cc::Camera *camera) const;
    bool _Render();
    void _Publish(HdCCFrame const &frame, GfVec2i const &corner);
    void _ClearAll();

    HdCCRenderDelegate *_delegate;
    HdCCRenderParam *_param;
    _Picture _picture;
    bool _converged = false;
};

PXR_NAMESPACE_CLOSE_SCOPE

#endif
