#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/subdiv/controlMesh.h"

namespace cc {

/// A face-varying primvar's topology as a mesh of its own: it has a vertex for each value that
/// meets at a vertex of the cage, and is cut open where values split. Its limit surface, over
/// values in place of points, is the primvar as OpenSubdiv defines it.
struct FaceVaryingMesh {
    /// Faces are those of the cage, with the same numbers and corners. Tags are validated.
    ControlMesh mesh;
    /// Which value each vertex of the mesh has.
    std::vector<int> values;
    /// Why there is no mesh; empty if there is one.
    std::string error;
};

/// True if a face-varying primvar is bilinear over each authored face, or linear over a triangle of
/// the Loop scheme, so that it needs no mesh.
/// @param isIndexed  false if no two face-vertices share a value
bool IsFaceVaryingBilinear(const ControlMesh& mesh, bool isIndexed);

/// Cuts a cage open where face-varying values split, and sharpens corners by its faceVaryingRule.
/// @param mesh          must have passed ValidateControlMesh
/// @param valueIndices  the value of each face-vertex; equal indices at a vertex are one value
FaceVaryingMesh MakeFaceVaryingMesh(const ControlMesh& mesh, size_t pointCount,
                                    const std::vector<int>& valueIndices);

}  // namespace cc
