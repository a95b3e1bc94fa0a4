#include "core/trace/algorithm1Tracer.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/trace/algorithm1Tracer.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/trace/algorithm1-inl.h"
#include "core/trace/geometryTracing-inl.h"
#include "core/trace/instanceTraversal-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cc {
namespace HWY_NAMESPACE {

template <int kVectors, bool kAnyHit>
void TraceAlgorithm1(const InstanceBvh& instances, int level, ObjectRays* worldRays,
                     const RayPacket& world, HitPacket* hits, TextureHits* texture,
                     TraceStatistics* statistics) {
    TraceParts<ChildOrder::NearestFirst, TupleRays>(
        instances, world, worldRays, statistics,
        [&](uint32_t instance, TupleRays* rays, const TraversalStart& start) {
            if (instances.Instances()[instance].geometry->Kind() != GeometryKind::Surface) {
                return TraceGeometry<PacketRays, kAnyHit>(instances.Instances()[instance], instance,
                                                          start, rays, hits, statistics);
            }
            const Surface& surface = SurfaceOf(instances.Instances()[instance]);
            Algorithm1<kVectors, kAnyHit> algorithm(surface, instance, level, rays, hits, texture,
                                                    statistics);
            TraverseBvh<ChildOrder::NearestFirst>(
                surface.PrimitiveBvh(), start, rays, statistics,
                [&](uint32_t patch, uint64_t hitting, const Box3f&) {
                    algorithm.Intersect(patch, FirstOf(hitting));
                    return !algorithm.IsDone();
                },
                [](uint32_t) {});
            return !algorithm.IsDone();
        });
}

void IntersectTuples(const InstanceBvh& instances, int level, ObjectRays* worldRays,
                     const RayPacket& world, HitPacket* hits, TraceStatistics* statistics) {
    TraceAlgorithm1<1, false>(instances, level, worldRays, world, hits, nullptr, statistics);
}

void OccludeTuples(const InstanceBvh& instances, int level, ObjectRays* worldRays,
                   const RayPacket& world, TraceStatistics* statistics) {
    TraceAlgorithm1<1, true>(instances, level, worldRays, world, nullptr, nullptr, statistics);
}

void IntersectLongTuples(const InstanceBvh& instances, int level, ObjectRays* worldRays,
                         const RayPacket& world, HitPacket* hits, TextureHits* texture,
                         TraceStatistics* statistics) {
    TraceAlgorithm1<2, false>(instances, level, worldRays, world, hits, texture, statistics);
}

}  // namespace HWY_NAMESPACE
}  // namespace cc
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cc {
namespace {

HWY_EXPORT(IntersectTuples);
HWY_EXPORT(OccludeTuples);
HWY_EXPORT(IntersectLongTuples);

void DispatchIntersect(const InstanceBvh& instances, const LevelMetric& levels,
                       ObjectRays* worldRays, const RayPacket& world, HitPacket* hits, SharedGrids*,
                       TraceStatistics* statistics) {
    HWY_DYNAMIC_DISPATCH(IntersectTuples)(instances, levels.Finest(), worldRays, world, hits,
                                          statistics);
}

/// Any hit needs no texture coordinates (paper, section 3.2).
void DispatchOcclude(const InstanceBvh& instances, const LevelMetric& levels, ObjectRays* worldRays,
                     const RayPacket& world, SharedGrids*, TraceStatistics* statistics) {
    HWY_DYNAMIC_DISPATCH(OccludeTuples)(instances, levels.Finest(), worldRays, world, statistics);
}

void DispatchIntersectWithTexture(const InstanceBvh& instances, const LevelMetric& levels,
                                  ObjectRays* worldRays, const RayPacket& world, HitPacket* hits,
                                  SharedGrids*, TraceStatistics* statistics) {
    TextureHits texture;
    IntersectWithTexture(instances, levels.Finest(), worldRays, world, hits, &texture, statistics);
}

}  // namespace

PacketKernels Algorithm1Kernels() { return {DispatchIntersect, DispatchOcclude}; }

PacketKernels Algorithm1TextureKernels() { return {DispatchIntersectWithTexture, DispatchOcclude}; }

void IntersectWithTexture(const InstanceBvh& instances, int level, ObjectRays* worldRays,
                          const RayPacket& world, HitPacket* hits, TextureHits* texture,
                          TraceStatistics* statistics) {
    HWY_DYNAMIC_DISPATCH(IntersectLongTuples)
    (instances, level, worldRays, world, hits, texture, statistics);
}

}  // namespace cc
#endif  // HWY_ONCE
