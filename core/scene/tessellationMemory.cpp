#include "core/scene/tessellationMemory.h"

#include <algorithm>
#include <cstdio>

#include <tbb/task_arena.h>

#include "core/scene/availableMemory.h"

namespace cc {
namespace {

/// Of what is available, for tessellations: the picture and all else need some.
constexpr double kTessellationShare = 0.9;

std::string Gigabytes(double bytes) {
    char text[32];
    std::snprintf(text, sizeof(text), "%.1f GB", bytes * 1e-9);
    return text;
}

}  // namespace

std::string WhyNotTessellate(const std::vector<Surface*>& surfaces, int level) {
    const std::string line = "the scene is not tessellated at level " + std::to_string(level);
    double kept = 0, scratch = 0, mostScratch = 0;
    for (const Surface* surface : surfaces) {
        if (surface->TessellationBytes() > 0) {
            continue;
        }
        const Tessellation::Need need = Tessellation::NeedOf(surface->Patches(), level);
        if (!need.isPossible) {
            return line + ", as a mesh would have too many quads";
        }
        kept += static_cast<double>(need.kept);
        scratch += static_cast<double>(need.whileMade);
        mostScratch = std::max(mostScratch, static_cast<double>(need.whileMade));
    }
    // Each thread is at work on one surface.
    const double needed =
        kept + std::min(scratch, mostScratch * tbb::this_task_arena::max_concurrency());
    const auto available = static_cast<double>(AvailableMemory());
    if (needed <= kTessellationShare * available) {
        return {};
    }
    return line + ", which takes " + Gigabytes(needed) + " of memory while " +
           Gigabytes(available) + " are available";
}

}  // namespace cc
