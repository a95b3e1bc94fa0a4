#pragma once

#include "core/render/renderWorker.h"
#include "core/render/shadingPoint.h"

namespace cc {

/// Adds the light that points of a diffuse surface send to the viewer: albedo / pi times the
/// irradiance of all lights, with hard shadows. What the raycast integrator shades with.
/// @param points    at most kPacketSize
/// @param radiance  one a point, added to
void AddDirectLight(const Scene& scene, const Tracer& tracer, const ShadingPoint* points, int count,
                    Vec3f* radiance, RenderWorker* worker);

}  // namespace cc
