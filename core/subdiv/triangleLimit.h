#pragma once

#include <cstdint>

#include "core/subdiv/limitPoint.h"
#include "core/subdiv/patchTable.h"

namespace cc {

/// EvaluateLimit for a patch that IsTriangle, before normals are flipped.
LimitPoint EvaluateTriangle(const PatchTable& patches, uint32_t patch, const Vec3f* values, float u,
                            float v);

}  // namespace cc
