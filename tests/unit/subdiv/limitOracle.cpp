#include "tests/unit/subdiv/limitOracle.h"

#include <algorithm>
#include <cmath>

#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/topologyDescriptor.h>

namespace cc::test {

namespace Bfr = OpenSubdiv::Bfr;
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

/// A point that Far's masks act on.
struct MaskPoint {
    double x = 0, y = 0, z = 0;
    void Clear() { x = y = z = 0; }
    void AddWithWeight(const MaskPoint& p, float weight) {
        x += weight * p.x;
        y += weight * p.y;
        z += weight * p.z;
    }
};

/// The unit vector along a x b; zero if what is left of it is rounding.
Vec3f NormalOf(const double a[3], const double b[3]) {
    const double n[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                         a[0] * b[1] - a[1] * b[0]};
    const double length = std::hypot(n[0], n[1], n[2]);
    const double longer = std::max(std::hypot(a[0], a[1], a[2]), std::hypot(b[0], b[1], b[2]));
    if (!(length > 1e-5 * longer * longer)) {
        return {};
    }
    return {static_cast<float>(n[0] / length), static_cast<float>(n[1] / length),
            static_cast<float>(n[2] / length)};
}

}  // namespace

LimitOracle::LimitOracle(ControlMesh mesh, const std::vector<Vec3f>& points, Precision precision) {
    for (const Vec3f& p : points) {
        _points.insert(_points.end(), {p.x, p.y, p.z});
    }
    ValidateControlMesh(&mesh, points.size());
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
    d.numVertices = static_cast<int>(points.size());
    d.numFaces = static_cast<int>(counts.size());
    d.numVertsPerFace = counts.data();
    d.vertIndicesPerFace = indices.data();
    d.numCreases = static_cast<int>(mesh.creaseSharpnesses.size());
    d.creaseVertexIndexPairs = mesh.creaseIndices.data();
    d.creaseWeights = mesh.creaseSharpnesses.data();
    d.numCorners = static_cast<int>(mesh.cornerIndices.size());
    d.cornerVertexIndices = mesh.cornerIndices.data();
    d.cornerWeights = mesh.cornerSharpnesses.data();
    using RefinerFactory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
    _refiner.reset(RefinerFactory::Create(
        d, RefinerFactory::Options(
               mesh.scheme == Scheme::Loop ? Sdc::SCHEME_LOOP : Sdc::SCHEME_CATMARK,
               OptionsOf(mesh))));
    if (_refiner) {
        // Features are followed much deeper than by default, as deep as Bfr bears (at 11 it
        // crashes): what we compare with must be exact.
        Factory::Options precise;
        precise.SetApproxLevelSmooth(precision == Precision::Fine ? 10 : 5);
        precise.SetApproxLevelSharp(precision == Precision::Fine ? 10 : 5);
        _factory = std::make_unique<Factory>(*_refiner, precise);
    }
}

bool LimitOracle::_SelectFace(uint32_t face) {
    const int index = _faces[face].index;
    if (index < 0 || !_factory) {
        return false;
    }
    if (_selected != index) {
        if (!_factory->InitVertexSurface(index, &_surface)) {
            _selected = -1;
            return false;
        }
        _selected = index;
        _patchPoints.resize(3 * static_cast<size_t>(_surface.GetNumPatchPoints()));
        _surface.PreparePatchPoints(_points.data(), 3, _patchPoints.data(), 3);
    }
    return true;
}

bool LimitOracle::HasFace(uint32_t face) { return _SelectFace(face); }

LimitOracle::Sample LimitOracle::Evaluate(const FaceParameter& at) {
    Sample sample;
    if (!_SelectFace(at.face)) {
        return sample;
    }
    double uv[2] = {at.u, at.v};
    const Bfr::Parameterization parameterization = _surface.GetParameterization();
    if (parameterization.HasSubFaces()) {
        const std::vector<int>& kept = _faces[at.face].corners;
        const auto corner = std::find(kept.begin(), kept.end(), static_cast<int>(at.corner));
        parameterization.ConvertNormalizedSubFaceToCoord(static_cast<int>(corner - kept.begin()),
                                                         uv, uv);
    }
    double p[3], du[3], dv[3];
    _surface.Evaluate(uv, _patchPoints.data(), 3, p, du, dv);
    sample.position = {static_cast<float>(p[0]), static_cast<float>(p[1]),
                       static_cast<float>(p[2])};
    sample.normal = NormalOf(du, dv);
    sample.exists = true;
    return sample;
}

std::vector<Vec3f> LimitOracle::RefinedLimits(int levels) {
    _factory.reset();
    _selected = -1;
    Far::TopologyRefiner::UniformOptions uniform(levels);
    uniform.fullTopologyInLastLevel = true;
    _refiner->RefineUniform(uniform);
    const Far::PrimvarRefiner primvars(*_refiner);
    std::vector<MaskPoint> points;
    for (size_t i = 0; i < _points.size(); i += 3) {
        points.push_back({_points[i], _points[i + 1], _points[i + 2]});
    }
    for (int level = 1; level <= levels; ++level) {
        std::vector<MaskPoint> finer(_refiner->GetLevel(level).GetNumVertices());
        primvars.Interpolate(level, points, finer);
        points = std::move(finer);
    }
    std::vector<MaskPoint> limits(points.size());
    primvars.Limit(points, limits);
    std::vector<Vec3f> result;
    for (const MaskPoint& p : limits) {
        result.push_back(
            {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
    }
    return result;
}

}  // namespace cc::test
