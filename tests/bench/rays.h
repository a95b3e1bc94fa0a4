#pragma once

#include <time.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <string>
#include <thread>
#include <vector>

#include "core/math/vec.h"
#include "core/trace/rayPacket.h"

/// A ray as files keep it: 32 bytes.
struct Ray {
    cc::Vec3f origin;
    float tMin;
    cc::Vec3f direction;
    float tMax;
};

/// Rays that every tracer traces in the same order, in packets of up to 64.
struct RaySet {
    std::string name;
    /// Occlusion is asked for, not the nearest hit.
    bool anyHit = false;
    std::vector<uint8_t> packetSizes;
    std::vector<Ray> rays;

    void AddPacket(const std::vector<Ray>& packet);
};

/// Both throw std::runtime_error with one line that says what is wrong.
void WriteRays(const std::string& path, const std::vector<RaySet>& sets);
std::vector<RaySet> ReadRays(const std::string& path);

/// Some consecutive packets of a set: what a thread takes at a time.
struct RayChunk {
    const Ray* rays;
    int rayCount;
    const uint8_t* packetSizes;
    int packetCount;
};

constexpr int kPacketsInChunk = 16;
constexpr int kRaysInChunk = kPacketsInChunk * cc::kPacketSize;

std::vector<RayChunk> SplitIntoChunks(const RaySet& set);

/// What tracing all rays of a set once took.
struct TraceRun {
    /// Seconds of CPU time inside the tracer, added up over threads, divided by their number. What
    /// other programs take of the machine does not count.
    double seconds = 0;
    /// Seconds from the first ray to the last, with what it takes to lay the rays out.
    double wallSeconds = 0;
    uint64_t rays = 0, hits = 0;
};

inline double ThreadCpuSeconds() {
    timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Traces a set. Each thread makes a worker of its own and takes chunks off a common counter; only
/// the worker's Trace is timed.
/// @param makeWorker  returns a pointer to what has Load(const RayChunk&), Trace() and CountHits()
template <class MakeWorker>
TraceRun TraceInThreads(const RaySet& set, int threadCount, const MakeWorker& makeWorker) {
    const std::vector<RayChunk> chunks = SplitIntoChunks(set);
    std::atomic<size_t> next{0};
    std::vector<double> seconds(threadCount, 0.0);
    std::vector<uint64_t> hits(threadCount, 0);
    const auto work = [&](int thread) {
        const auto worker = makeWorker(thread);
        for (size_t i; (i = next++) < chunks.size();) {
            worker->Load(chunks[i]);
            const double begin = ThreadCpuSeconds();
            worker->Trace();
            seconds[thread] += ThreadCpuSeconds() - begin;
            hits[thread] += worker->CountHits();
        }
    };
    const auto begin = std::chrono::steady_clock::now();
    std::vector<std::thread> threads;
    for (int i = 0; i < threadCount; ++i) {
        threads.emplace_back(work, i);
    }
    TraceRun run;
    for (int i = 0; i < threadCount; ++i) {
        threads[i].join();
        run.seconds += seconds[i] / threadCount;
        run.hits += hits[i];
    }
    run.wallSeconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    run.rays = set.rays.size();
    return run;
}
