#pragma once

#include <string>
#include <vector>

#include "core/trace/surface.h"

namespace cc {

/// Empty if memory holds the tessellations of all surfaces at a level, 0..8, else one line that
/// says what is in the way. Surfaces that have one already need no more.
std::string WhyNotTessellate(const std::vector<Surface*>& surfaces, int level);

}  // namespace cc
