#include "tracing.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <stdexcept>

#include "core/subdiv/limitPoint.h"

namespace {

const std::map<std::string, cc::TracerKind> kTracers{
    {"packet", cc::TracerKind::Packet},
    {"algorithm1", cc::TracerKind::Algorithm1},
    {"algorithm1-texture", cc::TracerKind::Algorithm1WithTexture},
    {"single", cc::TracerKind::Single},
    {"tessellated", cc::TracerKind::Tessellated},
};

/// One thread's tracing of chunks.
class Worker {
  public:
    Worker(const cc::Scene& scene, const cc::Tracer& tracer, bool anyHit, HitValues values)
        : _scene(scene), _tracer(tracer), _anyHit(anyHit), _values(values) {}

    void Load(const RayChunk& chunk) {
        const Ray* rays = chunk.rays;
        _count = chunk.packetCount;
        for (int i = 0; i < _count; ++i) {
            FillPacket(rays, chunk.packetSizes[i], &_packets[i]);
            rays += chunk.packetSizes[i];
        }
    }

    void Trace() {
        for (int i = 0; i < _count; ++i) {
            if (_anyHit) {
                _occluded[i] =
                    _tracer.Occluded(_scene.Instances(), _packets[i], &statistics, &_grids);
                continue;
            }
            _tracer.Intersect(_scene.Instances(), &_packets[i], &_hits[i], &statistics, &_grids);
            if (_values == HitValues::TextureCoordinates) {
                _EvaluateHits(_packets[i].count, _hits[i]);
            }
        }
    }

    uint64_t CountHits() const {
        uint64_t hits = 0;
        for (int i = 0; i < _count; ++i) {
            for (int lane = 0; lane < _packets[i].count; ++lane) {
                hits += _anyHit ? _occluded[i] >> lane & 1 : _hits[i].instance[lane] != cc::kNoHit;
            }
        }
        return hits;
    }

    cc::TraceStatistics statistics;

  private:
    /// The cage's points stand in for texture coordinates: any vertex primvar costs the same.
    void _EvaluateHits(int count, const cc::HitPacket& hits) {
        for (int i = 0; i < count; ++i) {
            if (hits.instance[i] != cc::kNoHit) {
                const cc::Surface& surface =
                    cc::SurfaceOf(_scene.Instances().Instances()[hits.instance[i]]);
                _sink += EvaluateLimitValue(surface.Patches(), hits.patch[i],
                                            surface.PatchPoints().data(), hits.u[i], hits.v[i]);
            }
        }
    }

    const cc::Scene& _scene;
    const cc::Tracer& _tracer;
    const bool _anyHit;
    const HitValues _values;
    int _count = 0;
    cc::SharedGrids _grids;
    cc::RayPacket _packets[kPacketsInChunk];
    cc::HitPacket _hits[kPacketsInChunk];
    uint64_t _occluded[kPacketsInChunk];
    cc::Vec3f _sink;
};

/// What a white light at the origin of a ray makes of what it hits; black is what it misses.
float HeadLit(const cc::Scene& scene, const cc::RayPacket& rays, const cc::HitPacket& hits, int i) {
    if (hits.instance[i] == cc::kNoHit) {
        return 0;
    }
    const cc::Instance& instance = scene.Instances().Instances()[hits.instance[i]];
    const cc::LimitPoint limit =
        EvaluateLimit(cc::SurfaceOf(instance).Patches(), hits.patch[i],
                      cc::SurfaceOf(instance).PatchPoints().data(), hits.u[i], hits.v[i]);
    const cc::Vec3f direction{rays.directionX[i], rays.directionY[i], rays.directionZ[i]};
    const cc::Vec3f normal = Normalize(instance.worldToObject.NormalByInverse(limit.normal));
    return std::abs(Dot(normal, Normalize(direction)));
}

/// How far a hit is from the limit surface, measured along the normal there, divided by its depth.
float ErrorByDepth(const cc::Scene& scene, const cc::RayPacket& rays, const cc::HitPacket& hits,
                   int i) {
    if (hits.instance[i] == cc::kNoHit) {
        return 0;
    }
    const cc::Instance& instance = scene.Instances().Instances()[hits.instance[i]];
    const cc::Surface& surface = cc::SurfaceOf(instance);
    const cc::LimitPoint limit = cc::EvaluateLimit(
        surface.Patches(), hits.patch[i], surface.PatchPoints().data(), hits.u[i], hits.v[i]);
    const float t = rays.tMax[i];
    const cc::Vec3f hit{rays.originX[i] + t * rays.directionX[i],
                        rays.originY[i] + t * rays.directionY[i],
                        rays.originZ[i] + t * rays.directionZ[i]};
    const cc::Vec3f normal = Normalize(instance.worldToObject.NormalByInverse(limit.normal));
    return std::abs(Dot(hit - instance.objectToWorld.Point(limit.position), normal)) / t;
}

}  // namespace

void FillPacket(const Ray* rays, int count, cc::RayPacket* packet) {
    packet->count = count;
    for (int i = 0; i < count; ++i) {
        packet->originX[i] = rays[i].origin.x;
        packet->originY[i] = rays[i].origin.y;
        packet->originZ[i] = rays[i].origin.z;
        packet->directionX[i] = rays[i].direction.x;
        packet->directionY[i] = rays[i].direction.y;
        packet->directionZ[i] = rays[i].direction.z;
        packet->tMin[i] = rays[i].tMin;
        packet->tMax[i] = rays[i].tMax;
    }
}

TraceRun TraceRays(const cc::Scene& scene, const cc::Tracer& tracer, const RaySet& set, int threads,
                   HitValues values, cc::TraceStatistics* statistics) {
    std::vector<std::unique_ptr<Worker>> workers(threads);
    const auto makeWorker = [&](int thread) {
        workers[thread] = std::make_unique<Worker>(scene, tracer, set.anyHit, values);
        return workers[thread].get();
    };
    const TraceRun run = TraceInThreads(set, threads, makeWorker);
    for (const std::unique_ptr<Worker>& worker : workers) {
        *statistics += worker->statistics;
    }
    return run;
}

HitDifferences CompareHits(const cc::Scene& scene, const cc::Tracer& a, const cc::Tracer& b,
                           const RaySet& set, double pixels) {
    constexpr float kSameDistance = 1e-3f;
    HitDifferences found;
    cc::TraceStatistics statistics;
    cc::RayPacket rays[2];
    cc::HitPacket hits[2];
    const Ray* next = set.rays.data();
    for (const uint8_t count : set.packetSizes) {
        const cc::Tracer* tracers[2] = {&a, &b};
        for (int k = 0; k < 2; ++k) {
            FillPacket(next, count, &rays[k]);
            tracers[k]->Intersect(scene.Instances(), &rays[k], &hits[k], &statistics);
        }
        for (int i = 0; i < count; ++i) {
            found.picture +=
                std::abs(HeadLit(scene, rays[0], hits[0], i) - HeadLit(scene, rays[1], hits[1], i));
            const bool isHit = hits[0].instance[i] != cc::kNoHit;
            const float t = rays[0].tMax[i];
            if (isHit != (hits[1].instance[i] != cc::kNoHit)) {
                ++found.hits;
            } else if (isHit && std::abs(t - rays[1].tMax[i]) > kSameDistance * std::abs(t)) {
                ++found.distances;
            }
            found.error = std::max(found.error, pixels * ErrorByDepth(scene, rays[1], hits[1], i));
        }
        next += count;
    }
    found.picture /= static_cast<double>(std::max<size_t>(set.rays.size(), 1));
    return found;
}

cc::TracerKind TracerKindOfName(const std::string& name) {
    const auto found = kTracers.find(name);
    if (found == kTracers.end()) {
        throw std::runtime_error("unknown tracer '" + name + "'");
    }
    return found->second;
}
