#include "hdCC/renderPass.h"

#include <algorithm>
#include <exception>
#include <memory>
#include <optional>

#include "pxr/base/tf/diagnostic.h"
#include "pxr/base/tf/staticTokens.h"
#include "pxr/imaging/hd/camera.h"
#include "pxr/imaging/hd/renderIndex.h"
#include "pxr/imaging/hd/sceneIndex.h"
#include "pxr/imaging/hd/utils.h"

#include "hdCC/backgroundFrame.h"
#include "hdCC/camera.h"
#include "hdCC/convert.h"
#include "hdCC/dump.h"
#include "hdCC/renderDelegate.h"
#include "hdCC/renderParam.h"
#include "hdCC/renderSettings.h"

PXR_NAMESPACE_OPEN_SCOPE

TF_DEFINE_PRIVATE_TOKENS(_tokens, (enableInteractive));

HdCCRenderPass::HdCCRenderPass(HdRenderIndex *index, HdRprimCollection const &collection,
                               HdCCRenderDelegate *delegate)
    : HdRenderPass(index, collection), _delegate(delegate), _param(delegate->GetSharedParam()) {}

HdCCRenderPass::~HdCCRenderPass() { _param->GetRenderThread().Abandon(this); }

bool HdCCRenderPass::IsConverged() const {
    // What was stopped may have been restarted since.
    return _converged && (!_backgroundFrame || _param->GetRenderThread().IsStopped());
}

bool HdCCRenderPass::_Target::operator==(_Target const &b) const {
    return aov == b.aov && buffer == b.buffer && bufferVersion == b.bufferVersion &&
           clearValue == b.clearValue;
}

bool HdCCRenderPass::_Picture::operator==(_Picture const &b) const {
    return sceneVersion == b.sceneVersion && settingsVersion == b.settingsVersion &&
           renderTags == b.renderTags && cameraId == b.cameraId && worldToView == b.worldToView &&
           projection == b.projection && clippingRange == b.clippingRange && optics == b.optics &&
           cameraMotion == b.cameraMotion && window == b.window && targets == b.targets;
}

void HdCCRenderPass::_Execute(HdRenderPassStateSharedPtr const &state,
                              TfTokenVector const &renderTags) {
    SdfPath settingsPrim;
    HdUtils::HasActiveRenderSettingsPrim(GetRenderIndex()->GetTerminalSceneIndex(), &settingsPrim);
    _delegate->HeedSceneSettings(settingsPrim);

    _AskForPrimvars(*state);
    _AskForMotion(*state);
    _Picture picture = _Describe(state, renderTags);
    const bool isInteractive = _delegate->GetRenderSetting(_tokens->enableInteractive, true);
    const bool isNew = !_hasBegun || picture != _picture || _IsFrameLost();
    _picture = std::move(picture);
    if (isNew) {
        _hasBegun = false;
        _backgroundFrame.reset();
        _shown.reset();
        _SetConverged(false);
        if (isInteractive && !_param->GetRenderThread().IsTurnOf(this)) {
            return;
        }
        _Begin(isInteractive);
        _hasBegun = true;
    }
    if (_backgroundFrame) {
        _ShowNewest();
    }
}

/// Another pass's frame, or an edit that shows nothing new, has ended this one before its time.
bool HdCCRenderPass::_IsFrameLost() const {
    return _backgroundFrame && !_param->GetRenderThread().HasJobOf(this) &&
           !_backgroundFrame->GetNewest()->isDone && _backgroundFrame->GetError().empty();
}

void HdCCRenderPass::_SetConverged(bool isConverged) {
    for (_Target const &target : _picture.targets) {
        target.buffer->SetConverged(isConverged);
    }
    _converged = isConverged;
}

/// The data window, which Hydra counts from the top, in rows from the bottom; else the viewport,
/// whose corner the buffers' corner is.
static GfRect2i _Window(HdRenderPassState const &state, int bufferHeight) {
    CameraUtilFraming const &framing = state.GetFraming();
    if (!framing.IsValid()) {
        GfVec4f const &viewport = state.GetViewport();
        return GfRect2i(GfVec2i(0), int(viewport[2]), int(viewport[3]));
    }
    GfRect2i const &data = framing.dataWindow;
    const int height = bufferHeight > 0 ? bufferHeight : data.GetHeight();
    return GfRect2i(GfVec2i(data.GetMinX(), height - data.GetMinY() - data.GetHeight()),
                    data.GetWidth(), data.GetHeight());
}

HdCCRenderPass::_Picture HdCCRenderPass::_Describe(HdRenderPassStateSharedPtr const &state,
                                                   TfTokenVector const &renderTags) const {
    _Picture picture;
    picture.sceneVersion = _param->GetSceneVersion();
    picture.settingsVersion = _delegate->GetRenderSettingsVersion();
    picture.renderTags = renderTags;
    for (HdRenderPassAovBinding const &binding : state->GetAovBindings()) {
        if (HdCCRenderBuffer *buffer = dynamic_cast<HdCCRenderBuffer *>(binding.renderBuffer)) {
            picture.targets.push_back(
                {binding.aovName, buffer, buffer->GetVersion(), binding.clearValue});
        }
    }
    picture.window =
        _Window(*state, picture.targets.empty() ? 0 : int(picture.targets[0].buffer->GetHeight()));
    if (HdCamera const *camera = state->GetCamera()) {
        picture.cameraId = camera->GetId();
        picture.worldToView = state->GetWorldToViewMatrix();
        picture.projection = state->GetProjectionMatrix();
        picture.clippingRange = camera->GetClippingRange();
        std::vector<std::string> warnings;
        picture.optics = HdCCReadOptics(*camera, state->GetClipPlanes(), &warnings);
        for (std::string const &warning : warnings) {
            _param->WarnOnce(picture.cameraId, warning);
        }
        if (auto const *own = dynamic_cast<HdCCCamera const *>(camera)) {
            picture.cameraMotion = own->SampleTransform(picture.optics.shutter);
        }
    }
    return picture;
}

/// What of the window lies inside the buffers.
GfRect2i HdCCRenderPass::_VisibleWindow() const {
    if (_picture.targets.empty()) {
        return _picture.window;
    }
    HdCCRenderBuffer const &buffer = *_picture.targets[0].buffer;
    return _picture.window.GetIntersection(
        GfRect2i(GfVec2i(0), int(buffer.GetWidth()), int(buffer.GetHeight())));
}

/// Has meshes sync how they move while the camera's shutter is open. Which that is is known only
/// now.
void HdCCRenderPass::_AskForMotion(HdRenderPassState const &state) {
    if (HdCamera const *camera = state.GetCamera()) {
        std::vector<std::string> warnings;
        _param->AskForMotion(HdCCReadOptics(*camera, {}, &warnings).shutter);
    }
}

/// Has meshes sync the primvars that AOVs show. Which these are is known only now.
void HdCCRenderPass::_AskForPrimvars(HdRenderPassState const &state) {
    std::vector<cc::Aov> aovs = HdCCRequestedAovs(*_delegate);
    for (HdRenderPassAovBinding const &binding : state.GetAovBindings()) {
        cc::Aov aov;
        if (cc::AovFromName(binding.aovName.GetString(), &aov)) {
            aovs.push_back(aov);
        }
    }
    for (cc::Aov const &aov : aovs) {
        if (aov.kind == cc::Aov::Primvar) {
            _param->AskForPrimvar(TfToken(aov.primvar));
        }
    }
}

/// The AOVs that are bound, and those that hdcc:aovs names.
std::vector<cc::Aov> HdCCRenderPass::_FilmAovs() const {
    std::vector<cc::Aov> aovs = HdCCRequestedAovs(*_delegate);
    const auto add = [&aovs](cc::Aov const &aov) {
        if (std::find(aovs.begin(), aovs.end(), aov) == aovs.end()) {
            aovs.push_back(aov);
        }
    };
    for (_Target const &target : _picture.targets) {
        cc::Aov aov;
        if (cc::AovFromName(target.aov.GetString(), &aov)) {
            add(aov);
            // Tells the pixels that show a clear value other than the film's own.
            if (aov.kind != cc::Aov::Color && !target.clearValue.IsEmpty()) {
                add(cc::Aov::PrimId);
            }
        }
    }
    for (cc::Aov &aov : aovs) {
        const int arity = _param->GetScene()->PrimvarArity(aov.primvar);
        aov.arity = arity > 0 ? arity : aov.arity;
    }
    return aovs;
}

bool HdCCRenderPass::_MakeCamera(GfRect2i const &visible, cc::Camera *camera) const {
    if (!HdCCToCamera(_picture.worldToView, _picture.projection, _picture.clippingRange.GetMin(),
                      _picture.clippingRange.GetMax(), camera)) {
        return false;
    }
    _picture.optics.Apply(camera);
    camera->motion = _picture.cameraMotion;
    GfRect2i const &window = _picture.window;
    const cc::Vec2f lower = camera->windowLower, upper = camera->windowUpper;
    const auto narrow = [](float low, float high, int from, int size, int at) {
        return low + (high - low) * (float(at - from) / float(size));
    };
    const int width = window.GetWidth(), height = window.GetHeight();
    const int left = visible.GetMinX(), bottom = visible.GetMinY();
    if (visible != window) {
        camera->isCrop = true;
        camera->wholeLower = lower;
        camera->wholeUpper = upper;
        camera->windowLower = {narrow(lower.x, upper.x, window.GetMinX(), width, left),
                               narrow(lower.y, upper.y, window.GetMinY(), height, bottom)};
        camera->windowUpper = {
            narrow(lower.x, upper.x, window.GetMinX(), width, left + visible.GetWidth()),
            narrow(lower.y, upper.y, window.GetMinY(), height, bottom + visible.GetHeight())};
    }
    return true;
}

/// Makes the scene and the camera ready. Returns false if there is nothing to render, having said
/// why.
bool HdCCRenderPass::_Prepare(GfRect2i const &visible, HdCCFrame *frame, cc::Camera *camera) {
    if (visible.IsEmpty()) {
        TF_WARN("there are no pixels to render: the picture or its data window is empty");
        return false;
    }
    if (!_MakeCamera(visible, camera)) {
        TF_WARN(
            "<%s>: there is no camera, or its transform, aperture or clipping range is "
            "singular; the picture is empty",
            _picture.cameraId.GetText());
        return false;
    }

    frame->syncSeconds = _param->TakeSyncSeconds();
    std::vector<std::string> tags;
    for (TfToken const &tag : _picture.renderTags) {
        tags.push_back(tag.GetString());
    }
    frame->options = HdCCRenderOptions(*_delegate);
    std::optional<int> tessellationLevel;
    if (frame->options.tracer == cc::TracerKind::Tessellated) {
        tessellationLevel = frame->options.level;
    }
    for (std::string const &warning : _param->GetScene()->Build(tags, tessellationLevel)) {
        TF_WARN("%s", warning.c_str());
    }
    frame->scene = _param->GetScene()->GetStatistics();
    _Dump(*camera);
    return true;
}

/// If a file is set for that.
void HdCCRenderPass::_Dump(cc::Camera const &camera) const {
    const std::string path = _delegate->GetRenderSetting(HdCCDumpSetting(), std::string());
    if (path.empty()) {
        return;
    }
    const std::string error = HdCCDumpFrame(path, *_delegate, *_param->GetScene(), camera);
    if (!error.empty()) {
        TF_RUNTIME_ERROR("%s", error.c_str());
    }
}

/// Begins a frame, once all that renders has let go of the scene.
void HdCCRenderPass::_Begin(bool isInteractive) {
    _param->GetRenderThread().Abandon();
    _param->SetFrame(nullptr);
    const GfRect2i visible = _VisibleWindow();
    HdCCFrame made;
    cc::Camera camera;
    try {
        if (!_Prepare(visible, &made, &camera)) {
            _GiveUp();
        } else if (isInteractive) {
            _RenderInBackground(visible, camera, std::move(made));
        } else {
            _RenderWhole(visible, camera, std::move(made));
        }
    } catch (std::exception const &e) {
        TF_RUNTIME_ERROR("the frame was given up: %s", e.what());
        _GiveUp();
    }
}

void HdCCRenderPass::_RenderWhole(GfRect2i const &visible, cc::Camera const &camera,
                                  HdCCFrame made) {
    const auto frame = std::make_shared<HdCCFrame>(std::move(made));
    frame->film = cc::Film(visible.GetWidth(), visible.GetHeight(), _FilmAovs());
    _BeginProgress(*frame, frame->film);
    cc::RenderFrame(_param->GetScene(), camera, frame->options, &frame->film, &frame->statistics,
                    &_param->samplesDone, nullptr);
    _param->samplesDone = _param->samplesTotal.load();
    frame->samples = frame->film.Has(cc::Aov::Color) ? frame->options.samples : 1;
    frame->isDone = true;
    _Publish(frame);
    _SetConverged(true);
}

void HdCCRenderPass::_RenderInBackground(GfRect2i const &visible, cc::Camera const &camera,
                                         HdCCFrame made) {
    const auto frame = std::make_shared<HdCCBackgroundFrame>(
        _param->GetScene(), camera, std::move(made), visible.GetWidth(), visible.GetHeight(),
        _FilmAovs(), &_param->samplesDone);
    const std::shared_ptr<const HdCCFrame> first = frame->GetNewest();
    _BeginProgress(*first, first->film);
    _param->GetRenderThread().Start(
        this, [frame](std::atomic<bool> const &stop) { return frame->RenderPass(stop); });
    _backgroundFrame = frame;
}

void HdCCRenderPass::_BeginProgress(HdCCFrame const &frame, cc::Film const &film) {
    const int64_t pixels = int64_t(film.Width()) * film.Height();
    _param->pixels = pixels;
    _param->samplesDone = 0;
    _param->samplesTotal = pixels * (film.Has(cc::Aov::Color) ? frame.options.samples : 1);
}

/// Shows the newest picture of a frame in the background, and whether it is the last.
void HdCCRenderPass::_ShowNewest() {
    const std::string error = _backgroundFrame->GetError();
    if (!error.empty()) {
        TF_RUNTIME_ERROR("the frame was given up: %s", error.c_str());
        _backgroundFrame.reset();
        _GiveUp();
        return;
    }
    // Asked first: once stopped, no newer picture comes.
    const bool isStopped = _param->GetRenderThread().IsStopped();
    const std::shared_ptr<const HdCCFrame> newest = _backgroundFrame->GetNewest();
    if (newest != _shown) {
        _Publish(newest);
        _shown = newest;
    }
    if (newest->isDone) {
        _backgroundFrame.reset();
    }
    _SetConverged(newest->isDone || isStopped);
}

void HdCCRenderPass::_Publish(std::shared_ptr<const HdCCFrame> const &frame) {
    const GfVec2i corner = _VisibleWindow().GetMin();
    for (_Target const &target : _picture.targets) {
        HdCCRenderBuffer &buffer = *target.buffer;
        cc::Aov aov;
        const bool isSupported = cc::AovFromName(target.aov.GetString(), &aov);
        const bool isCovered = corner == GfVec2i(0) &&
                               int(buffer.GetWidth()) == frame->film.Width() &&
                               int(buffer.GetHeight()) == frame->film.Height();
        if (!isSupported) {
            _param->WarnOnce(buffer.GetId(), "the AOV '" + target.aov.GetString() +
                                                 "' is not supported; it is left clear");
        }
        if (!isSupported || !isCovered) {
            buffer.Clear(target.clearValue);
        }
        if (isSupported) {
            buffer.Write(frame->film, aov, corner, target.clearValue);
        }
    }
    _param->SetFrame(frame);
}

/// Leaves the buffers clear, and converges.
void HdCCRenderPass::_GiveUp() {
    _param->samplesDone = _param->samplesTotal.load();
    for (_Target const &target : _picture.targets) {
        target.buffer->Clear(target.clearValue);
    }
    _SetConverged(true);
}

PXR_NAMESPACE_CLOSE_SCOPE
