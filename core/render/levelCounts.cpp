#include "core/render/levelCounts.h"

#include <algorithm>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "core/trace/instanceLevels.h"

namespace cc {
namespace {

constexpr uint64_t kMostCounted = uint64_t(1) << 21;

using AtomicCounts = std::array<std::atomic<uint64_t>, kFinestLevel + 1>;

size_t PatchCount(const Instance& instance) {
    const bool hasPatches = instance.geometry->Kind() == GeometryKind::Surface;
    return hasPatches ? instance.geometry->PrimitiveCount() : 0;
}

/// Counts patches of an instance that are so far apart.
void CountInstance(const Instance& instance, const LevelMetric& metric, size_t first, size_t stride,
                   AtomicCounts* counts) {
    constexpr size_t kGrainSize = 4096;
    const size_t count = (PatchCount(instance) - first + stride - 1) / stride;
    const InstanceLevels levels(metric, instance);
    if (levels.IsUniform()) {
        (*counts)[levels.Uniform()] += count;
        return;
    }
    const tbb::blocked_range<size_t> all(0, count, kGrainSize);
    tbb::parallel_for(all, [&](const tbb::blocked_range<size_t>& part) {
        LevelCounts own{};
        for (size_t i = part.begin(); i < part.end(); ++i) {
            ++own[levels.Of(static_cast<uint32_t>(first + i * stride)).interior];
        }
        for (int level = 0; level <= kFinestLevel; ++level) {
            (*counts)[level] += own[level];
        }
    });
}

}  // namespace

LevelCounts CountLevels(const std::vector<Instance>& instances, const LevelMetric& metric,
                        const std::atomic<bool>* stop) {
    std::vector<uint64_t> firsts{0};
    for (const Instance& instance : instances) {
        firsts.push_back(firsts.back() + PatchCount(instance));
    }
    const uint64_t stride = firsts.back() / kMostCounted + 1;
    AtomicCounts counts{};
    tbb::parallel_for(size_t(0), instances.size(), [&](size_t i) {
        const uint64_t first = (stride - firsts[i] % stride) % stride;
        const bool isStopped = stop && stop->load(std::memory_order_relaxed);
        if (!isStopped && first < firsts[i + 1] - firsts[i]) {
            CountInstance(instances[i], metric, first, stride, &counts);
        }
    });
    LevelCounts result{};
    std::transform(counts.begin(), counts.end(), result.begin(),
                   [&](const std::atomic<uint64_t>& count) { return count * stride; });
    return result;
}

}  // namespace cc
