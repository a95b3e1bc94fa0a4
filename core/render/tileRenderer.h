#pragma once

#include <array>

#include "core/render/cameraRays.h"
#include "core/render/film.h"
#include "core/render/renderWorker.h"
#include "core/render/shadingPoint.h"
#include "core/render/tileOrder.h"
#include "core/scene/scene.h"
#include "core/trace/tracer.h"

namespace cc {

/// Of a tile's pixels, row by row from the lower left: the sum of the samples so far, red, green,
/// blue and coverage.
using TileColors = std::array<float, 4 * kTileSize * kTileSize>;

/// Some of a pixel's samples, from `begin` to before `end`.
struct SampleRange {
    int begin, end;
};

/// Renders tiles into a film, one packet of rays a sample. Tiles do not share pixels: different
/// threads may render different tiles.
class TileRenderer {
  public:
    /// @param camera    may change between calls, as the scene may
    /// @param tracer    for the camera's rays, made with the levels
    /// @param shadows   for rays that start on what those hit
    /// @param isMoving  samples are taken at times of their own: RenderCentres is called apart
    TileRenderer(const Scene& scene, const CameraRays& camera, const Tracer& tracer,
                 const Tracer& shadows, const LevelMetric& levels, const RenderOptions& options,
                 bool isMoving, Film* film);

    /// Fills all planes but colour, by rays through the middle of pixels and lens.
    void RenderCentres(const Tile& tile, RenderWorker* worker) const;

    /// Adds samples to those before, and shows the sum in the film. Unless they are taken at times
    /// of their own, the first sample also fills the other planes.
    /// @param colors  what the samples before `samples.begin` summed up to
    void Render(const Tile& tile, SampleRange samples, TileColors* colors,
                RenderWorker* worker) const;

  private:
    /// Rays through the pixels of a tile, row by row from the lower left, and what they hit.
    struct Sample {
        RayPacket rays;
        float farEnd[kPacketSize];  ///< of the rays before they hit
        HitPacket hits;

        bool IsHit(int lane) const { return hits.instance[lane] != kNoHit; }
    };

    void _WriteCentres(const Tile& tile, Sample* sample, RenderWorker* worker) const;
    /// @param isThroughLens  rays start anywhere on the camera's lens, else at its centre
    void _TraceSample(const Tile& tile, int index, bool isThroughLens, Sample* sample,
                      RenderWorker* worker) const;
    void _Intersect(RayPacket* rays, HitPacket* hits, RenderWorker* worker) const;
    void _PassThroughCulled(Sample* sample, RenderWorker* worker) const;
    bool _IsCulled(const RayPacket& rays, const HitPacket& hits, int lane) const;
    /// Where on its shape a ray hit.
    ShapePoint _PointOf(const HitPacket& hits, int lane) const;
    ShadingPoint _Shade(const Sample& sample, int lane) const;
    void _AddColor(const Sample& sample, float* rgba, RenderWorker* worker) const;
    void _WriteColor(const Tile& tile, const TileColors& colors, int samples) const;
    void _WriteSurface(const Tile& tile, const Sample& sample) const;
    void _WriteLevels(const Tile& tile, const Sample& sample) const;
    /// @param before  what the worker had counted before the sample
    void _WriteCost(const Tile& tile, const TraceStatistics& before,
                    const TraceStatistics& after) const;
    void _WritePrimvar(const Tile& tile, const Sample& sample, const Aov& aov) const;

    const Scene& _scene;
    const CameraRays& _camera;
    const Tracer& _tracer;
    const Tracer& _shadows;
    const LevelMetric& _levels;
    const RenderOptions& _options;
    /// False if the first sample of colour is the ray through the middle of the pixel.
    const bool _centresAreApart;
    const bool _isMoving;
    Film* _film;
    bool _hasCulling = false;
};

}  // namespace cc
