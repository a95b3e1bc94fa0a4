#include "core/subdiv/limitLattice.h"

#include <cstdlib>

namespace cc {
namespace {

/// The points of a lattice that a part of the triangle fills: as SubTriangle, counted in them.
struct LatticePart {
    LimitLattice lattice;
    int column, row;
    int size;  ///< negative where the part is turned

    int Side() const { return std::abs(size); }
    Vec3f& At(int i, int j) const {
        const int turn = size < 0 ? -1 : 1;
        return lattice.At(column + turn * i, row + turn * j);
    }
    LatticePart Split(int part) const {
        const int half = size / 2;
        return {lattice, part == 1 || part == 3 ? column + half : column,
                part >= 2 ? row + half : row, part == 3 ? -half : half};
    }
};

void Fill(const BezierTriangle& patch, const LatticePart& part) {
    const float step = 1 / static_cast<float>(part.Side());
    for (int j = 0; j <= part.Side(); ++j) {
        for (int i = 0; i + j <= part.Side(); ++i) {
            part.At(i, j) =
                patch.Position(static_cast<float>(i) * step, static_cast<float>(j) * step);
        }
    }
}

void Fill(const IrregularTriangle& patch, const LatticePart& part) {
    Vec3f spline[12];
    if (patch.ToBoxSpline(spline)) {
        Fill(BezierTriangle::FromBoxSpline(spline), part);
    } else if (part.Side() == 1) {
        Vec3f corners[3];
        patch.LimitCorners(corners);
        part.At(0, 0) = corners[0];
        part.At(1, 0) = corners[1];
        part.At(0, 1) = corners[2];
    } else {
        IrregularTriangle parts[4];
        patch.Subdivide(parts);
        for (int i = 0; i < 4; ++i) {
            Fill(parts[i], part.Split(i));
        }
    }
}

}  // namespace

void EvaluateLimitLattice(const BezierTriangle& patch, const LimitLattice& lattice) {
    Fill(patch, {lattice, 0, 0, lattice.side});
}

void EvaluateLimitLattice(const IrregularTriangle& patch, const LimitLattice& lattice) {
    Fill(patch, {lattice, 0, 0, lattice.side});
}

}  // namespace cc
