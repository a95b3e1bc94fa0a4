#include "tests/unit/subdiv/faceVaryingRefinement.h"

#include <array>
#include <memory>

#include <opensubdiv/far/primvarRefiner.h>

#include "tests/unit/subdiv/primvarOracle.h"

namespace cc::test {
namespace {

namespace Far = OpenSubdiv::Far;

struct MaskValue {
    std::array<double, 4> d{};
    void Clear() { d.fill(0); }
    void AddWithWeight(const MaskValue& other, double weight) {
        for (size_t i = 0; i < d.size(); ++i) {
            d[i] += weight * other.d[i];
        }
    }
};

/// A face of some level, and the square or triangle of its authored face that it covers.
struct Cell {
    Far::Index face;
    FaceParameter lower;
    float size;
};

/// Walks down from the authored faces to those of the last level.
class CellWalk {
  public:
    CellWalk(const Far::TopologyRefiner& refiner, std::vector<Cell>* cells)
        : _refiner(refiner), _cells(*cells) {}

    void Walk(const Cell& cell, int level) {
        if (level == _refiner.GetMaxLevel()) {
            _cells.push_back(cell);
            return;
        }
        const Far::TopologyLevel coarse = _refiner.GetLevel(level);
        const Far::TopologyLevel fine = _refiner.GetLevel(level + 1);
        const Far::ConstIndexArray corners = coarse.GetFaceVertices(cell.face);
        const Far::ConstIndexArray children = coarse.GetFaceChildFaces(cell.face);
        const bool isTriangle = cell.lower.isTriangle;
        const bool isSubdivided = !isTriangle && corners.size() != 4;
        for (int i = 0; i < corners.size(); ++i) {
            const int first = isSubdivided ? 0 : i;
            // Parts whose vertices are in another order are left out.
            if (fine.GetFaceVertices(children[i])[first] !=
                coarse.GetVertexChildVertex(corners[i])) {
                continue;
            }
            Cell child{children[i], cell.lower, isSubdivided ? cell.size : cell.size / 2};
            if (isSubdivided) {
                child.lower.corner = static_cast<uint32_t>(i);
            } else {
                child.lower.u += i == 1 || (i == 2 && !isTriangle) ? child.size : 0;
                child.lower.v += i >= 2 ? child.size : 0;
            }
            Walk(child, level + 1);
        }
    }

  private:
    const Far::TopologyRefiner& _refiner;
    std::vector<Cell>& _cells;
};

bool HasMask(const Far::TopologyLevel& level, Far::Index vertex) {
    if (level.IsVertexNonManifold(vertex)) {
        return false;
    }
    for (Far::Index edge : level.GetVertexEdges(vertex)) {
        const float sharpness = level.GetEdgeSharpness(edge);
        if (sharpness > 0 && sharpness < 10) {
            return false;
        }
    }
    const float sharpness = level.GetVertexSharpness(vertex);
    return !(sharpness > 0 && sharpness < 10);
}

std::vector<MaskValue> Limits(const Far::TopologyRefiner& refiner, const Primvar& primvar) {
    std::vector<MaskValue> values(primvar.ValueCount());
    for (size_t i = 0; i < values.size(); ++i) {
        for (int k = 0; k < primvar.arity; ++k) {
            values[i].d[k] = primvar.values[i * primvar.arity + k];
        }
    }
    const Far::PrimvarRefinerReal<double> primvars(refiner);
    for (int level = 1; level <= refiner.GetMaxLevel(); ++level) {
        std::vector<MaskValue> finer(refiner.GetLevel(level).GetNumFVarValues(0));
        primvars.InterpolateFaceVarying(level, values, finer, 0);
        values = std::move(finer);
    }
    std::vector<MaskValue> limits(values.size());
    primvars.LimitFaceVarying(values, limits, 0);
    return limits;
}

}  // namespace

std::vector<RefinedValue> RefinedFaceVaryingLimits(const ControlMesh& mesh, size_t pointCount,
                                                   const Primvar& primvar, int levels) {
    PrimvarOracle oracle(mesh, pointCount, primvar);
    const std::unique_ptr<Far::TopologyRefiner> refiner = oracle.TakeRefiner();
    Far::TopologyRefiner::UniformOptions uniform(levels);
    uniform.fullTopologyInLastLevel = true;
    refiner->RefineUniform(uniform);
    const std::vector<MaskValue> limits = Limits(*refiner, primvar);
    const bool isTriangle = mesh.scheme == Scheme::Loop;
    std::vector<Cell> cells;
    for (int face = 0; face < refiner->GetLevel(0).GetNumFaces(); ++face) {
        if (!refiner->GetLevel(0).IsFaceHole(face)) {
            CellWalk(*refiner, &cells)
                .Walk({face, {static_cast<uint32_t>(face), 0, 0, 0, isTriangle}, 1}, 0);
        }
    }
    const Far::TopologyLevel last = refiner->GetLevel(levels);
    std::vector<RefinedValue> result;
    for (const Cell& cell : cells) {
        const Far::ConstIndexArray vertices = last.GetFaceVertices(cell.face);
        const Far::ConstIndexArray values = last.GetFaceFVarValues(cell.face, 0);
        for (int i = 0; i < vertices.size(); ++i) {
            if (HasMask(last, vertices[i])) {
                RefinedValue refined{cell.lower, {}};
                refined.at.u += i == 1 || (i == 2 && !isTriangle) ? cell.size : 0;
                refined.at.v += i >= 2 ? cell.size : 0;
                const MaskValue& limit = limits[values[i]];
                refined.value.assign(limit.d.begin(), limit.d.begin() + primvar.arity);
                result.push_back(refined);
            }
        }
    }
    return result;
}

}  // namespace cc::test
