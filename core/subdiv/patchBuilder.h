#pragma once

#include <string>
#include <vector>

#include "core/subdiv/controlMesh.h"
#include "core/subdiv/patchTable.h"

namespace cc {

/// Converts the visible faces of a control mesh to patches.
///
/// A quad among quads becomes one patch of the cage itself: a B-spline where its 1-ring is regular,
/// a patch with one extraordinary vertex, or an irregular patch that keeps valences, creases and
/// corners as they are. Other faces are refined first, with their neighbours, by OpenSubdiv. Under
/// Loop's scheme every triangle becomes one patch of the cage, a box spline or irregular.
/// Holes shape their neighbours and give no patch.
///
/// @param mesh   must have passed ValidateControlMesh
/// @param error  set to the reason if the topology cannot be used; the table is empty then
PatchTable BuildPatchTable(const ControlMesh& mesh, size_t pointCount, std::string* error);

/// Cuts the polygons of a table of scheme none into the triangles that their points ask for
/// (TriangulatePolygon); other tables stay as they are. Until then polygons are fans around their
/// first corner. Patches keep their numbers: as many belong to each polygon as before.
/// @param points  those of the cage, finite
void CutPolygons(const std::vector<Vec3f>& points, PatchTable* table);

}  // namespace cc
