#pragma once

#include <string>

#include "core/scene/scene.h"
#include "core/trace/traceStatistics.h"
#include "core/trace/tracer.h"
#include "rays.h"

/// Lays up to 64 rays out as tracers take them.
void FillPacket(const Ray* rays, int count, cc::RayPacket* packet);

/// What is worked out besides the nearest hit.
enum class HitValues {
    None,
    /// A value that varies over the surface as texture coordinates do, at every hit.
    TextureCoordinates,
};

/// Traces a set of rays; adds up what packets did.
TraceRun TraceRays(const cc::Scene& scene, const cc::Tracer& tracer, const RaySet& set, int threads,
                   HitValues values, cc::TraceStatistics* statistics);

/// How two tracers' nearest hits of the same rays differ.
struct HitDifferences {
    /// Rays that only one of them has hit.
    uint64_t hits = 0;
    /// Rays that both have hit, at distances that differ by more than a thousandth.
    uint64_t distances = 0;
    /// The mean difference of their pictures, a pixel a ray, lit by a white light at the eye.
    double picture = 0;
    /// The furthest that a hit of the second is from the limit surface, in pixels of the picture.
    double error = 0;
};
/// @param set     camera rays whose distances are depths
/// @param pixels  that a unit covers at depth 1
HitDifferences CompareHits(const cc::Scene& scene, const cc::Tracer& a, const cc::Tracer& b,
                           const RaySet& set, double pixels);

/// The kind that a name such as packet means. Throws std::runtime_error for a name that is none.
cc::TracerKind TracerKindOfName(const std::string& name);
