#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/render/film.h"
#include "core/render/frameSampler.h"
#include "core/render/renderer.h"
#include "core/scene/camera.h"
#include "core/scene/scene.h"

namespace cc {

/// A frame that is rendered in passes, each of which makes a picture: of one ray for each block of
/// pixels, in smaller and smaller blocks; of a sample a pixel; then of more and more. The last is
/// bit for bit what RenderFrame makes.
class ProgressiveFrame {
  public:
    /// @param scene  built; nothing else may touch it while a pass renders; it must outlive the
    ///               frame
    ProgressiveFrame(Scene* scene, const Camera& camera, const RenderOptions& options, int width,
                     int height, std::vector<Aov> aovs);
    ProgressiveFrame(const ProgressiveFrame&) = delete;
    ProgressiveFrame& operator=(const ProgressiveFrame&) = delete;

    /// Renders the next pass. The first one takes few milliseconds.
    /// @param progress  samples done, counted up; blocks count for nothing. May be null
    /// @param stop      the pass is left soon after it turns true; the next call takes it up again.
    ///                  May be null
    /// Returns false if it was stopped: there is no new picture.
    bool RenderPass(std::atomic<int64_t>* progress, const std::atomic<bool>* stop);

    /// True after the last pass.
    bool IsDone() const { return _isDone; }
    /// Samples a pixel of the passes that are finished, 0 while pictures are made of blocks.
    int SamplesDone() const { return _samplesDone; }
    /// What the samples so far took; patches by level after the last pass.
    const RenderStatistics& Statistics() const { return _statistics; }
    /// The picture of the pass that has just ended. May be called once a pass.
    Film TakePicture();

  private:
    bool _RenderBlocks(const std::atomic<bool>* stop);
    bool _RenderSamples(std::atomic<int64_t>* progress, const std::atomic<bool>* stop);
    void _BeginSamples();
    int _NextSamples() const;

    Scene& _scene;
    Camera _camera;
    RenderOptions _options;
    int _width, _height;
    std::vector<Aov> _aovs;

    /// Side of the next blocks in pixels.
    int _blockSize;
    Film _blocks;

    // Made when the first sample asks for them, as large films take their time:
    Film _film;
    std::unique_ptr<FrameSampler> _sampler;
    std::unique_ptr<SampleSums> _sums;

    RenderStatistics _statistics;
    int _samplesDone = 0;
    bool _isDone = false;
};

}  // namespace cc
