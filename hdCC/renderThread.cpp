#include "hdCC/renderThread.h"

#include <utility>

PXR_NAMESPACE_OPEN_SCOPE

/// Times that others ask before a client that no longer does loses its turn.
static constexpr int _kPatience = 16;

HdCCRenderThread::~HdCCRenderThread() {
    Abandon();
    {
        const std::lock_guard<std::mutex> lock(_mutex);
        _isOver = true;
    }
    _changed.notify_all();
    if (_thread.joinable()) {
        _thread.join();
    }
}

void HdCCRenderThread::Start(void const *client, Job job) {
    Abandon();
    {
        const std::lock_guard<std::mutex> lock(_mutex);
        if (!_thread.joinable()) {
            _thread = std::thread([this] { _Run(); });
        }
        _job = std::move(job);
        _client = client;
        _refusals = 0;
        _isStopped = false;
        _hasJob = true;
    }
    _changed.notify_all();
}

void HdCCRenderThread::Abandon() {
    if (!_hasJob) {
        return;
    }
    std::unique_lock<std::mutex> lock(_mutex);
    _Interrupt(&lock);
    _job = nullptr;
    _client = nullptr;
    _hasJob = false;
}

void HdCCRenderThread::Abandon(void const *client) {
    if (HasJobOf(client)) {
        Abandon();
    }
}

bool HdCCRenderThread::HasJobOf(void const *client) {
    const std::lock_guard<std::mutex> lock(_mutex);
    if (!_job || _client != client) {
        return false;
    }
    _refusals = 0;
    return true;
}

bool HdCCRenderThread::IsTurnOf(void const *client) {
    const std::lock_guard<std::mutex> lock(_mutex);
    return !_job || _client == client || ++_refusals > _kPatience;
}

void HdCCRenderThread::Pause() {
    std::unique_lock<std::mutex> lock(_mutex);
    _isPaused = true;
    _Interrupt(&lock);
}

void HdCCRenderThread::Resume() {
    {
        const std::lock_guard<std::mutex> lock(_mutex);
        _isPaused = false;
    }
    _changed.notify_all();
}

bool HdCCRenderThread::IsPaused() const {
    const std::lock_guard<std::mutex> lock(_mutex);
    return _isPaused;
}

void HdCCRenderThread::Stop(bool isBlocking) {
    std::unique_lock<std::mutex> lock(_mutex);
    _isStopped = true;
    _stop = true;
    if (isBlocking) {
        _Interrupt(&lock);
    }
}

void HdCCRenderThread::Restart() {
    {
        const std::lock_guard<std::mutex> lock(_mutex);
        _isStopped = false;
    }
    _changed.notify_all();
}

bool HdCCRenderThread::IsStopped() const {
    const std::lock_guard<std::mutex> lock(_mutex);
    return _isStopped || !_job;
}

/// Waits until nobody works; then nobody begins to while the lock is held.
void HdCCRenderThread::_Interrupt(std::unique_lock<std::mutex> *lock) {
    ++_interrupters;
    _stop = true;
    _changed.wait(*lock, [this] { return !_isWorking; });
    --_interrupters;
    _changed.notify_all();
}

void HdCCRenderThread::_Run() {
    std::unique_lock<std::mutex> lock(_mutex);
    const auto canWork = [this] { return _job && !_isPaused && !_isStopped && _interrupters == 0; };
    while (true) {
        _changed.wait(lock, [&] { return _isOver || canWork(); });
        if (_isOver) {
            return;
        }
        _stop = false;
        _isWorking = true;
        lock.unlock();
        const bool isMoreLeft = _job(_stop);
        lock.lock();
        _isWorking = false;
        if (!isMoreLeft) {
            _job = nullptr;
            _client = nullptr;
            _hasJob = false;
        }
        _changed.notify_all();
    }
}

PXR_NAMESPACE_CLOSE_SCOPE
