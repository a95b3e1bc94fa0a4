#pragma once

#include <vector>

#include "core/math/box.h"
#include "core/subdiv/limitGridPlan.h"
#include "core/subdiv/patchTable.h"

namespace cc {

/// Boxes around the limit surfaces of all patches, much tighter than those of their 1-rings: the
/// bounds of a patch's parts after a subdivision step stand for it (paper, section 3.3). Made in
/// parallel; each box depends on its patch alone. Whatever moves the surface that rays hit away
/// from the limit has to widen the boxes here.
/// @param plans   of these patches; without them irregular patches take longer
/// @param points  one a patch point
std::vector<Box3f> LookAheadBounds(const PatchTable& patches, const LimitGridPlans& plans,
                                   const Vec3f* points);

}  // namespace cc
