#include "core/render/renderer.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <vector>

#include <tbb/blocked_range.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "core/render/cameraRays.h"
#include "core/render/levelView.h"
#include "core/render/tileOrder.h"
#include "core/render/tileRenderer.h"
#include "core/trace/instanceLevels.h"

namespace cc {
namespace {

/// Hands tiles to as many workers as there are threads, in order, until all are done or the frame
/// is stopped. Returns the number of tiles rendered.
size_t RenderTiles(const TileRenderer& renderer, const std::vector<Tile>& tiles, int threads,
                   std::vector<RenderStatistics>* statisticsOfWorkers,
                   std::atomic<int64_t>* progress, const std::atomic<bool>* stop) {
    std::atomic<size_t> next{0}, done{0};
    tbb::task_arena arena(threads);
    arena.execute([&] {
        tbb::parallel_for(
            0, threads,
            [&](int worker) {
                // Kept apart, as neighbours in memory would slow each other down.
                RenderWorker own;
                while (!(stop && stop->load(std::memory_order_relaxed))) {
                    const size_t i = next.fetch_add(1, std::memory_order_relaxed);
                    if (i >= tiles.size()) {
                        break;
                    }
                    renderer.Render(tiles[i], &own);
                    own.statistics.threads = 1;
                    done.fetch_add(1, std::memory_order_relaxed);
                    if (progress) {
                        progress->fetch_add(int64_t(tiles[i].width) * tiles[i].height);
                    }
                }
                (*statisticsOfWorkers)[worker] = own.statistics;
            },
            tbb::simple_partitioner());
    });
    return done;
}

using LevelCounts = std::array<uint64_t, kFinestLevel + 1>;

/// So many patches have their levels counted; of more than that, these stand for the others.
constexpr uint64_t kMostCountedPatches = uint64_t(1) << 21;

/// Counts those of an instance's patches by level that are so far apart.
void CountLevelsOf(const Instance& instance, const LevelMetric& metric, size_t first, size_t stride,
                   std::array<std::atomic<uint64_t>, kFinestLevel + 1>* counts) {
    constexpr size_t kGrainSize = 4096;
    const size_t count = (instance.surface->Patches().Count() - first + stride - 1) / stride;
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

/// Patches of all instances by level.
LevelCounts CountLevels(const Scene& scene, const LevelMetric& metric) {
    const std::vector<Instance>& instances = scene.Instances().Instances();
    std::vector<uint64_t> firsts{0};
    for (const Instance& instance : instances) {
        firsts.push_back(firsts.back() + instance.surface->Patches().Count());
    }
    const uint64_t stride = firsts.back() / kMostCountedPatches + 1;
    std::array<std::atomic<uint64_t>, kFinestLevel + 1> counts{};
    tbb::parallel_for(size_t(0), instances.size(), [&](size_t i) {
        const uint64_t first = (stride - firsts[i] % stride) % stride;
        if (first < firsts[i + 1] - firsts[i]) {
            CountLevelsOf(instances[i], metric, first, stride, &counts);
        }
    });
    LevelCounts result{};
    std::transform(counts.begin(), counts.end(), result.begin(),
                   [&](const std::atomic<uint64_t>& count) { return count * stride; });
    return result;
}

}  // namespace

LevelMetric MakeLevelMetric(const Scene& scene, const Camera& camera, int width, int height,
                            const RenderOptions& options) {
    const bool canAdapt =
        options.tracer == TracerKind::Packet || options.tracer == TracerKind::Single;
    if (!options.adaptive || !canAdapt) {
        return options.level;
    }
    const LevelView view = MakeLevelView(camera, width, height);
    const float reach = options.alpha * scene.Instances().Bounds().Diagonal();
    if (reach > 0) {
        return DistanceMetric{view.eye, reach, options.level};
    }
    return PixelErrorMetric{view, options.pixelError, options.level};
}

LevelMetric SecondaryLevels(const LevelMetric& primary, const RenderOptions& options) {
    if (const auto* rule = std::get_if<PixelErrorMetric>(&primary.GetRule())) {
        PixelErrorMetric secondary = *rule;
        secondary.remoteError = options.secondaryError;
        return secondary;
    }
    return primary;
}

bool RenderFrame(const Scene& scene, const Camera& camera, const RenderOptions& options, Film* film,
                 RenderStatistics* statistics, std::atomic<int64_t>* progress,
                 const std::atomic<bool>* stop) {
    const auto start = std::chrono::steady_clock::now();
    *statistics = {};
    RenderOptions valid = options;
    valid.level = std::min(std::max(options.level, 0), 8);
    valid.samples = std::max(options.samples, 1);
    valid.threads = options.threads > 0 ? options.threads : tbb::info::default_concurrency();

    const CameraRays cameraRays(camera, film->Width(), film->Height());
    if (!cameraRays.IsValid()) {
        film->Clear();
        if (progress) {
            progress->fetch_add(int64_t(film->Width()) * film->Height());
        }
        return true;
    }
    if (valid.tracer == TracerKind::Tessellated && !scene.TessellationFits()) {
        valid.tracer = TracerKind::Packet;  // as Scene::Build has said
    }
    const LevelMetric levels = MakeLevelMetric(scene, camera, film->Width(), film->Height(), valid);
    const std::unique_ptr<Tracer> tracer = MakeTracer(valid.tracer, levels);
    const std::unique_ptr<Tracer> shadows =
        MakeTracer(valid.tracer, SecondaryLevels(levels, valid));
    const TileRenderer renderer(scene, cameraRays, *tracer, *shadows, levels, valid, film);
    const std::vector<Tile> tiles = TilesFromTheMiddle(film->Width(), film->Height());
    std::vector<RenderStatistics> workers(valid.threads);
    const size_t done = RenderTiles(renderer, tiles, valid.threads, &workers, progress, stop);
    for (const RenderStatistics& worker : workers) {
        *statistics += worker;
    }
    tbb::task_arena arena(valid.threads);
    arena.execute([&] { statistics->patchesByLevel = CountLevels(scene, levels); });
    statistics->seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return done == tiles.size();
}

}  // namespace cc
