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

/// The side of the squares whose pixels all see other times.
constexpr int kInterleave = 2;

/// Most times that a pixel sees; a pixel may be asked for as many samples as there are numbers.
constexpr int kMostTimes = 4096;

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
        _MakeParts();
    } else {
        _tiles = TilesFromTheMiddle(_width, _height);
    }
    _SetTime(0);
    _levels = MakeLevelMetric(*scene, camera, _width, _height, _options);
    _tracer = MakeTracer(_options.tracer, _levels);
    _shadows = MakeTracer(_options.tracer, SecondaryLevels(_levels, _options));
    _renderer = std::make_unique<TileRenderer>(*scene, _cameraRays, *_tracer, *_shadows, _levels,
                                               _options, !_parts.empty(), film);
}

void FrameSampler::_MakeParts() {
    const auto parts = InterleavedTiles(_width, _height, kInterleave);
    const int times = std::min(_samplesPerPixel, kMostTimes);
    for (size_t part = 0; part < parts.size(); ++part) {
        const size_t begin = _tiles.size();
        _tiles.insert(_tiles.end(), parts[part].begin(), parts[part].end());
        _parts.push_back({{begin, _tiles.size()},
                          ShutterTimes(_camera.shutterOpen, _camera.shutterClose, times,
                                       static_cast<int>(part), static_cast<int>(parts.size()))});
    }
}

bool FrameSampler::Render(int samples, SampleSums* sums, RenderStatistics* statistics,
                          std::atomic<int64_t>* progress, const std::atomic<bool>* stop) {
    const auto start = std::chrono::steady_clock::now();
    *statistics = {};
    bool isWhole;
    if (_parts.empty()) {
        isWhole = _ForTiles(
            {0, _tiles.size()},
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

/// Goes over pixels that see the same times once a sample, with everything where it is at that
/// time: the tracer knows of no motion.
bool FrameSampler::_RenderMoving(int samples, SampleSums* sums, RenderStatistics* statistics,
                                 std::atomic<int64_t>* progress, const std::atomic<bool>* stop) {
    if (_SamplesDone({0, _tiles.size()}, sums) == 0) {
        _SetTime(0);
        const auto renderCentres = [&](size_t tile, RenderWorker* worker) {
            _renderer->RenderCentres(_tiles[tile], worker);
        };
        if (!_ForTiles({0, _tiles.size()}, renderCentres, statistics, stop)) {
            return false;
        }
    }
    for (int sample = 0; sample < samples; ++sample) {
        const auto renderSample = [&](size_t tile, RenderWorker* worker) {
            _RenderTile(tile, sample + 1, sums, worker, progress);
        };
        for (const Part& part : _parts) {
            if (_SamplesDone(part.tiles, sums) > sample) {
                continue;
            }
            _SetTime(part.times[sample % part.times.size()]);
            if (!_ForTiles(part.tiles, renderSample, statistics, stop)) {
                return false;
            }
        }
    }
    return true;
}

int FrameSampler::_SamplesDone(TileRange tiles, SampleSums* sums) const {
    int done = _samplesPerPixel;
    for (size_t tile = tiles.begin; tile < tiles.end; ++tile) {
        done = std::min(done, sums->Count(tile));
    }
    return done;
}

void FrameSampler::_SetTime(float time) {
    tbb::task_arena(_options.threads).execute([&] { _scene.SetTime(time); });
    _cameraRays = CameraRays(_camera.At(time), _width, _height);
}

/// Hands tiles to as many workers as there are threads, in order, until all are done or stopped.
bool FrameSampler::_ForTiles(TileRange range, const TileWork& work, RenderStatistics* statistics,
                             const std::atomic<bool>* stop) const {
    std::vector<RenderStatistics> workers(_options.threads);
    std::atomic<size_t> next{range.begin}, done{0};
    tbb::task_arena arena(_options.threads);
    arena.execute([&] {
        tbb::parallel_for(
            0, _options.threads,
            [&](int worker) {
                // Kept apart, as neighbours in memory would slow each other down.
                RenderWorker own;
                while (!IsStopped(stop)) {
                    const size_t tile = next.fetch_add(1, std::memory_order_relaxed);
                    if (tile >= range.end) {
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
    return done == range.end - range.begin;
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
    if (!_parts.empty()) {
        _SetTime(0);
    }
    tbb::task_arena arena(_options.threads);
    return arena.execute(
        [&] { return cc::CountLevels(_scene.Instances().Instances(), _levels, stop); });
}

}  // namespace cc
