#include "tests/unit/subdiv/limitOracle.h"

#include <opensubdiv/bfr/surface.h>
#include <opensubdiv/far/topologyDescriptor.h>

namespace cc::test {

namespace Bfr = OpenSubdiv::Bfr;
namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;

LimitOracle::LimitOracle(ControlMesh mesh, std::vector<Vec3f> points) : _points(std::move(points)) {
    ValidateControlMesh(&mesh, _points.size());
    Far::TopologyDescriptor d;
    d.numVertices = static_cast<int>(_points.size());
    d.numFaces = mesh.FaceCount();
    d.numVertsPerFace = mesh.faceVertexCounts.data();
    d.vertIndicesPerFace = mesh.faceVertexIndices.data();
    d.numCreases = static_cast<int>(mesh.creaseSharpnesses.size());
    d.creaseVertexIndexPairs = mesh.creaseIndices.data();
    d.creaseWeights = mesh.creaseSharpnesses.data();
    d.numCorners = static_cast<int>(mesh.cornerIndices.size());
    d.cornerVertexIndices = mesh.cornerIndices.data();
    d.cornerWeights = mesh.cornerSharpnesses.data();
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
    using RefinerFactory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
    _refiner.reset(
        RefinerFactory::Create(d, RefinerFactory::Options(Sdc::SCHEME_CATMARK, options)));
    // Features are followed much deeper than by default: what we compare with must be exact.
    Factory::Options precise;
    precise.SetApproxLevelSmooth(8).SetApproxLevelSharp(10);
    _factory = std::make_unique<Factory>(*_refiner, precise);
}

LimitOracle::Sample LimitOracle::Evaluate(const FaceParameter& at) const {
    Sample sample;
    Bfr::Surface<float> surface;
    if (!_factory->InitVertexSurface(static_cast<int>(at.face), &surface)) {
        return sample;
    }
    std::vector<float> patchPoints(3 * surface.GetNumPatchPoints());
    surface.PreparePatchPoints(&_points[0].x, 3, patchPoints.data(), 3);
    float uv[2] = {at.u, at.v};
    const Bfr::Parameterization parameterization = surface.GetParameterization();
    if (parameterization.HasSubFaces()) {
        parameterization.ConvertNormalizedSubFaceToCoord(static_cast<int>(at.corner), uv, uv);
    }
    Vec3f du, dv;
    surface.Evaluate(uv, patchPoints.data(), 3, &sample.position.x, &du.x, &dv.x);
    sample.normal = Normalize(Cross(du, dv));
    sample.exists = true;
    return sample;
}

}  // namespace cc::test
