#pragma once

#include "core/math/box.h"
#include "core/subdiv/patchTable.h"

namespace cc {

/// A box around a patch's limit surface, much tighter than that of its 1-ring: the bounds of its
/// parts after a subdivision step stand for the patch (paper, section 3.3).
/// @param points  one a patch point
Box3f LookAheadBounds(const PatchTable& patches, uint32_t patch, const Vec3f* points);

}  // namespace cc
