#pragma once

#include "core/trace/objectRays.h"
#include "core/trace/surface.h"

namespace cc {

/// True if all rays of a packet start outside a surface's bounds, where no quad of any level is:
/// such rays may see it coarser than others do. It is closed for each of them, and they are on the
/// same side of it at all levels: none slips through, and none starts beneath quads that it should
/// leave.
///
/// Rays that are done count too, so that all parts of a surface get the same answer.
bool IsRemote(const Surface& surface, const ObjectRays& rays);

}  // namespace cc
