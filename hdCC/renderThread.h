#ifndef HDCC_RENDER_THREAD_H
#define HDCC_RENDER_THREAD_H

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

#include "pxr/pxr.h"

PXR_NAMESPACE_OPEN_SCOPE

/// Works at one job at a time in a thread of its own, which begins with the first job. All may be
/// called from any thread but the jobs' own.
class HdCCRenderThread {
  public:
    /// Does a piece of the work and returns true if more is left. It must return soon after `stop`
    /// turns true, and may then be called again. It must not throw, nor call OpenUSD, which may
    /// want Python's lock, while who holds that waits for the job.
    using Job = std::function<bool(std::atomic<bool> const &stop)>;

    HdCCRenderThread() = default;
    ~HdCCRenderThread();

    /// Puts a job in place of the one before. Throws std::system_error if the system gives no
    /// thread.
    /// @param client  whose job it is
    void Start(void const *client, Job job);
    /// Takes the job away, and returns when nobody works at it. Costs nothing if there is none.
    void Abandon();
    /// The same, if the job is the client's.
    void Abandon(void const *client);
    /// True if the client has a job that is not finished. It comes before others' jobs as long as
    /// the client goes on asking.
    bool HasJobOf(void const *client);
    /// True if the client may put its job in place of the one there.
    bool IsTurnOf(void const *client);

    /// Leaves the job where it is, until Resume. A job that is started meanwhile waits.
    void Pause();
    void Resume();
    bool IsPaused() const;

    /// Leaves the job where it is, until Restart or until another is started.
    /// @param isBlocking  return only when nobody works at it
    void Stop(bool isBlocking);
    void Restart();
    /// True if nothing will be done any more, unless Start or Restart is called.
    bool IsStopped() const;

  private:
    void _Run();
    void _Interrupt(std::unique_lock<std::mutex> *lock);

    mutable std::mutex _mutex;
    std::condition_variable _changed;
    std::thread _thread;
    Job _job;
    void const *_client = nullptr;
    int _refusals = 0;
    int _interrupters = 0;
    bool _isWorking = false, _isPaused = false, _isStopped = false, _isOver = false;
    /// Whether there is a job, for those who ask often.
    std::atomic<bool> _hasJob{false};
    std::atomic<bool> _stop{false};
};

PXR_NAMESPACE_CLOSE_SCOPE

#endif
