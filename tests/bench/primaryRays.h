#pragma once

#include <vector>

#include "core/scene/camera.h"
#include "core/scene/scene.h"
#include "core/trace/traceStatistics.h"
#include "core/trace/tracer.h"

/// What tracing all primary rays of a picture once took.
struct PrimaryRun {
    /// Seconds inside the tracer, added up over threads, divided by their number.
    double seconds = 0;
    uint64_t rays = 0, hits = 0;
    cc::TraceStatistics statistics;
};

/// Traces a ray through the centre of each pixel, in packets of 8x8 pixels.
PrimaryRun TracePrimaryRays(const cc::Scene& scene, const cc::Camera& camera,
                            const cc::Tracer& tracer, int width, int height, int threads);
