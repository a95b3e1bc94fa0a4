#include "core/trace/bezierTables.h"

namespace cc {
namespace {

void SetLane(const BezierTriangleWeights& from, int lane, BezierCombination* to) {
    for (int source = 0; source < BezierTriangle::kPointCount; ++source) {
        to->weights[source][lane] = from[source];
    }
}

void FillSplit(int part, BezierCombination* split) {
    const SubTriangle triangle = SubTriangle().Split(part);
    for (int lane = 0; lane < 16; ++lane) {
        SetLane(SubTriangleWeights(triangle, lane % BezierTriangle::kPointCount), lane, split);
    }
}

/// Index of a lattice's vertex: rows get shorter by one.
int VertexAt(int segments, int column, int row) {
    return row * (segments + 1) - row * (row - 1) / 2 + column;
}

void FillLattice(int splits, LatticeTable* lattice) {
    const int segments = 1 << splits;
    const float step = 1 / static_cast<float>(segments);
    for (int lane = 0; lane < 16; ++lane) {
        SetLane(PositionWeights(0, 0), lane, &lattice->weights);
    }
    int count = 0;
    for (int row = 0; row <= segments; ++row) {
        for (int column = 0; column + row <= segments; ++column) {
            const auto x = static_cast<float>(column), y = static_cast<float>(row);
            SetLane(PositionWeights(x * step, y * step), VertexAt(segments, column, row),
                    &lattice->weights);
            for (const int turn : {1, -1}) {
                const int sum = column + row + turn;
                if (sum <= segments && column + turn >= 0 && row + turn >= 0) {
                    lattice->triangles[count++] = {
                        {VertexAt(segments, column, row), VertexAt(segments, column + turn, row),
                         VertexAt(segments, column, row + turn)},
                        x,
                        y,
                        static_cast<float>(turn)};
                }
            }
        }
    }
}

}  // namespace

const BezierTables& BezierTables::Get() {
    static const BezierTables kTables = [] {
        BezierTables tables;
        for (int part = 0; part < 4; ++part) {
            FillSplit(part, &tables.splits[part]);
        }
        for (int splits = 0; splits <= kLatticeSplits; ++splits) {
            FillLattice(splits, &tables.lattice[splits]);
        }
        return tables;
    }();
    return kTables;
}

}  // namespace cc
