#pragma once

#include <string>
#include <vector>

#include "core/math/vec.h"

namespace cc {

/// Rule by which a control mesh becomes a surface (UsdGeomMesh subdivisionScheme).
enum class Scheme { CatmullClark, Bilinear, None, Loop };

/// What happens at the open boundary (UsdGeomMesh interpolateBoundary).
enum class BoundaryRule { None, EdgeOnly, EdgeAndCorner };

/// How sharpness decays along a crease (Hydra crease method).
enum class CreaseRule { Uniform, Chaikin };

/// Weights at triangles under Catmull-Clark (UsdGeomMesh triangleSubdivisionRule).
enum class TriangleRule { CatmullClark, Smooth };

/// Where face-varying values are sharp (UsdGeomMesh faceVaryingLinearInterpolation).
enum class FaceVaryingRule { None, CornersOnly, CornersPlus1, CornersPlus2, Boundaries, All };

/// The control cage without its points: faces and the tags that shape the surface.
/// Arrays have the meaning and layout of the UsdGeomMesh attributes of the same name.
struct ControlMesh {
    Scheme scheme = Scheme::CatmullClark;
    BoundaryRule boundaryRule = BoundaryRule::EdgeAndCorner;
    CreaseRule creaseRule = CreaseRule::Uniform;
    TriangleRule triangleRule = TriangleRule::CatmullClark;
    FaceVaryingRule faceVaryingRule = FaceVaryingRule::CornersPlus1;
    bool leftHanded = false;

    std::vector<int> faceVertexCounts;
    std::vector<int> faceVertexIndices;
    std::vector<int> holeIndices;

    std::vector<int> creaseIndices;
    std::vector<int> creaseLengths;
    /// One a crease or one an edge of every crease; 10 and above is infinitely sharp.
    std::vector<float> creaseSharpnesses;
    std::vector<int> cornerIndices;
    std::vector<float> cornerSharpnesses;

    /// Of a FaceVaryingMesh under Chaikin's rule: vertices, and for each the sharpness of a
    /// semi-sharp edge that is not the mesh's but decays with the vertex's own (RingTags).
    std::vector<int> seamIndices;
    std::vector<float> seamSharpnesses;

    int FaceCount() const { return static_cast<int>(faceVertexCounts.size()); }
};

/// Corners of a face, and faces of a vertex, up to which a smooth mesh is accepted: beyond that,
/// the time to connect them is out of proportion. Polygons and bilinear faces have no limit.
constexpr int kMaxValence = 16384;
/// The same under the Loop scheme, where each face of a vertex reads all others.
constexpr int kMaxLoopValence = 4096;

/// What Validate found: an error makes the mesh unusable, a warning names what was mended.
struct ControlMeshReport {
    std::string error;
    std::vector<std::string> warnings;

    bool IsValid() const { return error.empty(); }
};

/// Checks the topology and the tags against a number of points, and mends what can be mended:
/// tags that name no vertex, edge or face of the mesh are dropped, sharpness is clamped to
/// [0, 10] and repeated holes are merged. Faces that KeptCorners gives nothing for are left out,
/// under scheme none only those of fewer than three vertices.
/// Creases are rewritten as runs of two vertices with one sharpness each.
/// Valences above kMaxValence cannot be used. Counts that do not add up and indices out of range
/// cannot be mended, nor can faces of more than three vertices under the Loop scheme.
ControlMeshReport ValidateControlMesh(ControlMesh* mesh, size_t pointCount);

/// The corners of a face that are left when neighbouring corners that share a vertex are merged:
/// a quad with a collapsed edge is a triangle. Empty if that leaves fewer than three, or if the
/// face still meets a vertex twice: it has no inside then.
std::vector<int> KeptCorners(const int* vertices, int count);

/// True if KeptCorners gives all corners of a face, as it does of most.
bool KeepsAllCorners(const int* vertices, int count);

}  // namespace cc
