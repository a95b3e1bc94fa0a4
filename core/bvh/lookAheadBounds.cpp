#include "core/bvh/lookAheadBounds.h"

#include <cmath>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "core/bvh/boundsKernels.h"
#include "core/subdiv/bezierTriangle.h"
#include "core/subdiv/irregularTriangle.h"
#include "core/subdiv/limitHull.h"

namespace cc {
namespace {

/// Room for the rounding of the tracer's own arithmetic, which takes another way to the surface.
constexpr float kRelativeMargin = 4e-7f;

/// Steps around an irregular vertex of triangles before its 1-ring's hull is taken.
constexpr int kIrregularSteps = 2;

/// Patches that a thread takes at a time.
constexpr size_t kGrainSize = 256;

Box3f IrregularBounds(const IrregularTriangle& patch, int steps) {
    Vec3f spline[12];
    if (patch.ToBoxSpline(spline)) {
        return BezierTriangle::FromBoxSpline(spline).SplitBounds();
    }
    if (steps == 0) {
        return patch.HullBox();
    }
    IrregularTriangle parts[4];
    patch.Subdivide(parts);
    Box3f box;
    for (const IrregularTriangle& part : parts) {
        box.Extend(IrregularBounds(part, steps - 1));
    }
    return box;
}

/// Bounds patches one after the other, but regular ones many at a time.
class PatchBounder {
  public:
    PatchBounder(const PatchTable& patches, const LimitGridPlans& plans, const Vec3f* points,
                 Box3f* boxes)
        : _patches(patches), _plans(plans), _points(points), _boxes(boxes) {}

    void Bound(uint32_t begin, uint32_t end) {
        for (uint32_t patch = begin; patch < end; ++patch) {
            if (_patches.At(patch).kind != PatchKind::Regular) {
                _boxes[patch] = _Widened(_BoxOf(patch));
                continue;
            }
            _regular[_regularCount] = patch;
            _regularIndices[_regularCount] = _patches.Indices(patch);
            if (++_regularCount == kBatchSize) {
                _BoundRegular();
            }
        }
        _BoundRegular();
    }

  private:
    static constexpr size_t kBatchSize = 64;

    void _BoundRegular() {
        Box3f boxes[kBatchSize];
        BSplineBoxes(_regularIndices, _regularCount, _points, boxes);
        for (size_t i = 0; i < _regularCount; ++i) {
            _boxes[_regular[i]] = _Widened(boxes[i]);
        }
        _regularCount = 0;
    }

    Box3f _BoxOf(uint32_t patch) const {
        switch (_patches.At(patch).kind) {
            case PatchKind::Regular: break;
            case PatchKind::Extraordinary:
            case PatchKind::Irregular: return _HullBox(patch);
            case PatchKind::RegularTriangle:
                return GatherBezierTriangle(_patches, patch, _points).SplitBounds();
            case PatchKind::IrregularTriangle:
                return IrregularBounds(GatherIrregularTriangle(_patches, patch, _points),
                                       kIrregularSteps);
            case PatchKind::Bilinear: return _CornerBox(patch, 4);
            case PatchKind::FlatTriangle: return _CornerBox(patch, 3);
        }
        return {};
    }

    Box3f _HullBox(uint32_t patch) const {
        if (const LimitGridPlan* plan = _plans.Of(patch)) {
            ControlPoints indices;
            GatherControlPoints(_patches, patch, &indices);
            return PlannedHullBox(*plan, indices, _points);
        }
        std::vector<Vec3f> hull;
        if (_patches.At(patch).kind == PatchKind::Irregular) {
            AppendHull(GatherIrregular(_patches, patch, _points), &hull);
        } else {
            AppendHull(GatherExtraordinary(_patches, patch, _points), &hull);
        }
        Box3f box;
        for (const Vec3f& p : hull) {
            box.Extend(p);
        }
        return box;
    }

    Box3f _CornerBox(uint32_t patch, int count) const {
        Box3f box;
        for (int i = 0; i < count; ++i) {
            box.Extend(_points[_patches.Indices(patch)[i]]);
        }
        return box;
    }

    static Box3f _Widened(Box3f box) {
        for (int axis = 0; axis < 3; ++axis) {
            const float margin = kRelativeMargin * (std::fabs(box.lower[axis]) +
                                                    std::fabs(box.upper[axis]) + box.Diagonal());
            box.lower[axis] -= margin;
            box.upper[axis] += margin;
        }
        return box;
    }

    const PatchTable& _patches;
    const LimitGridPlans& _plans;
    const Vec3f* const _points;
    Box3f* const _boxes;
    uint32_t _regular[kBatchSize];
    const uint32_t* _regularIndices[kBatchSize];
    size_t _regularCount = 0;
};

}  // namespace

std::vector<Box3f> LookAheadBounds(const PatchTable& patches, const LimitGridPlans& plans,
                                   const Vec3f* points) {
    std::vector<Box3f> boxes(patches.Count());
    const tbb::blocked_range<size_t> all(0, patches.Count(), kGrainSize);
    tbb::parallel_for(all, [&](const tbb::blocked_range<size_t>& part) {
        PatchBounder(patches, plans, points, boxes.data())
            .Bound(static_cast<uint32_t>(part.begin()), static_cast<uint32_t>(part.end()));
    });
    return boxes;
}

}  // namespace cc
