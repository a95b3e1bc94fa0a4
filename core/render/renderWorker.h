#pragma once

#include "core/render/renderer.h"
#include "core/trace/sharedGrids.h"

namespace cc {

/// What one thread of a render has to itself.
struct RenderWorker {
    RenderStatistics statistics;
    SharedGrids grids;
};

}  // namespace cc
