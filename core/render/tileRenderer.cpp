#include "core/render/tileRenderer.h"

#include <algorithm>
#include <chrono>

#include "core/render/directLight.h"
#include "core/render/lensSampler.h"
#include "core/render/pixelSampler.h"
#include "core/trace/gridStitch.h"
#include "core/trace/instanceLevels.h"

namespace cc {
namespace {

static_assert(kTileSize * kTileSize == kPacketSize, "a tile is a packet");

/// Culled surfaces that a ray may pass through before it is taken for a miss.
constexpr int kMaxCulledHits = 256;

/// Factor by which a ray goes on beyond a culled hit: a few units in the last place.
constexpr float kBeyondHit = 1 + 1e-6f;

void CopyRay(const RayPacket& from, int fromLane, RayPacket* to, int toLane) {
    to->originX[toLane] = from.originX[fromLane];
    to->originY[toLane] = from.originY[fromLane];
    to->originZ[toLane] = from.originZ[fromLane];
    to->directionX[toLane] = from.directionX[fromLane];
    to->directionY[toLane] = from.directionY[fromLane];
    to->directionZ[toLane] = from.directionZ[fromLane];
    to->tMin[toLane] = from.tMin[fromLane];
    to->tMax[toLane] = from.tMax[fromLane];
}

void CopyHit(const HitPacket& from, int fromLane, HitPacket* to, int toLane) {
    to->instance[toLane] = from.instance[fromLane];
    to->patch[toLane] = from.patch[fromLane];
    to->u[toLane] = from.u[fromLane];
    to->v[toLane] = from.v[fromLane];
}

size_t PixelOf(const Tile& tile, int lane, int filmWidth) {
    return static_cast<size_t>(tile.Y(lane)) * filmWidth + tile.X(lane);
}

void Store(const Vec3f& v, float* values) {
    values[0] = v.x;
    values[1] = v.y;
    values[2] = v.z;
}

}  // namespace

TileRenderer::TileRenderer(const Scene& scene, const CameraRays& camera, const Tracer& tracer,
                           const Tracer& shadows, const LevelMetric& levels,
                           const RenderOptions& options, bool isMoving, Film* film)
    : _scene(scene),
      _camera(camera),
      _tracer(tracer),
      _shadows(shadows),
      _levels(levels),
      _options(options),
      _centresAreApart(isMoving || camera.HasLens()),
      _isMoving(isMoving),
      _film(film) {
    for (const Shape* shape : scene.ShownShapes()) {
        _hasCulling = _hasCulling || shape->Culled() != CulledSide::None;
    }
}

void TileRenderer::Render(const Tile& tile, SampleRange samples, TileColors* colors,
                          RenderWorker* worker) const {
    Sample sample;
    if (samples.begin == 0 && !_isMoving) {
        _WriteCentres(tile, &sample, worker);
    }
    if (!_film->Has(Aov::Color)) {
        return;
    }
    for (int i = samples.begin; i < samples.end; ++i) {
        // The first sample may be there already.
        if (i > 0 || _centresAreApart) {
            _TraceSample(tile, i, true, &sample, worker);
        }
        _AddColor(sample, colors->data(), worker);
    }
    _WriteColor(tile, *colors, samples.end);
}

void TileRenderer::RenderCentres(const Tile& tile, RenderWorker* worker) const {
    Sample sample;
    _WriteCentres(tile, &sample, worker);
}

void TileRenderer::_WriteCentres(const Tile& tile, Sample* sample, RenderWorker* worker) const {
    if (_centresAreApart && _film->Aovs().size() == 1 && _film->Has(Aov::Color)) {
        return;
    }
    if (_film->Has(Aov::Cost)) {
        // Which packets a thread has traced before is chance, and no part of the cost.
        worker->grids.Clear();
    }
    const TraceStatistics before = worker->statistics.trace;
    _TraceSample(tile, 0, false, sample, worker);
    _WriteCost(tile, before, worker->statistics.trace);
    _WriteLevels(tile, *sample);
    _WriteSurface(tile, *sample);
    for (const Aov& aov : _film->Aovs()) {
        if (aov.kind == Aov::Primvar) {
            _WritePrimvar(tile, *sample, aov);
        }
    }
}

void TileRenderer::_TraceSample(const Tile& tile, int index, bool isThroughLens, Sample* sample,
                                RenderWorker* worker) const {
    const bool samplesLens = isThroughLens && _camera.HasLens();
    RayPacket& rays = sample->rays;
    rays.count = tile.Count();
    for (int lane = 0; lane < rays.count; ++lane) {
        const int x = tile.X(lane), y = tile.Y(lane);
        const Vec2f inPixel = PixelSampler(x, y, _options.seed, _options.samples).Sample(index);
        const Vec2f onLens =
            samplesLens ? LensSampler(x, y, _options.seed).Sample(index) : Vec2f{0, 0};
        _camera.SetLensRay(double(x) + inPixel.x, double(y) + inPixel.y, onLens, lane, &rays);
    }
    std::copy_n(rays.tMax, rays.count, sample->farEnd);
    _Intersect(&sample->rays, &sample->hits, worker);
    if (_hasCulling) {
        _PassThroughCulled(sample, worker);
    }
}

void TileRenderer::_Intersect(RayPacket* rays, HitPacket* hits, RenderWorker* worker) const {
    const auto start = std::chrono::steady_clock::now();
    _tracer.Intersect(_scene.Instances(), rays, hits, &worker->statistics.trace, &worker->grids);
    worker->statistics.primarySeconds +=
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    worker->statistics.primaryRays += rays->count;
}

bool TileRenderer::_IsCulled(const RayPacket& rays, const HitPacket& hits, int lane) const {
    const uint32_t instance = hits.instance[lane];
    if (instance == kNoHit || _scene.InstanceShape(instance).Culled() == CulledSide::None) {
        return false;
    }
    const bool isBehind =
        IsHitFromBehind(_scene.Instances().Instances()[instance], rays, hits, lane, _levels);
    return isBehind == (_scene.InstanceShape(instance).Culled() == CulledSide::Back);
}

void TileRenderer::_PassThroughCulled(Sample* sample, RenderWorker* worker) const {
    // Of the rays that are still on their way: the lane in the sample.
    int lanes[kPacketSize];
    RayPacket rays;
    for (int lane = 0; lane < sample->rays.count; ++lane) {
        if (_IsCulled(sample->rays, sample->hits, lane)) {
            lanes[rays.count] = lane;
            CopyRay(sample->rays, lane, &rays, rays.count++);
        }
    }
    for (int passed = 0; passed < kMaxCulledHits && rays.count > 0; ++passed) {
        for (int i = 0; i < rays.count; ++i) {
            rays.tMin[i] = rays.tMax[i] * kBeyondHit;
            rays.tMax[i] = sample->farEnd[lanes[i]];
        }
        HitPacket hits;
        _Intersect(&rays, &hits, worker);
        int remaining = 0;
        for (int i = 0; i < rays.count; ++i) {
            if (_IsCulled(rays, hits, i)) {
                lanes[remaining] = lanes[i];
                CopyRay(rays, i, &rays, remaining++);
            } else {
                sample->rays.tMax[lanes[i]] = rays.tMax[i];
                CopyHit(hits, i, &sample->hits, lanes[i]);
            }
        }
        rays.count = remaining;
    }
    for (int i = 0; i < rays.count; ++i) {
        sample->hits.instance[lanes[i]] = kNoHit;
    }
}

ShapePoint TileRenderer::_PointOf(const HitPacket& hits, int lane) const {
    return {_scene.InstanceIndex(hits.instance[lane]), hits.patch[lane], hits.u[lane],
            hits.v[lane]};
}

ShadingPoint TileRenderer::_Shade(const Sample& sample, int lane) const {
    const HitPacket& hits = sample.hits;
    const uint32_t instance = hits.instance[lane];
    const Vec3f authored = _scene.InstanceShape(instance).AuthoredNormal(_PointOf(hits, lane));
    return MakeShadingPoint(_scene.Instances().Instances()[instance], authored, sample.rays, hits,
                            lane, _levels);
}

void TileRenderer::_AddColor(const Sample& sample, float* rgba, RenderWorker* worker) const {
    const HitPacket& hits = sample.hits;
    ShadingPoint points[kPacketSize];
    int lanes[kPacketSize];
    int count = 0;
    for (int lane = 0; lane < sample.rays.count; ++lane) {
        if (sample.IsHit(lane)) {
            points[count] = _Shade(sample, lane);
            points[count].albedo =
                _scene.InstanceShape(hits.instance[lane]).DisplayColor(_PointOf(hits, lane));
            lanes[count++] = lane;
        }
    }
    Vec3f radiance[kPacketSize];
    AddDirectLight(_scene, _shadows, points, count, radiance, worker);
    for (int i = 0; i < count; ++i) {
        float* pixel = rgba + 4 * lanes[i];
        pixel[0] += radiance[i].x;
        pixel[1] += radiance[i].y;
        pixel[2] += radiance[i].z;
        pixel[3] += 1;
    }
}

void TileRenderer::_WriteColor(const Tile& tile, const TileColors& colors, int samples) const {
    float* plane = _film->Floats(Aov::Color);
    for (int lane = 0; lane < tile.Count(); ++lane) {
        const float* sum = colors.data() + 4 * size_t(lane);
        float* pixel = plane + 4 * PixelOf(tile, lane, _film->Width());
        for (int i = 0; i < 4; ++i) {
            pixel[i] = sum[i] / static_cast<float>(samples) * (i < 3 ? _camera.Exposure() : 1);
        }
    }
}

void TileRenderer::_WriteSurface(const Tile& tile, const Sample& sample) const {
    float* depth = _film->Floats(Aov::Depth);
    float* cameraDepth = _film->Floats(Aov::CameraDepth);
    float* normal = _film->Floats(Aov::Normal);
    float* neye = _film->Floats(Aov::Neye);
    int32_t* primId = _film->Ints(Aov::PrimId);
    int32_t* instanceId = _film->Ints(Aov::InstanceId);
    int32_t* elementId = _film->Ints(Aov::ElementId);
    int32_t* material = _film->Ints(Aov::Material);
    for (int lane = 0; lane < sample.rays.count; ++lane) {
        const size_t pixel = PixelOf(tile, lane, _film->Width());
        const bool isHit = sample.IsHit(lane);
        const float t = sample.rays.tMax[lane];
        const Shape* shape = isHit ? &_scene.InstanceShape(sample.hits.instance[lane]) : nullptr;
        if (depth) depth[pixel] = isHit ? _camera.ProjectedDepth(t) : 1;
        if (cameraDepth) cameraDepth[pixel] = isHit ? t : 0;
        if (primId) primId[pixel] = isHit ? shape->PrimId() : -1;
        if (instanceId) {
            instanceId[pixel] =
                isHit ? static_cast<int32_t>(_scene.InstanceIndex(sample.hits.instance[lane])) : -1;
        }
        if (elementId) {
            const uint32_t primitive = sample.hits.patch[lane];
            elementId[pixel] = isHit ? static_cast<int32_t>(shape->ElementOf(primitive)) : -1;
        }
        if (material) {
            const uint32_t instance = sample.hits.instance[lane];
            material[pixel] =
                isHit ? _scene.MaterialOf(instance, shape->ElementOf(sample.hits.patch[lane])) : -1;
        }
        if (normal || neye) {
            const Vec3f n = isHit ? _Shade(sample, lane).shadingNormal : Vec3f{};
            if (normal) Store(n, normal + 3 * pixel);
            if (neye) Store(_camera.CameraNormal(n), neye + 3 * pixel);
        }
    }
}

void TileRenderer::_WriteLevels(const Tile& tile, const Sample& sample) const {
    int32_t* level = _film->Ints(Aov::Level);
    int32_t* fan = _film->Ints(Aov::Fan);
    if (!level && !fan) {
        return;
    }
    const HitPacket& hits = sample.hits;
    for (int lane = 0; lane < sample.rays.count; ++lane) {
        const size_t pixel = PixelOf(tile, lane, _film->Width());
        PatchLevels levels;
        bool isInFan = false;
        const Instance* const hit =
            sample.IsHit(lane) ? &_scene.Instances().Instances()[hits.instance[lane]] : nullptr;
        const bool hasLevels = hit && hit->geometry->Kind() == GeometryKind::Surface;
        if (hasLevels) {
            const Instance& instance = *hit;
            levels = InstanceLevels(_levels, instance).Of(hits.patch[lane]);
            const int depth = SurfaceOf(instance).Patches().At(hits.patch[lane]).depth;
            isInFan = GridStitch(levels, {0, 0, 1}, 1 << (levels.Finest() - depth), false)
                          .IsInFan({hits.u[lane], hits.v[lane]});
        }
        if (level) level[pixel] = hasLevels ? levels.interior : -1;
        if (fan) fan[pixel] = hasLevels ? int{isInFan} : -1;
    }
}

void TileRenderer::_WriteCost(const Tile& tile, const TraceStatistics& before,
                              const TraceStatistics& after) const {
    float* cost = _film->Floats(Aov::Cost);
    if (!cost) {
        return;
    }
    const auto steps = [](const TraceStatistics& s) {
        return s.traversals + s.leafIntersections + s.subdivisionsRegular +
               s.subdivisionsIrregular + s.finalIntersections;
    };
    const int count = tile.Count();
    const auto perRay =
        static_cast<float>(steps(after) - steps(before)) / static_cast<float>(count);
    for (int lane = 0; lane < count; ++lane) {
        cost[PixelOf(tile, lane, _film->Width())] = perRay;
    }
}

void TileRenderer::_WritePrimvar(const Tile& tile, const Sample& sample, const Aov& aov) const {
    float* const values = _film->Floats(aov);
    uint8_t* const coverage = _film->Coverage(aov);
    const HitPacket& hits = sample.hits;
    for (int lane = 0; lane < sample.rays.count; ++lane) {
        const size_t pixel = PixelOf(tile, lane, _film->Width());
        const Shape* shape =
            sample.IsHit(lane) ? &_scene.InstanceShape(hits.instance[lane]) : nullptr;
        const PrimvarField* primvar = shape ? shape->FindPrimvar(aov.primvar) : nullptr;
        coverage[pixel] = primvar != nullptr;
        if (primvar) {
            const SurfaceValue value = shape->Evaluate(*primvar, _PointOf(hits, lane));
            std::copy_n(value.value, aov.arity, values + pixel * aov.arity);
        }
    }
}

}  // namespace cc
