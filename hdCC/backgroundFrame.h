#ifndef HDCC_BACKGROUND_FRAME_H
#define HDCC_BACKGROUND_FRAME_H

#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "core/render/progressiveFrame.h"

#include "pxr/pxr.h"

#include "hdCC/renderParam.h"

PXR_NAMESPACE_OPEN_SCOPE

/// A frame that one thread renders while another shows the newest picture of it.
class HdCCBackgroundFrame {
  public:
    /// Renders the first, coarse picture.
    /// @param scene    built; nothing else may touch it while RenderPass is called
    /// @param made     what is known of the frame before it renders
    /// @param progress samples done, counted up
    HdCCBackgroundFrame(cc::Scene *scene, cc::Camera const &camera, HdCCFrame made, int width,
                        int height, std::vector<cc::Aov> aovs, std::atomic<int64_t> *progress);

    /// Renders until the next one is there, or `stop` turns true. Returns true if more is to
    /// come, and never throws.
    bool RenderPass(std::atomic<bool> const &stop) noexcept;

    /// The picture of the last pass that is finished.
    std::shared_ptr<const HdCCFrame> GetNewest() const;
    /// Why the frame was given up; empty if it was not.
    std::string GetError() const;

  private:
    void _TakePicture();

    mutable std::mutex _mutex;
    std::shared_ptr<const HdCCFrame> _newest;
    std::string _error;

    HdCCFrame _made;
    cc::ProgressiveFrame _frame;
    std::atomic<int64_t> *_progress;
};

PXR_NAMESPACE_CLOSE_SCOPE

#endif
