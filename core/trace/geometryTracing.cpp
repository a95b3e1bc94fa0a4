#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/trace/geometryTracing.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/trace/curveIntersector-inl.h"
#include "core/trace/geometryTracing-inl.h"
#include "core/trace/sphereIntersector-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cc {
namespace HWY_NAMESPACE {

/// True if every ray is done, or was never there.
inline bool AreDone(const ObjectRays& rays) {
    for (int i = 0; i < rays.count; ++i) {
        if (!(rays.tMax[i] < rays.tMin[i])) {
            return false;
        }
    }
    return true;
}

/// @param intersector  of the geometry's kind: Intersect(primitive, hitting) returns true if a ray
///                     hits the primitive
template <class Rays, bool kAnyHit, class Intersector>
bool TracePrimitives(const Geometry& geometry, const TraversalStart& start, Rays* rays,
                     TraceStatistics* statistics, Intersector intersector) {
    constexpr ChildOrder kOrder = kAnyHit ? ChildOrder::Any : ChildOrder::NearestFirst;
    bool goesOn = true;
    TraverseBvh<kOrder>(
        geometry.PrimitiveBvh(), start, rays, statistics,
        [&](uint32_t primitive, uint64_t hitting, const Box3f&) {
            ++statistics->leafIntersections;
            if (intersector.Intersect(primitive, hitting)) {
                rays->Shortened();
                goesOn = !kAnyHit || !AreDone(rays->rays);
            }
            return goesOn;
        },
        [](uint32_t) {});
    return goesOn;
}

template <class Rays, bool kAnyHit>
bool TraceGeometry(const Instance& instance, uint32_t number, const TraversalStart& start,
                   Rays* rays, HitPacket* hits, TraceStatistics* statistics) {
    const Geometry& geometry = *instance.geometry;
    switch (geometry.Kind()) {
        case GeometryKind::Spheres:
            return TracePrimitives<Rays, kAnyHit>(
                geometry, start, rays, statistics,
                SphereIntersector<Rays, kAnyHit>(static_cast<const Spheres&>(geometry), number,
                                                 rays, hits));
        case GeometryKind::CurveSegments:
            return TracePrimitives<Rays, kAnyHit>(
                geometry, start, rays, statistics,
                CurveIntersector<Rays, kAnyHit>(static_cast<const CurveSegments&>(geometry), number,
                                                rays, hits));
        case GeometryKind::Surface: break;
    }
    return true;
}

template bool TraceGeometry<PacketRays, false>(const Instance&, uint32_t, const TraversalStart&,
                                               PacketRays*, HitPacket*, TraceStatistics*);
template bool TraceGeometry<PacketRays, true>(const Instance&, uint32_t, const TraversalStart&,
                                              PacketRays*, HitPacket*, TraceStatistics*);
template bool TraceGeometry<SingleRay, false>(const Instance&, uint32_t, const TraversalStart&,
                                              SingleRay*, HitPacket*, TraceStatistics*);
template bool TraceGeometry<SingleRay, true>(const Instance&, uint32_t, const TraversalStart&,
                                             SingleRay*, HitPacket*, TraceStatistics*);

}  // namespace HWY_NAMESPACE
}  // namespace cc
HWY_AFTER_NAMESPACE();
