#pragma once

#include <string>

#include "core/subdiv/controlMesh.h"
#include "core/subdiv/patchTable.h"

namespace cc {

/// Adds a patch of the cage itself for every visible face of a mesh under Loop's scheme: a box
/// spline where the 1-ring is regular, else a triangle with the rings of its corners.
///
/// @param mesh   must have passed ValidateControlMesh
/// @param error  set to the reason if the topology cannot be used
void AddLoop(const ControlMesh& mesh, size_t pointCount, PatchTable* table, std::string* error);

}  // namespace cc
