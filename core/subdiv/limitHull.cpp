#include "core/subdiv/limitHull.h"

#include "core/subdiv/bezierPatch.h"

namespace cc {
namespace {

/// Steps around an extraordinary vertex before the hull of its 1-ring is taken.
constexpr int kExtraordinarySteps = 3;

/// The same for irregular patches, whose parts multiply along creases.
constexpr int kIrregularSteps = 2;

void AppendBezier(const Vec3f bspline[16], std::vector<Vec3f>* hull) {
    const BezierPatch bezier = BezierPatch::FromBSpline(bspline);
    hull->insert(hull->end(), &bezier.points[0][0], &bezier.points[0][0] + 16);
}

template <class Points>
void AppendAll(const Points& points, std::vector<Vec3f>* hull) {
    hull->insert(hull->end(), points.begin(), points.end());
}

void AppendRings(const IrregularPatch& patch, std::vector<Vec3f>* hull) {
    for (const VertexRing& ring : patch.rings) {
        hull->push_back(ring.center);
        AppendAll(ring.edges, hull);
        AppendAll(ring.diagonals, hull);
    }
}

void AppendParts(const IrregularPatch& patch, int step, std::vector<Vec3f>* hull) {
    Vec3f bspline[16];
    if (step > 0 && patch.ToBSpline(bspline)) {
        AppendBezier(bspline, hull);
    } else if (step == kIrregularSteps) {
        AppendRings(patch, hull);
    } else {
        IrregularPatch quarters[4];
        patch.Subdivide(quarters);
        for (const IrregularPatch& quarter : quarters) {
            AppendParts(quarter, step + 1, hull);
        }
    }
}

}  // namespace

void AppendHull(const IrregularPatch& patch, std::vector<Vec3f>* hull) {
    AppendParts(patch, 0, hull);
}

void AppendHull(const ExtraordinaryPatch& patch, std::vector<Vec3f>* hull) {
    ExtraordinaryPatch rest = patch;
    for (int step = 0; step < kExtraordinarySteps; ++step) {
        ExtraordinaryPatch::RegularQuarters quarters;
        rest.Subdivide(&quarters);
        for (const auto& quarter : quarters.points) {
            AppendBezier(quarter, hull);
        }
    }
    AppendAll(rest.ControlPoints(), hull);
}

}  // namespace cc
