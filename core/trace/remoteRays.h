#pragma once

#include "core/trace/objectRays.h"
#include "core/trace/surface.h"

namespace cc {

/// True if no ray of a packet starts in or beside a surface: all start further from its bounds than
/// its quads can be from the limit surface, at any level. Such rays may see it coarser than others
/// do. It is closed for each of them, and they start on the same side of it at all levels: none
/// slips through, and none starts beneath the quads that it should leave.
///
/// Rays that are done count too, so that all parts of a surface get the same answer.
bool IsRemote(const Surface& surface, const ObjectRays& rays);

}  // namespace cc
