#include "core/render/progressiveFrame.h"

#include <algorithm>
#include <utility>

namespace cc {
namespace {

/// Sides of blocks in pixels: of the first, unless they are too many, and of the last.
constexpr int kFirstBlockSize = 16;
constexpr int kLastBlockSize = 4;
constexpr int64_t kMostFirstBlocks = 16384;

/// Most samples that a pass adds to a pixel: a tile of them can be waited for.
constexpr int kMostSamplesAPass = 64;

int FirstBlockSize(int width, int height) {
    int size = kFirstBlockSize;
    while (int64_t(width / size) * (height / size) > kMostFirstBlocks) {
        size *= 2;
    }
    return size;
}

/// The camera of a film whose pixels are blocks of another film's. The last blocks may stand out
/// beyond the picture.
Camera CameraOfBlocks(Camera camera, int width, int height, int blockSize, const Film& blocks) {
    const auto widen = [](float low, float high, int pixels, int covered) {
        return low + (high - low) * (static_cast<float>(covered) / static_cast<float>(pixels));
    };
    camera.windowUpper = {
        widen(camera.windowLower.x, camera.windowUpper.x, width, blocks.Width() * blockSize),
        widen(camera.windowLower.y, camera.windowUpper.y, height, blocks.Height() * blockSize)};
    return camera;
}

/// Copies a value of a few components from each block to all of its pixels.
template <typename T>
void Enlarge(const T* blocks, int blockSize, int components, T* pixels, int width, int height) {
    const size_t rowSize = size_t(width) * components;
    for (int y = 0; y < height; ++y, pixels += rowSize) {
        if (y % blockSize != 0) {
            std::copy_n(pixels - rowSize, rowSize, pixels);
            continue;
        }
        T* to = pixels;
        for (int x = 0; x < width; x += blockSize, blocks += components) {
            for (int i = std::min(blockSize, width - x); i > 0; --i) {
                to = std::copy_n(blocks, components, to);
            }
        }
    }
}

Film Enlarged(const Film& blocks, int blockSize, int width, int height) {
    Film film(width, height, blocks.Aovs());
    const auto enlarge = [&](const auto* from, int components, auto* to) {
        if (from) {
            Enlarge(from, blockSize, components, to, width, height);
        }
    };
    for (const Aov& aov : blocks.Aovs()) {
        const int components = LayoutOf(aov).components;
        enlarge(blocks.Floats(aov), components, film.Floats(aov));
        enlarge(blocks.Ints(aov), components, film.Ints(aov));
        enlarge(blocks.Coverage(aov), 1, film.Coverage(aov));
    }
    return film;
}

}  // namespace

ProgressiveFrame::ProgressiveFrame(Scene* scene, const Camera& camera, const RenderOptions& options,
                                   int width, int height, std::vector<Aov> aovs)
    : _scene(*scene),
      _camera(camera),
      _options(options),
      _width(std::max(width, 0)),
      _height(std::max(height, 0)),
      _aovs(std::move(aovs)),
      _blockSize(FirstBlockSize(_width, _height)) {}

bool ProgressiveFrame::RenderPass(std::atomic<int64_t>* progress, const std::atomic<bool>* stop) {
    if (_isDone) {
        return true;
    }
    return _blockSize >= kLastBlockSize ? _RenderBlocks(stop) : _RenderSamples(progress, stop);
}

bool ProgressiveFrame::_RenderBlocks(const std::atomic<bool>* stop) {
    Film blocks((_width + _blockSize - 1) / _blockSize, (_height + _blockSize - 1) / _blockSize,
                _aovs);
    const Camera camera = CameraOfBlocks(_camera, _width, _height, _blockSize, blocks);
    RenderStatistics statistics;
    if (!FrameSampler(&_scene, camera, _options, &blocks)
             .Render(1, nullptr, &statistics, nullptr, stop)) {
        return false;
    }
    _blocks = Enlarged(blocks, _blockSize, _width, _height);
    _blockSize /= 2;
    return true;
}

void ProgressiveFrame::_BeginSamples() {
    _film = Film(_width, _height, _aovs);
    _sampler = std::make_unique<FrameSampler>(&_scene, _camera, _options, &_film);
    _sums = std::make_unique<SampleSums>(_sampler->TileCount());
}

/// Twice as many as there are, so that a pass is worth its picture.
int ProgressiveFrame::_NextSamples() const {
    const int more = std::min(std::max(_samplesDone, 1), kMostSamplesAPass);
    return _samplesDone + std::min(more, _sampler->SamplesPerPixel() - _samplesDone);
}

bool ProgressiveFrame::_RenderSamples(std::atomic<int64_t>* progress,
                                      const std::atomic<bool>* stop) {
    if (!_sampler) {
        _BeginSamples();
    }
    const int samples = _NextSamples();
    const int threadsBefore = _statistics.threads;
    RenderStatistics statistics;
    const bool isWhole = _sampler->Render(samples, _sums.get(), &statistics, progress, stop);
    _statistics += statistics;
    _statistics.threads = std::max(threadsBefore, statistics.threads);
    if (!isWhole) {
        return false;
    }
    if (samples == _sampler->SamplesPerPixel()) {
        _statistics.patchesByLevel = _sampler->CountLevels(stop);
        _isDone = !(stop && *stop);
        if (!_isDone) {
            return false;
        }
    }
    _samplesDone = samples;
    return true;
}

Film ProgressiveFrame::TakePicture() {
    if (_samplesDone == 0) {
        return std::move(_blocks);
    }
    return _isDone ? std::move(_film) : _film;
}

}  // namespace cc
