#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "core/render/cameraRays.h"
#include "core/render/film.h"
#include "core/render/levelCounts.h"
#include "core/render/renderer.h"
#include "core/render/tileOrder.h"
#include "core/render/tileRenderer.h"

namespace cc {

/// What the pixels of each tile have gathered so far, so that more samples can be added later.
class SampleSums {
  public:
    explicit SampleSums(size_t tiles) : _counts(tiles), _colors(tiles) {}

    /// Samples a pixel.
    int& Count(size_t tile) { return _counts[tile]; }
    TileColors& Colors(size_t tile) { return _colors[tile]; }

  private:
    std::vector<int> _counts;
    std::vector<TileColors> _colors;
};

/// Renders samples of a film's pixels on many threads: what a frame in one go and the passes of a
/// progressive one share. Pixels do not depend on how samples are spread over calls, nor on the
/// number of threads.
class FrameSampler {
  public:
    /// @param scene  built; nothing else may touch it while samples are rendered, since what moves
    ///               is shown at one time after the other; it must outlive this, as the film must
    FrameSampler(Scene* scene, const Camera& camera, const RenderOptions& options, Film* film);
    FrameSampler(const FrameSampler&) = delete;
    FrameSampler& operator=(const FrameSampler&) = delete;

    /// False if the camera cannot show anything: there are no tiles then.
    bool IsValid() const { return _cameraRays.IsValid(); }
    size_t TileCount() const { return _tiles.size(); }
    /// What a pixel gets in the end: all but colour needs only one.
    int SamplesPerPixel() const { return _samplesPerPixel; }

    /// Renders what each pixel lacks of a number of samples.
    /// @param samples   1 to SamplesPerPixel()
    /// @param sums      a place a tile, for calls to come; null if there are none
    /// @param progress  samples done, counted up; may be null
    /// @param stop      tiles not begun are left out once it turns true; may be null
    /// Returns false if tiles are left.
    bool Render(int samples, SampleSums* sums, RenderStatistics* statistics,
                std::atomic<int64_t>* progress, const std::atomic<bool>* stop);

    /// Patches of all instances by level. Wrong if stopped.
    LevelCounts CountLevels(const std::atomic<bool>* stop);

  private:
    using TileWork = std::function<void(size_t tile, RenderWorker* worker)>;
    struct TileRange {
        size_t begin, end;
    };
    /// Pixels that see the scene at the same times.
    struct Part {
        TileRange tiles;
        std::vector<float> times;  ///< of the samples, which go through them again and again
    };

    void _MakeParts();
    int _SamplesDone(TileRange tiles, SampleSums* sums) const;
    bool _RenderMoving(int samples, SampleSums* sums, RenderStatistics* statistics,
                       std::atomic<int64_t>* progress, const std::atomic<bool>* stop);
    bool _ForTiles(TileRange range, const TileWork& work, RenderStatistics* statistics,
                   const std::atomic<bool>* stop) const;
    void _RenderTile(size_t tile, int samples, SampleSums* sums, RenderWorker* worker,
                     std::atomic<int64_t>* progress) const;
    void _SetTime(float time);

    Scene& _scene;
    const Camera _camera;
    const int _width, _height;
    RenderOptions _options;
    /// As they are at the time that is shown.
    CameraRays _cameraRays;
    LevelMetric _levels;
    std::unique_ptr<Tracer> _tracer, _shadows;
    std::unique_ptr<TileRenderer> _renderer;
    std::vector<Tile> _tiles;
    int _samplesPerPixel = 1;
    /// If anything moves; else empty.
    std::vector<Part> _parts;
};

}  // namespace cc
