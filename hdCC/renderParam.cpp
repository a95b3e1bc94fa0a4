#include "hdCC/renderParam.h"

#include <algorithm>

#include "pxr/base/tf/diagnostic.h"

#include "hdCC/shape.h"

PXR_NAMESPACE_OPEN_SCOPE

using _Clock = std::chrono::steady_clock;

HdCCRenderParam::SyncScope::SyncScope(HdRenderParam *param)
    : _param(static_cast<HdCCRenderParam *>(param)), _begin(_Clock::now()) {
    _param->_renderThread.Abandon();
}

HdCCRenderParam::SyncScope::~SyncScope() {
    const _Clock::time_point end = _Clock::now();
    const std::lock_guard<std::mutex> lock(_param->_mutex);
    _param->_syncBegin = _param->_synced ? std::min(_param->_syncBegin, _begin) : _begin;
    _param->_syncEnd = _param->_synced ? std::max(_param->_syncEnd, end) : end;
    _param->_synced = true;
    ++_param->_sceneVersion;
}

double HdCCRenderParam::TakeSyncSeconds() {
    const std::lock_guard<std::mutex> lock(_mutex);
    if (!_synced) {
        return 0;
    }
    _synced = false;
    return std::chrono::duration<double>(_syncEnd - _syncBegin).count();
}

void HdCCRenderParam::WarnOnce(SdfPath const &id, std::string const &message) {
    const std::string line = "<" + id.GetString() + ">: " + message;
    {
        const std::lock_guard<std::mutex> lock(_mutex);
        if (!_warned.insert(line).second) {
            return;
        }
    }
    TF_WARN("%s", line.c_str());
}

void HdCCRenderParam::AddShape(HdCCShapeSync *shape) {
    const std::lock_guard<std::mutex> lock(_mutex);
    _shapes.insert(shape);
}

void HdCCRenderParam::RemoveShape(HdCCShapeSync *shape) {
    const std::lock_guard<std::mutex> lock(_mutex);
    _shapes.erase(shape);
}

SdfPath HdCCRenderParam::FindPrim(int primId) const {
    const std::lock_guard<std::mutex> lock(_mutex);
    const auto found = std::find_if(_shapes.begin(), _shapes.end(), [&](HdCCShapeSync *shape) {
        return shape->GetShape()->PrimId() == primId;
    });
    return primId < 0 || found == _shapes.end() ? SdfPath() : (*found)->GetId();
}

void HdCCRenderParam::AskForPrimvar(TfToken const &name) {
    std::set<HdCCShapeSync *> shapes;
    {
        const std::lock_guard<std::mutex> lock(_mutex);
        if (std::find(_primvars.begin(), _primvars.end(), name) != _primvars.end()) {
            return;
        }
        _primvars.push_back(name);
        shapes = _shapes;
    }
    const SyncScope scope(this);
    for (HdCCShapeSync *shape : shapes) {
        shape->SyncLatePrimvar(name);
    }
}

TfTokenVector HdCCRenderParam::GetPrimvarsAskedFor() const {
    const std::lock_guard<std::mutex> lock(_mutex);
    return _primvars;
}

void HdCCRenderParam::AskForMotion(HdCCShutter const &shutter) {
    std::set<HdCCShapeSync *> shapes;
    {
        const std::lock_guard<std::mutex> lock(_mutex);
        if (shutter == _shutter) {
            return;
        }
        _shutter = shutter;
        shapes = _shapes;
    }
    const SyncScope scope(this);
    for (HdCCShapeSync *shape : shapes) {
        shape->SyncLateMotion();
    }
}

HdCCShutter HdCCRenderParam::GetShutter() const {
    const std::lock_guard<std::mutex> lock(_mutex);
    return _shutter;
}

std::shared_ptr<const HdCCFrame> HdCCRenderParam::GetFrame() const {
    const std::lock_guard<std::mutex> lock(_mutex);
    return _frame;
}

VtDictionary HdCCRenderParam::GetPicked() const {
    const std::lock_guard<std::mutex> lock(_mutex);
    return _picked;
}

void HdCCRenderParam::SetPicked(VtDictionary const &picked) {
    const std::lock_guard<std::mutex> lock(_mutex);
    _picked = picked;
}

void HdCCRenderParam::SetFrame(std::shared_ptr<const HdCCFrame> frame) {
    const std::lock_guard<std::mutex> lock(_mutex);
    _frame = std::move(frame);
}

PXR_NAMESPACE_CLOSE_SCOPE
