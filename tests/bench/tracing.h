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

/// The kind that a name such as packet means. Throws std::runtime_error for a name that is none.
cc::TracerKind TracerKindOfName(const std::string& name);
