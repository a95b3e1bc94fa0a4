#include <algorithm>
#include <array>
#include <cmath>

#include <opensubdiv/far/primvarRefiner.h>

#include "tests/unit/subdiv/farPatches.h"
#include "tests/unit/subdiv/limitOracle.h"

namespace cc::test {
namespace {

namespace Far = OpenSubdiv::Far;

/// A point and its primvar, which Far's masks act on.
struct Values {
    std::array<double, 6> d{};
    void Clear() { d.fill(0); }
    void AddWithWeight(const Values& other, double weight) {
        for (size_t i = 0; i < d.size(); ++i) {
            d[i] += weight * other.d[i];
        }
    }
};

std::vector<Values> Join(const std::vector<Vec3f>& points, const std::vector<Vec3f>& values) {
    std::vector<Values> joined;
    for (size_t i = 0; i < points.size(); ++i) {
        const Vec3f &p = points[i], &q = values[i];
        joined.push_back({{p.x, p.y, p.z, q.x, q.y, q.z}});
    }
    return joined;
}

/// Far takes the end of a dart for a smooth vertex, and on a crease that is no manifold it takes
/// the edges of a face's fan for those of the crease.
bool HasExactMask(const Far::TopologyLevel& level, Far::Index vertex) {
    if (level.GetVertexSharpness(vertex) >= 10) {
        return true;
    }
    const Far::ConstIndexArray edges = level.GetVertexEdges(vertex);
    const auto sharp = std::count_if(edges.begin(), edges.end(), [&level](Far::Index edge) {
        return level.IsEdgeBoundary(edge) || level.GetEdgeSharpness(edge) >= 10;
    });
    return sharp != 1 && !level.IsVertexNonManifold(vertex);
}

/// What decides the normal at a sharp corner of many faces may be so small at first that it shows
/// after 40 levels or 100, and the faces look settled before. CornerTangents has a test of its own.
bool HasSlowNormal(const Far::TopologyLevel& level, Far::Index vertex) {
    constexpr int kMostFaces = 4;
    return level.GetVertexSharpness(vertex) >= 10 &&
           level.GetVertexFaces(vertex).size() > kMostFaces;
}

struct CornerOfFace {
    Far::Index face, vertex;
};

/// A vertex with its faces, as a mesh of its own. The first face begins with the vertex. Under
/// Chaikin's rule the faces around those are there as well: edges decay by what meets their far
/// ends.
struct Ring {
    ControlMesh mesh;
    std::vector<Values> points;
};

/// A mesh's rules without its faces.
ControlMesh RulesOf(const ControlMesh& mesh) {
    ControlMesh rules;
    rules.scheme = mesh.scheme;
    rules.creaseRule = mesh.creaseRule;
    rules.triangleRule = mesh.triangleRule;
    return rules;
}

Ring RingOf(const Far::TopologyLevel& level, const CornerOfFace& corner,
            const std::vector<Values>& values, const ControlMesh& rules) {
    Ring ring;
    ring.mesh = rules;
    std::vector<int> toRing(level.GetNumVertices(), -1);
    std::vector<bool> isIn(level.GetNumFaces(), false);
    const auto addFace = [&](Far::Index face) {
        if (isIn[face]) {
            return;
        }
        const Far::ConstIndexArray vertices = level.GetFaceVertices(face);
        ring.mesh.faceVertexCounts.push_back(vertices.size());
        const int first = std::max(vertices.FindIndex(corner.vertex), 0);
        isIn[face] = true;
        for (int i = 0; i < vertices.size(); ++i) {
            const Far::Index v = vertices[(first + i) % vertices.size()];
            if (toRing[v] < 0) {
                toRing[v] = static_cast<int>(ring.points.size());
                ring.points.push_back(values[v]);
            }
            ring.mesh.faceVertexIndices.push_back(toRing[v]);
        }
    };
    addFace(corner.face);
    for (Far::Index face : level.GetVertexFaces(corner.vertex)) {
        addFace(face);
    }
    if (rules.creaseRule == CreaseRule::Chaikin) {
        for (Far::Index near : level.GetVertexFaces(corner.vertex)) {
            for (Far::Index vertex : level.GetFaceVertices(near)) {
                for (Far::Index face : level.GetVertexFaces(vertex)) {
                    addFace(face);
                }
            }
        }
    }
    for (Far::Index edge = 0; edge < level.GetNumEdges(); ++edge) {
        const Far::ConstIndexArray ends = level.GetEdgeVertices(edge);
        const Far::ConstIndexArray faces = level.GetEdgeFaces(edge);
        if (std::none_of(faces.begin(), faces.end(), [&](Far::Index face) { return isIn[face]; })) {
            continue;
        }
        ring.mesh.creaseIndices.push_back(toRing[ends[0]]);
        ring.mesh.creaseIndices.push_back(toRing[ends[1]]);
        ring.mesh.creaseLengths.push_back(2);
        ring.mesh.creaseSharpnesses.push_back(level.GetEdgeSharpness(edge));
    }
    ring.mesh.cornerIndices = {0};
    ring.mesh.cornerSharpnesses = {level.GetVertexSharpness(corner.vertex)};
    return ring;
}

/// One step: the ring of the refined vertex.
Ring Refine(const Ring& ring) {
    const OracleTopology topology(ring.mesh, ring.points.size());
    Far::TopologyRefiner& refiner = *topology.Refiner();
    Far::TopologyRefiner::UniformOptions uniform(1);
    uniform.fullTopologyInLastLevel = true;
    refiner.RefineUniform(uniform);
    std::vector<Values> fine(refiner.GetLevel(1).GetNumVertices());
    Far::PrimvarRefinerReal<double>(refiner).Interpolate(1, ring.points, fine);
    const Far::TopologyLevel coarse = refiner.GetLevel(0);
    return RingOf(refiner.GetLevel(1),
                  {coarse.GetFaceChildFaces(0)[0], coarse.GetVertexChildVertex(0)}, fine,
                  RulesOf(ring.mesh));
}

class FarOracle : public LimitOracle {
  public:
    FarOracle(const ControlMesh& mesh, const std::vector<Values>& cage, int levels)
        : _patches(mesh, cage.size(), levels),
          _cage(cage),
          _rules(RulesOf(mesh)),
          _deepLevels(levels + kDeeper) {
        if (!_patches.IsValid()) {
            return;
        }
        const Far::TopologyRefiner* refiner = _patches.Topology().Refiner();
        _values.resize(refiner->GetNumVerticesTotal() + _patches.Table().GetNumLocalPoints());
        std::copy(cage.begin(), cage.end(), _values.begin());
        const Far::PrimvarRefinerReal<double> primvars(*refiner);
        Values* coarse = _values.data();
        for (int level = 1; level <= refiner->GetMaxLevel(); ++level) {
            Values* fine = coarse + refiner->GetLevel(level - 1).GetNumVertices();
            primvars.Interpolate(level, coarse, fine);
            coarse = fine;
        }
        if (_patches.Table().GetNumLocalPoints() > 0) {
            _patches.Table().GetLocalPointStencilTable<double>()->UpdateValues(
                _values.data(), _values.data() + refiner->GetNumVerticesTotal());
        }
    }

    bool HasFace(uint32_t face) override {
        return _patches.Find({face, _FirstCorner(face), 0.5f, 0.5f}) != nullptr;
    }

    Sample Evaluate(const FaceParameter& at) override {
        if (_patches.Find(at) == nullptr) {
            return {};
        }
        const CornerOfFace corner = _CornerAt(at);
        const bool isExact = corner.vertex < 0 || HasExactMask(_Cage(), corner.vertex);
        Sample sample = isExact ? _EvaluatePatch(at) : _EvaluateDeep(corner);
        if (corner.vertex >= 0 && HasSlowNormal(_Cage(), corner.vertex)) {
            sample.normal = {};
        }
        return sample;
    }

  private:
    Far::TopologyLevel _Cage() const { return _patches.Topology().Refiner()->GetLevel(0); }

    Sample _EvaluatePatch(const FaceParameter& at) const {
        const FarPatches::Handle* patch = _patches.Find(at);
        double weights[20], weightsU[20], weightsV[20];
        _patches.Table().EvaluateBasis(*patch, static_cast<double>(at.u), static_cast<double>(at.v),
                                       weights, weightsU, weightsV);
        Values value, du, dv;
        const Far::ConstIndexArray points = _patches.Table().GetPatchVertices(*patch);
        for (int i = 0; i < points.size(); ++i) {
            value.AddWithWeight(_values[points[i]], weights[i]);
            du.AddWithWeight(_values[points[i]], weightsU[i]);
            dv.AddWithWeight(_values[points[i]], weightsV[i]);
        }
        Sample sample;
        SetSample(value.d.data(), du.d.data(), dv.d.data(), &sample);
        return sample;
    }

    /// Some corner that a face kept.
    uint32_t _FirstCorner(uint32_t face) const {
        uint32_t corner = 0;
        while (_patches.Topology().Face(face) >= 0 &&
               _patches.Topology().Corner(face, corner) != 0) {
            ++corner;
        }
        return corner;
    }

    /// The corner of a face that a place is at. No vertex if it is none.
    CornerOfFace _CornerAt(const FaceParameter& at) const {
        const Far::Index face = _patches.Topology().Face(at.face);
        const Far::ConstIndexArray vertices = _Cage().GetFaceVertices(face);
        if (!_patches.IsWhole(face)) {
            const bool isCorner = at.u == 0 && at.v == 0;
            return {face, isCorner ? vertices[_patches.Topology().Corner(at.face, at.corner)] : -1};
        }
        const bool isCorner = (at.u == 0 || at.u == 1) && (at.v == 0 || at.v == 1);
        const int last = vertices.size() - 1;
        const int corner = at.u == 0 ? (at.v == 0 ? 0 : last) : (at.v == 0 ? 1 : 2);
        return {face, isCorner ? vertices[corner] : -1};
    }

    /// Refines the ring of a corner, and only that, until it is too small to matter.
    Sample _EvaluateDeep(const CornerOfFace& corner) const {
        Ring ring = RingOf(_Cage(), corner, _cage, _rules);
        for (int level = 0; level < _deepLevels; ++level) {
            ring = Refine(ring);
        }
        return FarOracle(ring.mesh, ring.points, 1)._EvaluatePatch({0, 0, 0, 0});
    }

    /// How many levels deeper than patches a ring is refined.
    static constexpr int kDeeper = 24;

    FarPatches _patches;
    const std::vector<Values> _cage;
    const ControlMesh _rules;
    const int _deepLevels;
    /// Of all levels' vertices, then of the points that patches add.
    std::vector<Values> _values;
};

}  // namespace

std::unique_ptr<LimitOracle> MakeFarOracle(const ControlMesh& mesh,
                                           const std::vector<Vec3f>& points,
                                           const std::vector<Vec3f>& values, int levels) {
    return std::make_unique<FarOracle>(mesh, Join(points, values), levels);
}

void SetSample(const double p[6], const double du[6], const double dv[6],
               LimitOracle::Sample* sample) {
    const auto vector = [](const double v[3]) {
        return Vec3f{static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
    };
    sample->exists = true;
    sample->position = vector(p);
    sample->value = vector(p + 3);
    const double n[3] = {du[1] * dv[2] - du[2] * dv[1], du[2] * dv[0] - du[0] * dv[2],
                         du[0] * dv[1] - du[1] * dv[0]};
    const double length = std::hypot(n[0], n[1], n[2]);
    const double longer =
        std::max(std::hypot(du[0], du[1], du[2]), std::hypot(dv[0], dv[1], dv[2]));
    // What rounding leaves of parallel derivatives is no normal.
    if (length > 1e-5 * longer * longer) {
        const double unit[3] = {n[0] / length, n[1] / length, n[2] / length};
        sample->normal = vector(unit);
        sample->normalScale = length / longer;
    }
}

}  // namespace cc::test
