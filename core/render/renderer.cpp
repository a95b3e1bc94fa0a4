#include "core/render/renderer.h"

#include <chrono>

#include "core/render/frameSampler.h"
#include "core/render/levelView.h"

namespace cc {

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

bool RenderFrame(Scene* scene, const Camera& camera, const RenderOptions& options, Film* film,
                 RenderStatistics* statistics, std::atomic<int64_t>* progress,
                 const std::atomic<bool>* stop) {
    const auto start = std::chrono::steady_clock::now();
    FrameSampler sampler(scene, camera, options, film);
    if (!sampler.IsValid()) {
        *statistics = {};
        film->Clear();
        if (progress) {
            progress->fetch_add(int64_t(film->Width()) * film->Height() *
                                sampler.SamplesPerPixel());
        }
        return true;
    }
    const bool isWhole =
        sampler.Render(sampler.SamplesPerPixel(), nullptr, statistics, progress, stop);
    statistics->patchesByLevel = sampler.CountLevels(stop);
    statistics->seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return isWhole;
}

}  // namespace cc
