#include "hdCC/backgroundFrame.h"

#include <exception>
#include <utility>

PXR_NAMESPACE_OPEN_SCOPE

HdCCBackgroundFrame::HdCCBackgroundFrame(cc::Scene *scene, cc::Camera const &camera, HdCCFrame made,
                                         int width, int height, std::vector<cc::Aov> aovs,
                                         std::atomic<int64_t> *progress)
    : _made(std::move(made)),
      _frame(scene, camera, _made.options, width, height, std::move(aovs)),
      _progress(progress) {
    _frame.RenderPass(nullptr, nullptr);
    _TakePicture();
}

bool HdCCBackgroundFrame::RenderPass(std::atomic<bool> const &stop) noexcept {
    try {
        if (!_frame.RenderPass(_progress, &stop)) {
            return true;
        }
        _TakePicture();
        return !_frame.IsDone();
    } catch (std::exception const &e) {
        const std::lock_guard<std::mutex> lock(_mutex);
        _error = e.what();
        return false;
    }
}

void HdCCBackgroundFrame::_TakePicture() {
    const auto newest = std::make_shared<HdCCFrame>(_made);
    newest->film = _frame.TakePicture();
    newest->statistics = _frame.Statistics();
    newest->samples = _frame.SamplesDone();
    newest->isDone = _frame.IsDone();
    const std::lock_guard<std::mutex> lock(_mutex);
    _newest = newest;
}

std::shared_ptr<const HdCCFrame> HdCCBackgroundFrame::GetNewest() const {
    const std::lock_guard<std::mutex> lock(_mutex);
    return _newest;
}

std::string HdCCBackgroundFrame::GetError() const {
    const std::lock_guard<std::mutex> lock(_mutex);
    return _error;
}

PXR_NAMESPACE_CLOSE_SCOPE
