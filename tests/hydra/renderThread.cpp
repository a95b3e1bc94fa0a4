// Checks HdCCRenderThread from the inside, for test_control.py.

#include "hdCC/renderThread.h"

#include <atomic>
#include <string>
#include <thread>
#include <vector>

PXR_NAMESPACE_USING_DIRECTIVE

namespace {

std::string failures;

void Expect(bool holds, char const* what) {
    if (!holds) {
        failures += std::string(what) + "; ";
    }
}

/// A job that never ends, and tells whether somebody works at it.
struct Endless {
    std::atomic<int> calls{0};
    std::atomic<bool> isWorking{false};

    HdCCRenderThread::Job Job() {
        return [this](std::atomic<bool> const& stop) {
            isWorking = true;
            ++calls;
            while (!stop) {
                std::this_thread::yield();
            }
            isWorking = false;
            return true;
        };
    }

    void Await() const {
        while (!isWorking) {
            std::this_thread::yield();
        }
    }
};

void CheckJobsEndWhenTheyAreDone() {
    HdCCRenderThread thread;
    std::atomic<int> calls{0};
    thread.Start(&calls, [&](std::atomic<bool> const&) { return ++calls < 5; });
    while (thread.HasJobOf(&calls)) {
        std::this_thread::yield();
    }
    Expect(calls == 5, "a job is called until it is done");
    Expect(thread.IsStopped(), "nothing is left to do after the last call");
}

void CheckAbandonedJobsAreLeftAlone() {
    HdCCRenderThread thread;
    for (int i = 0; i < 2000; ++i) {
        Endless job;
        thread.Start(&job, job.Job());
        if (i % 2 == 0) {
            job.Await();
        }
        thread.Abandon();
        Expect(!job.isWorking && !thread.HasJobOf(&job), "nobody works at an abandoned job");
    }
}

void CheckManyMayAbandonAtOnce() {
    HdCCRenderThread thread;
    for (int i = 0; i < 200; ++i) {
        Endless job;
        thread.Start(&job, job.Job());
        std::vector<std::thread> others;
        for (int other = 0; other < 4; ++other) {
            others.emplace_back([&] {
                thread.Abandon();
                Expect(!job.isWorking, "nobody works at a job that many abandon");
            });
        }
        for (std::thread& other : others) {
            other.join();
        }
    }
}

void CheckPausesHold() {
    HdCCRenderThread thread;
    Endless job;
    thread.Start(&job, job.Job());
    for (int i = 0; i < 500; ++i) {
        job.Await();
        thread.Pause();
        const int calls = job.calls;
        Expect(!job.isWorking && thread.IsPaused(), "a pause holds the job");
        Expect(!thread.IsStopped(), "what is paused is not stopped");
        std::this_thread::yield();
        Expect(job.calls == calls, "a paused job is not called");
        thread.Resume();
    }
}

void CheckStopsHoldUntilTheNextJob() {
    HdCCRenderThread thread;
    Endless first, second;
    thread.Start(&first, first.Job());
    first.Await();
    thread.Stop(true);
    Expect(!first.isWorking && thread.IsStopped(), "a stop holds the job");
    thread.Restart();
    first.Await();
    Expect(!thread.IsStopped(), "a job is restarted");
    thread.Stop(false);
    thread.Start(&second, second.Job());
    second.Await();
    Expect(!first.isWorking && !thread.IsStopped(), "a new job ends a stop");
}

void CheckTurns() {
    HdCCRenderThread thread;
    Endless job;
    int other = 0;
    Expect(thread.IsTurnOf(&other), "anybody may begin");
    thread.Start(&job, job.Job());
    for (int i = 0; i < 100; ++i) {
        Expect(!thread.IsTurnOf(&other), "who goes on asking keeps the turn");
        Expect(thread.HasJobOf(&job) && thread.IsTurnOf(&job), "the job is there");
    }
    int asked = 0;
    while (!thread.IsTurnOf(&other) && asked < 1000) {
        ++asked;
    }
    Expect(asked < 100, "who no longer asks loses the turn");
    thread.Abandon(&other);
    Expect(thread.HasJobOf(&job), "others' jobs are left where they are");
}

}  // namespace

/// Returns what went wrong, or null.
extern "C" char const* HdCCCheckRenderThread() {
    CheckJobsEndWhenTheyAreDone();
    CheckAbandonedJobsAreLeftAlone();
    CheckManyMayAbandonAtOnce();
    CheckPausesHold();
    CheckStopsHoldUntilTheNextJob();
    CheckTurns();
    return failures.empty() ? nullptr : failures.c_str();
}
