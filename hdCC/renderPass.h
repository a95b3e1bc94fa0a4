#ifndef HDCC_RENDER_PASS_H
#define HDCC_RENDER_PASS_H

#include <memory>
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

#include "hdCC/cameraOptics.h"
#include "hdCC/renderBuffer.h"

PXR_NAMESPACE_OPEN_SCOPE

class HdCCBackgroundFrame;
class HdCCRenderDelegate;
class HdCCRenderParam;
struct HdCCFrame;

/// Renders a frame if anything that it shows has changed: whole inside Execute if the application
/// says that it is not interactive, else in the background, and Execute shows what is there.
///
/// Whatever is wrong with camera, buffers or scene, the pass converges. Buffers are written inside
/// Execute only.
class HdCCRenderPass final : public HdRenderPass {
  public:
    HdCCRenderPass(HdRenderIndex *index, HdRprimCollection const &collection,
                   HdCCRenderDelegate *delegate);

    ~HdCCRenderPass() override;

    bool IsConverged() const override;

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
        HdCCCameraOptics optics;
        cc::Moving<cc::AffineTransform> cameraMotion;
        /// What the projection covers, in pixels of the buffers from the bottom up.
        GfRect2i window;
        std::vector<_Target> targets;

        bool operator==(_Picture const &b) const;
        bool operator!=(_Picture const &b) const { return !(*this == b); }
    };

    _Picture _Describe(HdRenderPassStateSharedPtr const &state,
                       TfTokenVector const &renderTags) const;
    void _AskForMotion(HdRenderPassState const &state);
    void _AskForPrimvars(HdRenderPassState const &state);
    GfRect2i _VisibleWindow() const;
    /// After the scene was built.
    std::vector<cc::Aov> _FilmAovs() const;
    bool _MakeCamera(GfRect2i const &visible, cc::Camera *camera) const;
    bool _IsFrameLost() const;
    void _Begin(bool isInteractive);
    void _Dump(cc::Camera const &camera) const;
    bool _Prepare(GfRect2i const &visible, HdCCFrame *frame, cc::Camera *camera);
    void _RenderWhole(GfRect2i const &visible, cc::Camera const &camera, HdCCFrame made);
    void _RenderInBackground(GfRect2i const &visible, cc::Camera const &camera, HdCCFrame made);
    void _BeginProgress(HdCCFrame const &frame, cc::Film const &film);
    void _ShowNewest();
    void _Publish(std::shared_ptr<const HdCCFrame> const &frame);
    void _GiveUp();
    void _SetConverged(bool isConverged);

    HdCCRenderDelegate *_delegate;
    HdCCRenderParam *_param;
    _Picture _picture;
    bool _hasBegun = false;
    bool _converged = false;
    /// While one renders in the background.
    std::shared_ptr<HdCCBackgroundFrame> _backgroundFrame;
    std::shared_ptr<const HdCCFrame> _shown;
};

PXR_NAMESPACE_CLOSE_SCOPE

#endif
