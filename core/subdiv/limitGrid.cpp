#include "core/subdiv/limitGrid.h"

#include "core/subdiv/bezierPatch.h"

namespace cc {
namespace {

/// A square of the grid that a part of the patch fills.
struct GridPart {
    LimitPoints* points;
    int row, column, side;

    GridPart Quarter(int corner) const {
        const int half = side / 2;
        return {points, corner >= 2 ? row + half : row,
                corner == 1 || corner == 2 ? column + half : column, half};
    }
};

void FillRegular(const BezierPatch& patch, const GridPart& part) {
    const float step = 1 / static_cast<float>(part.side);
    for (int r = 0; r <= part.side; ++r) {
        for (int c = 0; c <= part.side; ++c) {
            part.points->at[part.row + r][part.column + c] =
                patch.Position(static_cast<float>(c) * step, static_cast<float>(r) * step);
        }
    }
}

void FillCorners(const Vec3f corners[4], const GridPart& part) {
    auto& at = part.points->at;
    at[part.row][part.column] = corners[0];
    at[part.row][part.column + 1] = corners[1];
    at[part.row + 1][part.column + 1] = corners[2];
    at[part.row + 1][part.column] = corners[3];
}

void Fill(const IrregularPatch& patch, const GridPart& part) {
    Vec3f bspline[16];
    if (patch.ToBSpline(bspline)) {
        FillRegular(BezierPatch::FromBSpline(bspline), part);
    } else if (part.side == 1) {
        Vec3f corners[4];
        patch.LimitCorners(corners);
        FillCorners(corners, part);
    } else {
        IrregularPatch quarters[4];
        patch.Subdivide(quarters);
        for (int corner = 0; corner < 4; ++corner) {
            Fill(quarters[corner], part.Quarter(corner));
        }
    }
}

}  // namespace

void EvaluateLimitPoints(const IrregularPatch& patch, int splits, LimitPoints* points) {
    points->side = 1 << splits;
    Fill(patch, {points, 0, 0, points->side});
}

void EvaluateLimitPoints(const ExtraordinaryPatch& patch, int splits, LimitPoints* points) {
    points->side = 1 << splits;
    ExtraordinaryPatch rest = patch;
    GridPart part{points, 0, 0, points->side};
    for (; part.side > 1; part = part.Quarter(0)) {
        ExtraordinaryPatch::RegularQuarters quarters;
        rest.Subdivide(&quarters);
        for (int i = 0; i < 3; ++i) {
            FillRegular(BezierPatch::FromBSpline(quarters.points[i]), part.Quarter(i + 1));
        }
    }
    Vec3f corners[4];
    rest.LimitCorners(corners);
    FillCorners(corners, part);
}

}  // namespace cc
