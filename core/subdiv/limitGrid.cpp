#include "core/subdiv/limitGrid.h"

namespace cc {
namespace {

void FillCorners(const Vec3f corners[4], const LimitSquare& square) {
    square.At(0, 0) = corners[0];
    square.At(1, 0) = corners[1];
    square.At(1, 1) = corners[2];
    square.At(0, 1) = corners[3];
}

}  // namespace

void EvaluateLimitGrid(const BezierPatch& patch, const LimitSquare& square) {
    const float step = 1 / static_cast<float>(square.side);
    for (int row = 0; row <= square.side; ++row) {
        for (int column = 0; column <= square.side; ++column) {
            square.At(column, row) =
                patch.Position(static_cast<float>(column) * step, static_cast<float>(row) * step);
        }
    }
}

void EvaluateLimitGrid(const IrregularPatch& patch, const LimitSquare& square) {
    Vec3f bspline[16];
    if (patch.ToBSpline(bspline)) {
        EvaluateLimitGrid(BezierPatch::FromBSpline(bspline), square);
    } else if (square.side == 1) {
        Vec3f corners[4];
        patch.LimitCorners(corners);
        FillCorners(corners, square);
    } else {
        IrregularPatch quarters[4];
        patch.Subdivide(quarters);
        for (int corner = 0; corner < 4; ++corner) {
            EvaluateLimitGrid(quarters[corner], square.Quarter(corner));
        }
    }
}

void EvaluateLimitGrid(const ExtraordinaryPatch& patch, const LimitSquare& square) {
    ExtraordinaryPatch rest = patch;
    LimitSquare part = square;
    for (; part.side > 1; part = part.Quarter(0)) {
        ExtraordinaryPatch::RegularQuarters quarters;
        rest.Subdivide(&quarters);
        for (int i = 0; i < 3; ++i) {
            EvaluateLimitGrid(BezierPatch::FromBSpline(quarters.points[i]), part.Quarter(i + 1));
        }
    }
    Vec3f corners[4];
    rest.LimitCorners(corners);
    FillCorners(corners, part);
}

}  // namespace cc
