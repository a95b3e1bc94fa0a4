#include "core/bvh/boundsKernels.h"

#include <algorithm>

#include "core/math/inlineVector.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/bvh/boundsKernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace cc {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Patches that are bounded at once, or points of one hull.
constexpr size_t kMaxLanes = 16;
using Lanes = hn::CappedTag<float, kMaxLanes>;
using Floats = hn::Vec<Lanes>;

/// Room for rounding, against the extent of a patch's points: they are taken relative to one of
/// them, so that little is rounded.
constexpr float kBSplineMargin = 1e-6f;
/// The same where weights have been rounded as well, and sums are long.
constexpr float kPlannedMargin = 4e-6f;

/// The least and the greatest of what was added.
struct Bounds {
    Floats lower, upper;

    HWY_INLINE Bounds() : lower(hn::Set(Lanes(), 1e30f)), upper(hn::Set(Lanes(), -1e30f)) {}

    HWY_INLINE void Extend(Floats value) {
        lower = hn::Min(lower, value);
        upper = hn::Max(upper, value);
    }
};

/// Four points of B-spline curves to the Bezier points of the halves of their segments, but for the
/// point where the halves meet: it lies in the middle between its neighbours.
HWY_INLINE void SplitBSplineCurves(Floats a, Floats b, Floats c, Floats d, Floats out[6]) {
    const Lanes lanes;
    const Floats half = hn::Set(lanes, 0.5f), quarter = hn::Set(lanes, 0.25f);
    const Floats third = hn::Set(lanes, 1 / 3.0f), sixth = hn::Set(lanes, 1 / 6.0f);
    const Floats four = hn::Set(lanes, 4.0f);
    const auto middle = [&](Floats x, Floats y) HWY_ATTR { return hn::Mul(hn::Add(x, y), half); };
    const auto atThird = [&](Floats x, Floats y)
                             HWY_ATTR { return hn::Mul(hn::Add(hn::Add(x, x), y), third); };
    const auto joint = [&](Floats x, Floats y, Floats z) HWY_ATTR {
        return hn::Mul(hn::Add(hn::Add(x, z), hn::Mul(y, four)), sixth);
    };
    const Floats ab = middle(a, b), bc = middle(b, c), cd = middle(c, d);
    const Floats nearB = hn::Add(hn::Mul(hn::Add(ab, bc), quarter), hn::Mul(b, half));
    const Floats nearC = hn::Add(hn::Mul(hn::Add(bc, cd), quarter), hn::Mul(c, half));
    out[0] = joint(ab, nearB, bc);
    out[1] = atThird(nearB, bc);
    out[2] = atThird(bc, nearB);
    out[3] = atThird(bc, nearC);
    out[4] = atThird(nearC, bc);
    out[5] = joint(bc, nearC, cd);
}

/// One coordinate of the points of some patches, relative to each patch's own origin.
struct PatchLanes {
    alignas(64) float origin[kMaxLanes];
    alignas(64) float points[16][kMaxLanes];

    HWY_INLINE void StoreBounds(float* lower, float* upper) const {
        const Lanes lanes;
        Floats extent = hn::Zero(lanes), rows[6][4];
        for (int column = 0; column < 4; ++column) {
            Floats p[4], curve[6];
            for (int row = 0; row < 4; ++row) {
                p[row] = hn::Load(lanes, points[4 * row + column]);
                extent = hn::Max(extent, hn::Abs(p[row]));
            }
            SplitBSplineCurves(p[0], p[1], p[2], p[3], curve);
            for (int row = 0; row < 6; ++row) {
                rows[row][column] = curve[row];
            }
        }
        Bounds bounds;
        for (const Floats* row : rows) {
            Floats curve[6];
            SplitBSplineCurves(row[0], row[1], row[2], row[3], curve);
            for (const Floats& value : curve) {
                bounds.Extend(value);
            }
        }
        const Floats at = hn::Load(lanes, origin);
        const Floats margin = hn::Mul(extent, hn::Set(lanes, kBSplineMargin));
        hn::Store(hn::Add(hn::Sub(bounds.lower, margin), at), lanes, lower);
        hn::Store(hn::Add(hn::Add(bounds.upper, margin), at), lanes, upper);
    }
};

void BSplineBoxesOf(const uint32_t* const* indices, size_t count, const Vec3f* points,
                    Box3f* boxes) {
    const size_t laneCount = hn::Lanes(Lanes());
    PatchLanes axes[3];
    alignas(64) float lower[3][kMaxLanes], upper[3][kMaxLanes];
    for (size_t first = 0; first < count; first += laneCount) {
        const size_t used = std::min(laneCount, count - first);
        for (size_t lane = 0; lane < laneCount; ++lane) {
            // The last patch fills lanes that are left over.
            const uint32_t* const patch = indices[first + std::min(lane, used - 1)];
            const Vec3f origin = points[patch[5]];
            for (int axis = 0; axis < 3; ++axis) {
                axes[axis].origin[lane] = origin[axis];
            }
            for (int i = 0; i < 16; ++i) {
                const Vec3f p = points[patch[i]] - origin;
                axes[0].points[i][lane] = p.x;
                axes[1].points[i][lane] = p.y;
                axes[2].points[i][lane] = p.z;
            }
        }
        for (int axis = 0; axis < 3; ++axis) {
            axes[axis].StoreBounds(lower[axis], upper[axis]);
        }
        for (size_t lane = 0; lane < used; ++lane) {
            boxes[first + lane].lower = {lower[0][lane], lower[1][lane], lower[2][lane]};
            boxes[first + lane].upper = {upper[0][lane], upper[1][lane], upper[2][lane]};
        }
    }
}

Box3f PlannedHullBoxOf(const LimitGridPlan& plan, const ControlPoints& indices,
                       const Vec3f* points) {
    const Lanes lanes;
    const size_t laneCount = hn::Lanes(lanes), hullCount = plan.HullCount();
    const size_t pickCount = plan.Picks().size();
    InlineVector<Vec3f, 40> relative;
    relative.resize(pickCount);
    const Vec3f origin = points[indices[plan.Picks()[0]]];
    Vec3f extent{};
    for (size_t i = 0; i < pickCount; ++i) {
        relative[i] = points[indices[plan.Picks()[i]]] - origin;
        for (int axis = 0; axis < 3; ++axis) {
            extent[axis] = std::max(extent[axis], std::abs(relative[i][axis]));
        }
    }
    Bounds bounds[3];
    for (size_t at = 0; at < hullCount; at += 2 * laneCount) {
        Floats sums[3][2];
        for (auto& sum : sums) {
            sum[0] = sum[1] = hn::Zero(lanes);
        }
        const float* weights = plan.HullWeights(0) + at;
        for (size_t i = 0; i < pickCount; ++i, weights += hullCount) {
            const Floats w[2] = {hn::LoadU(lanes, weights), hn::LoadU(lanes, weights + laneCount)};
            for (int axis = 0; axis < 3; ++axis) {
                const Floats p = hn::Set(lanes, relative[i][axis]);
                sums[axis][0] = hn::MulAdd(w[0], p, sums[axis][0]);
                sums[axis][1] = hn::MulAdd(w[1], p, sums[axis][1]);
            }
        }
        for (int axis = 0; axis < 3; ++axis) {
            bounds[axis].Extend(sums[axis][0]);
            bounds[axis].Extend(sums[axis][1]);
        }
    }
    Box3f box;
    for (int axis = 0; axis < 3; ++axis) {
        const float margin = kPlannedMargin * extent[axis];
        box.lower[axis] =
            origin[axis] + (hn::GetLane(hn::MinOfLanes(lanes, bounds[axis].lower)) - margin);
        box.upper[axis] =
            origin[axis] + (hn::GetLane(hn::MaxOfLanes(lanes, bounds[axis].upper)) + margin);
    }
    return box;
}

}  // namespace HWY_NAMESPACE
}  // namespace cc
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cc {
namespace {

HWY_EXPORT(BSplineBoxesOf);
HWY_EXPORT(PlannedHullBoxOf);

}  // namespace

void BSplineBoxes(const uint32_t* const* indices, size_t count, const Vec3f* points, Box3f* boxes) {
    HWY_DYNAMIC_DISPATCH(BSplineBoxesOf)(indices, count, points, boxes);
}

Box3f PlannedHullBox(const LimitGridPlan& plan, const ControlPoints& indices, const Vec3f* points) {
    return HWY_DYNAMIC_DISPATCH(PlannedHullBoxOf)(plan, indices, points);
}

}  // namespace cc
#endif  // HWY_ONCE
