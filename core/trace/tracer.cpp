#include "core/trace/tracer.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/trace/tracer.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/trace/algorithm1Tracer.h"
#include "core/trace/geometryTracing-inl.h"
#include "core/trace/instanceTraversal-inl.h"
#include "core/trace/packetKernels.h"
#include "core/trace/patchIntersector-inl.h"
#include "core/trace/tessellatedTracer.h"

HWY_BEFORE_NAMESPACE();
namespace cc {
namespace HWY_NAMESPACE {

/// Traces rays that are in world space already through the patches of all instances.
template <class Rays, bool kAnyHit>
void TracePatches(const InstanceBvh& instances, const LevelMetric& levels, const RayPacket& world,
                  ObjectRays* worldRays, HitPacket* hits, SharedGrids* grids,
                  TraceStatistics* statistics) {
    constexpr ChildOrder kOrder = kAnyHit ? ChildOrder::Any : ChildOrder::NearestFirst;
    TraceParts<kOrder, Rays>(
        instances, world, worldRays, statistics,
        [&](uint32_t instance, Rays* rays, const TraversalStart& start) {
            if (instances.Instances()[instance].geometry->Kind() != GeometryKind::Surface) {
                return TraceGeometry<Rays, kAnyHit>(instances.Instances()[instance], instance,
                                                    start, rays, hits, statistics);
            }
            const Surface& surface = SurfaceOf(instances.Instances()[instance]);
            PatchIntersector<Rays, kAnyHit> intersector(instances.Instances()[instance], instance,
                                                        levels, rays, hits, grids, statistics);
            TraverseBvh<kOrder>(
                surface.PrimitiveBvh(), start, rays, statistics,
                [&](uint32_t patch, uint64_t hitting, const Box3f& box) {
                    intersector.Intersect(patch, hitting, box);
                    return !intersector.IsDone();
                },
                [&](uint32_t patch)
                    __attribute__((always_inline)) { surface.Patches().Prefetch(patch); });
            return !intersector.IsDone();
        });
}

void IntersectPacket(const InstanceBvh& instances, const LevelMetric& levels, ObjectRays* worldRays,
                     const RayPacket& world, HitPacket* hits, SharedGrids* grids,
                     TraceStatistics* statistics) {
    TracePatches<PacketRays, false>(instances, levels, world, worldRays, hits, grids, statistics);
}

void OccludePacket(const InstanceBvh& instances, const LevelMetric& levels, ObjectRays* worldRays,
                   const RayPacket& world, SharedGrids* grids, TraceStatistics* statistics) {
    TracePatches<PacketRays, true>(instances, levels, world, worldRays, nullptr, grids, statistics);
}

void IntersectSingle(const InstanceBvh& instances, const LevelMetric& levels, ObjectRays* worldRays,
                     const RayPacket& world, HitPacket* hits, SharedGrids* grids,
                     TraceStatistics* statistics) {
    TracePatches<SingleRay, false>(instances, levels, world, worldRays, hits, grids, statistics);
}

void OccludeSingle(const InstanceBvh& instances, const LevelMetric& levels, ObjectRays* worldRays,
                   const RayPacket& world, SharedGrids* grids, TraceStatistics* statistics) {
    TracePatches<SingleRay, true>(instances, levels, world, worldRays, nullptr, grids, statistics);
}

}  // namespace HWY_NAMESPACE
}  // namespace cc
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cc {
namespace {

HWY_EXPORT(IntersectPacket);
HWY_EXPORT(OccludePacket);
HWY_EXPORT(IntersectSingle);
HWY_EXPORT(OccludeSingle);

void DispatchIntersect(const InstanceBvh& instances, const LevelMetric& levels,
                       ObjectRays* worldRays, const RayPacket& world, HitPacket* hits,
                       SharedGrids* grids, TraceStatistics* statistics) {
    HWY_DYNAMIC_DISPATCH(IntersectPacket)(instances, levels, worldRays, world, hits, grids,
                                          statistics);
}

void DispatchOcclude(const InstanceBvh& instances, const LevelMetric& levels, ObjectRays* worldRays,
                     const RayPacket& world, SharedGrids* grids, TraceStatistics* statistics) {
    HWY_DYNAMIC_DISPATCH(OccludePacket)(instances, levels, worldRays, world, grids, statistics);
}

void Clear(int count, HitPacket* hits) {
    for (int i = 0; i < count; ++i) {
        hits->instance[i] = hits->patch[i] = kNoHit;
        hits->u[i] = hits->v[i] = 0;
    }
}

/// Traces whole packets: one subdivision of a patch serves up to 64 rays.
class PacketTracer final : public Tracer {
  public:
    PacketTracer(const PacketKernels& kernels, const LevelMetric& levels)
        : _kernels(kernels), _levels(levels) {}

    void Intersect(const InstanceBvh& instances, RayPacket* rays, HitPacket* hits,
                   TraceStatistics* statistics, SharedGrids* grids) const override {
        ++statistics->packets;
        statistics->rays += rays->count;
        Clear(kPacketSize, hits);
        ObjectRays world;
        TransformRays(*rays, AffineTransform(), &world);
        _kernels.intersect(instances, _levels, &world, *rays, hits, grids, statistics);
        std::copy(world.tMax, world.tMax + rays->count, rays->tMax);
    }

    uint64_t Occluded(const InstanceBvh& instances, const RayPacket& rays,
                      TraceStatistics* statistics, SharedGrids* grids) const override {
        ++statistics->packets;
        statistics->rays += rays.count;
        ObjectRays world;
        TransformRays(rays, AffineTransform(), &world);
        _kernels.occlude(instances, _levels, &world, rays, grids, statistics);
        uint64_t occluded = 0;
        for (int i = 0; i < rays.count; ++i) {
            const bool wasActive = rays.tMin[i] <= rays.tMax[i];
            occluded |= uint64_t(wasActive && world.tMax[i] < world.tMin[i]) << i;
        }
        return occluded;
    }

  private:
    const PacketKernels _kernels;
    const LevelMetric _levels;
};

/// Traces one ray at a time with the same kernels: what packets are measured against.
class SingleTracer final : public Tracer {
  public:
    explicit SingleTracer(const LevelMetric& levels) : _levels(levels) {}

    void Intersect(const InstanceBvh& instances, RayPacket* rays, HitPacket* hits,
                   TraceStatistics* statistics, SharedGrids* grids) const override {
        Clear(kPacketSize, hits);
        for (int i = 0; i < rays->count; ++i) {
            const RayPacket one = _Extract(*rays, i, statistics);
            ObjectRays world;
            TransformRays(one, AffineTransform(), &world);
            HitPacket hit;
            Clear(1, &hit);
            HWY_DYNAMIC_DISPATCH(IntersectSingle)
            (instances, _levels, &world, one, &hit, grids, statistics);
            rays->tMax[i] = world.tMax[0];
            hits->instance[i] = hit.instance[0];
            hits->patch[i] = hit.patch[0];
            hits->u[i] = hit.u[0];
            hits->v[i] = hit.v[0];
        }
    }

    uint64_t Occluded(const InstanceBvh& instances, const RayPacket& rays,
                      TraceStatistics* statistics, SharedGrids* grids) const override {
        uint64_t occluded = 0;
        for (int i = 0; i < rays.count; ++i) {
            if (rays.tMax[i] < rays.tMin[i]) {
                continue;
            }
            const RayPacket one = _Extract(rays, i, statistics);
            ObjectRays world;
            TransformRays(one, AffineTransform(), &world);
            HWY_DYNAMIC_DISPATCH(OccludeSingle)(instances, _levels, &world, one, grids, statistics);
            occluded |= uint64_t(world.tMax[0] < world.tMin[0]) << i;
        }
        return occluded;
    }

  private:
    static RayPacket _Extract(const RayPacket& rays, int i, TraceStatistics* statistics) {
        ++statistics->packets;
        ++statistics->rays;
        RayPacket one;
        one.originX[0] = rays.originX[i];
        one.originY[0] = rays.originY[i];
        one.originZ[0] = rays.originZ[i];
        one.directionX[0] = rays.directionX[i];
        one.directionY[0] = rays.directionY[i];
        one.directionZ[0] = rays.directionZ[i];
        one.tMin[0] = rays.tMin[i];
        one.tMax[0] = rays.tMax[i];
        one.count = 1;
        return one;
    }

    const LevelMetric _levels;
};

}  // namespace

Tracer::~Tracer() = default;

std::unique_ptr<Tracer> MakePacketTracer(const PacketKernels& kernels, const LevelMetric& levels) {
    return std::make_unique<PacketTracer>(kernels, levels);
}

std::unique_ptr<Tracer> MakeTracer(TracerKind kind, const LevelMetric& levels) {
    switch (kind) {
        case TracerKind::Packet: break;
        case TracerKind::Algorithm1: return MakePacketTracer(Algorithm1Kernels(), levels);
        case TracerKind::Algorithm1WithTexture:
            return MakePacketTracer(Algorithm1TextureKernels(), levels);
        case TracerKind::Single: return std::make_unique<SingleTracer>(levels);
        case TracerKind::Tessellated: return MakePacketTracer(TessellatedKernels(), levels);
    }
    return MakePacketTracer({DispatchIntersect, DispatchOcclude}, levels);
}

}  // namespace cc
#endif  // HWY_ONCE
