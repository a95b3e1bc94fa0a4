#include <opensubdiv/bfr/refinerSurfaceFactory.h>
#include <opensubdiv/bfr/surface.h>

#include "tests/unit/subdiv/limitOracle.h"
#include "tests/unit/subdiv/oracleTopology.h"

namespace cc::test {
namespace {

namespace Bfr = OpenSubdiv::Bfr;

class BfrOracle : public LimitOracle {
  public:
    BfrOracle(const ControlMesh& mesh, const std::vector<Vec3f>& points,
              const std::vector<Vec3f>& values)
        : _topology(mesh, points.size()) {
        for (size_t i = 0; i < points.size(); ++i) {
            const Vec3f &p = points[i], &q = values[i];
            _points.insert(_points.end(), {p.x, p.y, p.z, q.x, q.y, q.z});
        }
        if (_topology.Refiner() != nullptr) {
            // Much deeper than by default, as deep as Bfr bears (at 11 it crashes).
            Factory::Options precise;
            precise.SetApproxLevelSmooth(kOracleLevels);
            precise.SetApproxLevelSharp(kOracleLevels);
            _factory = std::make_unique<Factory>(*_topology.Refiner(), precise);
        }
    }

    bool HasFace(uint32_t face) override { return _SelectFace(face); }

    Sample Evaluate(const FaceParameter& at) override {
        Sample sample;
        if (!_SelectFace(at.face)) {
            return sample;
        }
        double uv[2] = {at.u, at.v};
        const Bfr::Parameterization parameterization = _surface.GetParameterization();
        if (parameterization.HasSubFaces()) {
            parameterization.ConvertNormalizedSubFaceToCoord(_topology.Corner(at.face, at.corner),
                                                             uv, uv);
        }
        double p[kSize], du[kSize], dv[kSize];
        _surface.Evaluate(uv, _patchPoints.data(), kSize, p, du, dv);
        SetSample(p, du, dv, &sample);
        return sample;
    }

  private:
    /// Numbers of a point: its position and its primvar.
    static constexpr int kSize = 6;

    bool _SelectFace(uint32_t face) {
        const int index = _topology.Face(face);
        if (index < 0 || !_factory) {
            return false;
        }
        if (_selected != index) {
            if (!_factory->InitVertexSurface(index, &_surface)) {
                _selected = -1;
                return false;
            }
            _selected = index;
            _patchPoints.resize(kSize * static_cast<size_t>(_surface.GetNumPatchPoints()));
            _surface.PreparePatchPoints(_points.data(), kSize, _patchPoints.data(), kSize);
        }
        return true;
    }

    OracleTopology _topology;
    std::vector<double> _points;
    using Factory = Bfr::RefinerSurfaceFactory<>;
    std::unique_ptr<Factory> _factory;
    /// The face asked for last: building its surface costs most.
    int _selected = -1;
    Bfr::Surface<double> _surface;
    std::vector<double> _patchPoints;
};

}  // namespace

std::unique_ptr<LimitOracle> MakeBfrOracle(const ControlMesh& mesh,
                                           const std::vector<Vec3f>& points,
                                           const std::vector<Vec3f>& values) {
    return std::make_unique<BfrOracle>(mesh, points, values);
}

}  // namespace cc::test
