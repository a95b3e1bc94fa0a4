#pragma once

#include <string>

#include "core/subdiv/controlMesh.h"
#include "core/subdiv/patchTable.h"

namespace cc {

/// Converts the visible faces of a control mesh to patches.
///
/// A face with a regular 1-ring, or with one extraordinary vertex and otherwise regular, becomes
/// one patch of the cage itself. Any other face is refined, with its neighbours, until its parts
/// are such faces; sharp features that no patch has are isolated to a fixed depth and end as
/// bilinear quads between limit positions. Holes and faces without visible children shape their
/// neighbours and give no patch.
///
/// @param mesh   must have passed ValidateControlMesh
/// @param error  set to the reason if the topology cannot be used; the table is empty then
PatchTable BuildPatchTable(const ControlMesh& mesh, size_t pointCount, std::string* error);

}  // namespace cc
