#include "core/render/frameSampler.h"

#include <algorithm>
#include <chrono>

#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace cc {
namespace {

RenderOptions MakeValid(const Scene& scene, const RenderOptions& options) {
    RenderOptions valid = options;
    valid.level = std::min(std::max(options.level, 0), 8);
    valid.samples = std::max(options.samples, 1);
    valid.threads = options.threads > 0 ? options.threads : tbb::info::default_concurrency();
    if (valid.tracer == TracerKind::Tessellated && !scene.TessellationFits()) {
        valid.tracer = TracerKind::Packet;  // as Scene::Build has said
    }
    return valid;
}

bool IsStopped(const std::atomic<bool>* stop) {
    return stop && stop->load(std::memory_order_relaxed);
}

}  // namespace

FrameSampler::FrameSampler(const Scene& scene, const Camera& camera, const RenderOptions& options,
                           Film* film)
    : _scene(scene),
      _options(MakeValid(scene, options)),
      _cameraRays(camera, film->Width(), film->Height()),
      _levels(_options.level) {
    _samplesPerPixel = film->Has(Aov::Color) ? _options.samples : 1;
    if (!IsValid()) {
        return;
    }
    _levels = MakeLevelMetric(scene, camera, film->Width(), film->Height(), _options);
    _tracer = MakeTracer(_options.tracer, _levels);
    _shadows = MakeTracer(_options.tracer, SecondaryLevels(_levels, _options));
    _renderer = std::make_unique<TileRenderer>(scene, _cameraRays, *_tracer, *_shadows, _levels,
                                               _options, film);
    _tiles = TilesFromTheMiddle(film->Width(), film->Height());
}

/// Hands tiles to as many workers as there are threads, in order, until all are done or stopped.
bool FrameSampler::Render(int samples, SampleSums* sums, RenderStatistics* statistics,
                          std::atomic<int64_t>* progress, const std::atomic<bool>* stop) const {
    const auto start = std::chrono::steady_clock::now();
    std::vector<RenderStatistics> workers(_options.threads);
    std::atomic<size_t> next{0}, done{0};
    tbb::task_arena arena(_options.threads);
    arena.execute([&] {
        tbb::parallel_for(
            0, _options.threads,
            [&](int worker) {
                // Kept apart, as neighbours in memory would slow each other down.
                RenderWorker own;
                while (!IsStopped(stop)) {
                    const size_t tile = next.fetch_add(1, std::memory_order_relaxed);
                    if (tile >= _tiles.size()) {
                        break;
                    }
                    _RenderTile(tile, samples, sums, &own, progress);
                    done.fetch_add(1, std::memory_order_relaxed);
                }
                workers[worker] = own.statistics;
            },
            tbb::simple_partitioner());
    });
    *statistics = {};
    for (const RenderStatistics& worker : workers) {
        *statistics += worker;
    }
    statistics->seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return done == _tiles.size();
}

void FrameSampler::_RenderTile(size_t tile, int samples, SampleSums* sums, RenderWorker* worker,
                               std::atomic<int64_t>* progress) const {
    const Tile& area = _tiles[tile];
    const int begin = sums ? sums->Count(tile) : 0;
    if (begin < samples) {
        TileColors fresh{};
        _renderer->Render(area, {begin, samples}, sums ? &sums->Colors(tile) : &fresh, worker);
        worker->statistics.threads = 1;
        if (sums) {
            sums->Count(tile) = samples;
        }
        if (progress) {
            progress->fetch_add(int64_t(area.width) * area.height * (samples - begin));
        }
    }
}

LevelCounts FrameSampler::CountLevels(const std::atomic<bool>* stop) const {
    tbb::task_arena arena(_options.threads);
    return arena.execute(
        [&] { return cc::CountLevels(_scene.Instances().Instances(), _levels, stop); });
}

}  // namespace cc
