#include "core/render/frameSampler.h"

#include <algorithm>
#include <chrono>

#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "core/render/shutterTimes.h"

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

/// True if samples that are taken at different times see something else.
bool IsBlurred(const Scene& scene, const Camera& camera) {
    const bool isOpen = camera.shutterOpen < camera.shutterClose;
    return isOpen && (scene.IsMoving() || camera.motion.IsMoving());
}

bool IsStopped(const std::atomic<bool>* stop) {
    return stop && stop->load(std::memory_order_relaxed);
}

}  // namespace

FrameSampler::FrameSampler(Scene* scene, const Camera& camera, const RenderOptions& options,
                           Film* film)
    : _scene(*scene),
      _camera(camera),
      _width(film->Width()),
      _height(film->Height()),
      _options(MakeValid(*scene, options)),
      _cameraRays(camera, _width, _height),
      _levels(_options.level) {
    _samplesPerPixel = film->Has(Aov::Color) ? _options.samples : 1;
    if (!IsValid()) {
        return;
    }
    if (film->Has(Aov::Color) && IsBlurred(*scene, camera)) {
        _times = ShutterTimes(camera.shutterOpen, camera.shutterClose, _samplesPerPixel);
    }
    _SetTime(0);
    _levels = MakeLevelMetric(*scene, camera, _width, _height, _options);
    _tracer = MakeTracer(_options.tracer, _levels);
    _shadows = MakeTracer(_options.tracer, SecondaryLevels(_levels, _options));
    _renderer = std::make_unique<TileRenderer>(*scene, _cameraRays, *_tracer, *_shadows, _levels,
                                               _options, !_times.empty(), film);
    _tiles = TilesFromTheMiddle(_width, _height);
}

bool FrameSampler::Render(int samples, SampleSums* sums, RenderStatistics* statistics,
                          std::atomic<int64_t>* progress, const std::atomic<bool>* stop) {
    const auto start = std::chrono::steady_clock::now();
    *statistics = {};
    bool isWhole;
    if (_times.empty()) {
        isWhole = _ForTiles(
            [&](size_t tile, RenderWorker* worker) {
                _RenderTile(tile, samples, sums, worker, progress);
            },
            statistics, stop);
    } else if (sums) {
        isWhole = _RenderMoving(samples, sums, statistics, progress, stop);
    } else {
        SampleSums own(_tiles.size());
        isWhole = _RenderMoving(samples, &own, statistics, progress, stop);
    }
    statistics->seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return isWhole;
}

/// Goes over the whole picture once a sample, with everything where it is at the sample's time:
/// whatever moves has tight levels and normals of its own then, and the tracer knows of no motion.
bool FrameSampler::_RenderMoving(int samples, SampleSums* sums, RenderStatistics* statistics,
                                 std::atomic<int64_t>* progress, const std::atomic<bool>* stop) {
    int done = samples;
    for (size_t tile = 0; tile < _tiles.size(); ++tile) {
        done = std::min(done, sums->Count(tile));
    }
    if (done == 0) {
        _SetTime(0);
        const auto renderCentres = [&](size_t tile, RenderWorker* worker) {
            _renderer->RenderCentres(_tiles[tile], worker);
        };
        if (!_ForTiles(renderCentres, statistics, stop)) {
            return false;
        }
    }
    for (; done < samples; ++done) {
        _SetTime(_times[done]);
        const auto renderSample = [&](size_t tile, RenderWorker* worker) {
            _RenderTile(tile, done + 1, sums, worker, progress);
        };
        if (!_ForTiles(renderSample, statistics, stop)) {
            return false;
        }
    }
    return true;
}

void FrameSampler::_SetTime(float time) {
    tbb::task_arena(_options.threads).execute([&] { _scene.SetTime(time); });
    _cameraRays = CameraRays(_camera.At(time), _width, _height);
}

/// Hands tiles to as many workers as there are threads, in order, until all are done or stopped.
bool FrameSampler::_ForTiles(const TileWork& work, RenderStatistics* statistics,
                             const std::atomic<bool>* stop) const {
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
                    work(tile, &own);
                    done.fetch_add(1, std::memory_order_relaxed);
                }
                workers[worker] = own.statistics;
            },
            tbb::simple_partitioner());
    });
    const int threads = statistics->threads;
    statistics->threads = 0;
    for (const RenderStatistics& worker : workers) {
        *statistics += worker;
    }
    statistics->threads = std::max(statistics->threads, threads);
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

LevelCounts FrameSampler::CountLevels(const std::atomic<bool>* stop) {
    if (!_times.empty()) {
        _SetTime(0);
    }
    tbb::task_arena arena(_options.threads);
    return arena.execute(
        [&] { return cc::CountLevels(_scene.Instances().Instances(), _levels, stop); });
}

}  // namespace cc
