#include "tests/unit/subdiv/oracleTopology.h"

#include <algorithm>

#include <opensubdiv/far/topologyDescriptor.h>

namespace cc::test {

namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;

namespace {

Sdc::Options::FVarLinearInterpolation ToSdc(FaceVaryingRule rule) {
    switch (rule) {
        case FaceVaryingRule::None: return Sdc::Options::FVAR_LINEAR_NONE;
        case FaceVaryingRule::CornersOnly: return Sdc::Options::FVAR_LINEAR_CORNERS_ONLY;
        case FaceVaryingRule::CornersPlus1: return Sdc::Options::FVAR_LINEAR_CORNERS_PLUS1;
        case FaceVaryingRule::CornersPlus2: return Sdc::Options::FVAR_LINEAR_CORNERS_PLUS2;
        case FaceVaryingRule::Boundaries: return Sdc::Options::FVAR_LINEAR_BOUNDARIES;
        case FaceVaryingRule::All: break;
    }
    return Sdc::Options::FVAR_LINEAR_ALL;
}

Sdc::Options OptionsOf(const ControlMesh& mesh) {
    Sdc::Options options;
    options.SetVtxBoundaryInterpolation(
        mesh.boundaryRule == BoundaryRule::None       ? Sdc::Options::VTX_BOUNDARY_NONE
        : mesh.boundaryRule == BoundaryRule::EdgeOnly ? Sdc::Options::VTX_BOUNDARY_EDGE_ONLY
                                                      : Sdc::Options::VTX_BOUNDARY_EDGE_AND_CORNER);
    options.SetFVarLinearInterpolation(ToSdc(mesh.faceVaryingRule));
    options.SetCreasingMethod(mesh.creaseRule == CreaseRule::Chaikin
                                  ? Sdc::Options::CREASE_CHAIKIN
                                  : Sdc::Options::CREASE_UNIFORM);
    options.SetTriangleSubdivision(mesh.triangleRule == TriangleRule::Smooth
                                       ? Sdc::Options::TRI_SUB_SMOOTH
                                       : Sdc::Options::TRI_SUB_CATMARK);
    return options;
}

Sdc::SchemeType ToSdc(Scheme scheme) {
    return scheme == Scheme::Loop       ? Sdc::SCHEME_LOOP
           : scheme == Scheme::Bilinear ? Sdc::SCHEME_BILINEAR
                                        : Sdc::SCHEME_CATMARK;
}

}  // namespace

OracleTopology::OracleTopology(ControlMesh mesh, size_t pointCount, const ValueTopology& values) {
    ValidateControlMesh(&mesh, pointCount);
    std::vector<int> counts, indices, valueIndices;
    size_t first = 0;
    for (int count : mesh.faceVertexCounts) {
        KeptFace kept{-1, KeptCorners(&mesh.faceVertexIndices[first], count)};
        if (!kept.corners.empty()) {
            kept.index = static_cast<int>(counts.size());
            counts.push_back(static_cast<int>(kept.corners.size()));
        }
        for (int corner : kept.corners) {
            indices.push_back(mesh.faceVertexIndices[first + corner]);
            if (!values.indices.empty()) {
                valueIndices.push_back(values.indices[first + corner]);
            }
        }
        _faces.push_back(kept);
        first += count;
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
    Far::TopologyDescriptor::FVarChannel channel;
    channel.numValues = values.valueCount;
    channel.valueIndices = valueIndices.data();
    d.numFVarChannels = valueIndices.empty() ? 0 : 1;
    d.fvarChannels = &channel;
    using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
    _refiner.reset(Factory::Create(d, Factory::Options(ToSdc(mesh.scheme), OptionsOf(mesh))));
}

int OracleTopology::Corner(uint32_t face, uint32_t corner) const {
    const std::vector<int>& kept = _faces[face].corners;
    const auto at = std::find(kept.begin(), kept.end(), static_cast<int>(corner));
    return static_cast<int>(at - kept.begin());
}

}  // namespace cc::test
