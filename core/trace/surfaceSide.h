#pragma once

#include "core/subdiv/limitPoint.h"
#include "core/trace/levelMetric.h"
#include "core/trace/surface.h"

namespace cc {

/// True if a ray hit the inner side of a surface: the one that the limit surface's normal points
/// away from.
/// @param limit   the surface at the hit
/// @param levels  that the tracer traced the patch with
bool IsInnerSide(const Surface& surface, const GeometryHit& hit, const LimitPoint& limit,
                 const PatchLevels& levels);

}  // namespace cc
