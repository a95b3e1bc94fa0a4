#pragma once

#include <atomic>
#include <cstdint>

#include "core/render/film.h"
#include "core/render/levelCounts.h"
#include "core/scene/camera.h"
#include "core/scene/scene.h"
#include "core/trace/traceStatistics.h"
#include "core/trace/tracer.h"

namespace cc {

enum class IntegratorKind { Raycast };

/// What the hdcc: render settings say, within their ranges.
struct RenderOptions {
    TracerKind tracer = TracerKind::Packet;
    IntegratorKind integrator = IntegratorKind::Raycast;
    /// Cut surfaces as finely as the camera needs: packets and single rays do, other tracers do
    /// not.
    bool adaptive = true;
    /// Pixels that quads may be off the surface by in the picture; above 0.
    float pixelError = 0.25f;
    /// The same in what rays see that start on a surface, if that is more: of other instances, and
    /// only where levels go by error.
    float secondaryError = 0;
    /// Above 0: levels by distance instead, with the paper's alpha (DistanceLevels).
    float alpha = 0;
    int level = 4;     ///< 0..8, the finest if adaptive, else of all
    int samples = 16;  ///< a pixel, 1 or more
    int seed = 0;
    int threads = 0;  ///< up to 1024; 0: as many as there are cores
};

/// What a frame took.
struct RenderStatistics {
    /// Threads that had a part in it: fewer than were asked for if there is not work for all.
    int threads = 0;
    uint64_t primaryRays = 0, shadowRays = 0;
    /// Seconds inside the tracer, added up over threads.
    double primarySeconds = 0, shadowSeconds = 0;
    double seconds = 0;  ///< wall time of the frame
    /// The scene's patches by the level that they are cut to inside.
    LevelCounts patchesByLevel{};
    TraceStatistics trace;

    RenderStatistics& operator+=(const RenderStatistics& b) {
        threads += b.threads;
        primaryRays += b.primaryRays;
        shadowRays += b.shadowRays;
        primarySeconds += b.primarySeconds;
        shadowSeconds += b.shadowSeconds;
        seconds += b.seconds;
        trace += b.trace;
        return *this;
    }
};

/// How finely a frame cuts surfaces, for rays from the camera. Secondary rays may see them coarser.
LevelMetric MakeLevelMetric(const Scene& scene, const Camera& camera, int width, int height,
                            const RenderOptions& options);

/// The levels that rays see which start on what the camera's rays hit.
LevelMetric SecondaryLevels(const LevelMetric& primary, const RenderOptions& options);

/// Renders a built scene into the planes that the film has. The result is the same for any number
/// of threads. Ids, depths and normals are those of the pixel's centre at time 0; colour is the
/// average of all samples, at times while the shutter is open. A camera that cannot show anything
/// gives background.
/// @param scene     nothing else may touch it meanwhile: what moves is shown at one time after the
///                  other
/// @param progress  samples of pixels done, counted up while the frame renders; may be null
/// @param stop      the frame is given up soon after it turns true; may be null
/// Returns false if it was stopped.
bool RenderFrame(Scene* scene, const Camera& camera, const RenderOptions& options, Film* film,
                 RenderStatistics* statistics, std::atomic<int64_t>* progress,
                 const std::atomic<bool>* stop);

}  // namespace cc
