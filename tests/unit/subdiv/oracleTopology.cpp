#include "tests/unit/subdiv/oracleTopology.h"

#include <algorithm>

#include <opensubdiv/far/topologyDescriptor.h>

namespace cc::test {

namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;

namespace {

Sdc::Options OptionsOf(const ControlMesh& mesh) {
    Sdc::Options options;
    options.SetVtxBoundaryInterpolation(
        mesh.boundaryRule == BoundaryRule::None       ? Sdc::Options::VTX_BOUNDARY_NONE
        : mesh.boundaryRule == BoundaryRule::EdgeOnly ? Sdc::Options::VTX_BOUNDARY_EDGE_ONLY
                                                      : Sdc::Options::VTX_BOUNDARY_EDGE_AND_CORNER);
    options.SetCreasingMethod(mesh.creaseRule == CreaseRule::Chaikin
                                  ? Sdc::Options::CREASE_CHAIKIN
                                  : Sdc::Options::CREASE_UNIFORM);
    options.SetTriangleSubdivision(mesh.triangleRule == TriangleRule::Smooth
                                       ? Sdc::Options::TRI_SUB_SMOOTH
                                       : Sdc::Options::TRI_SUB_CATMARK);
    return options;
}

}  // namespace

OracleTopology::OracleTopology(ControlMesh mesh, size_t pointCount) {
    ValidateControlMesh(&mesh, pointCount);
    std::vector<int> counts, indices;
    const int* face = mesh.faceVertexIndices.data();
    for (int count : mesh.faceVertexCounts) {
        KeptFace kept{-1, KeptCorners(face, count)};
        if (!kept.corners.empty()) {
            kept.index = static_cast<int>(counts.size());
            counts.push_back(static_cast<int>(kept.corners.size()));
            for (int corner : kept.corners) {
                indices.push_back(face[corner]);
            }
        }
        _faces.push_back(kept);
        face += count;
    }
    Far::TopologyDescriptor d;
    d.numVertices = static_cast<int>(pointCount);
    d.numFaces = static_cast<int>(counts.size());
    d.numVertsPerFace = counts.data();
    d.vertIndicesPerFace = indices.data();
    d.numCreases = static_cast<int>(mesh.creaseSharpnesses.size());
    d.creaseVertexIndexPairs = mesh.creaseIndices.data();
    d.creaseWeights = mesh.creaseSharpnesses.data();
    d.numCorners = static_cast<int>(mesh.cornerIndices.size());
    d.cornerVertexIndices = mesh.cornerIndices.data();
    d.cornerWeights = mesh.cornerSharpnesses.data();
    using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
    const Sdc::SchemeType scheme =
        mesh.scheme == Scheme::Loop ? Sdc::SCHEME_LOOP : Sdc::SCHEME_CATMARK;
    _refiner.reset(Factory::Create(d, Factory::Options(scheme, OptionsOf(mesh))));
}

int OracleTopology::Corner(uint32_t face, uint32_t corner) const {
    const std::vector<int>& kept = _faces[face].corners;
    const auto at = std::find(kept.begin(), kept.end(), static_cast<int>(corner));
    return static_cast<int>(at - kept.begin());
}

}  // namespace cc::test
