#include "core/trace/chordErrorKernels.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/trace/chordErrorKernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace cc {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Patches at once. No sum is fused with a product: targets would differ.
constexpr size_t kMaxLanes = 16;
using Lanes = hn::CappedTag<float, kMaxLanes>;
using Floats = hn::Vec<Lanes>;

/// The points of some patches, [axis][point][patch].
struct PatchLanes {
    alignas(64) float points[3][16][kMaxLanes];

    HWY_INLINE Floats At(int axis, int row, int column) const {
        return hn::Load(Lanes(), points[axis][4 * row + column]);
    }
    /// The square of the second difference of three points in a row or column.
    HWY_INLINE Floats Bend(int row, int column, int down, int right) const {
        Floats square = hn::Zero(Lanes());
        for (int axis = 0; axis < 3; ++axis) {
            const Floats middle = At(axis, row + down, column + right);
            const Floats d = hn::Add(hn::Sub(At(axis, row, column), middle),
                                     hn::Sub(At(axis, row + 2 * down, column + 2 * right), middle));
            square = hn::Add(square, hn::Mul(d, d));
        }
        return square;
    }
    /// The same of the mixed difference of four points.
    HWY_INLINE Floats Twist(int row, int column) const {
        Floats square = hn::Zero(Lanes());
        for (int axis = 0; axis < 3; ++axis) {
            const Floats d =
                hn::Sub(hn::Sub(At(axis, row, column), At(axis, row, column + 1)),
                        hn::Sub(At(axis, row + 1, column), At(axis, row + 1, column + 1)));
            square = hn::Add(square, hn::Mul(d, d));
        }
        return square;
    }
    /// (|S_uu| + 2 |S_uv| + |S_vv|) / 8 at most: the derivatives of a uniform B-spline are averages
    /// of such differences.
    HWY_INLINE Floats Error() const {
        const Lanes lanes;
        Floats alongU = hn::Zero(lanes), alongV = alongU, mixed = alongU;
        for (int i = 0; i < 4; ++i) {
            for (int j = 0; j < 2; ++j) {
                alongU = hn::Max(alongU, Bend(i, j, 0, 1));
                alongV = hn::Max(alongV, Bend(j, i, 1, 0));
            }
        }
        for (int i = 0; i < 9; ++i) {
            mixed = hn::Max(mixed, Twist(i / 3, i % 3));
        }
        const Floats twice = hn::Mul(hn::Set(lanes, 2), hn::Sqrt(mixed));
        return hn::Mul(hn::Add(hn::Add(hn::Sqrt(alongU), hn::Sqrt(alongV)), twice),
                       hn::Set(lanes, 0.125f));
    }
};

void BSplineErrorsOf(const uint32_t* const* indices, size_t count, const Vec3f* points,
                     float* errors) {
    const size_t laneCount = hn::Lanes(Lanes());
    PatchLanes patches;
    alignas(64) float found[kMaxLanes];
    for (size_t first = 0; first < count; first += laneCount) {
        const size_t used = std::min(laneCount, count - first);
        for (size_t lane = 0; lane < laneCount; ++lane) {
            // The last patch fills lanes that are left over.
            const uint32_t* const patch = indices[first + std::min(lane, used - 1)];
            for (int i = 0; i < 16; ++i) {
                const Vec3f& p = points[patch[i]];
                patches.points[0][i][lane] = p.x;
                patches.points[1][i][lane] = p.y;
                patches.points[2][i][lane] = p.z;
            }
        }
        hn::Store(patches.Error(), Lanes(), found);
        std::copy(found, found + used, errors + first);
    }
}

void EvaluateLatticeOf(const LimitGridPlan& plan, const ControlPoints& indices, const Vec3f* points,
                       ErrorLattice* lattice) {
    constexpr int kSide = ErrorLattice::kSide;
    const Lanes lanes;
    const size_t laneCount = hn::Lanes(lanes), pickCount = plan.Picks().size();
    const Vec3f base = points[indices[plan.Picks()[0]]];
    alignas(64) float found[3][LimitGridPlan::kWeightCount];
    for (size_t at = 0; at < LimitGridPlan::kWeightCount; at += laneCount) {
        Floats sums[3] = {hn::Zero(lanes), hn::Zero(lanes), hn::Zero(lanes)};
        for (size_t i = 1; i < pickCount; ++i) {
            const Vec3f p = points[indices[plan.Picks()[i]]] - base;
            const Floats weight = hn::LoadU(lanes, plan.Weights(i) + at);
            for (int axis = 0; axis < 3; ++axis) {
                sums[axis] = hn::Add(sums[axis], hn::Mul(weight, hn::Set(lanes, p[axis])));
            }
        }
        for (int axis = 0; axis < 3; ++axis) {
            hn::StoreU(sums[axis], lanes, found[axis] + at);
        }
    }
    for (int axis = 0; axis < 3; ++axis) {
        for (int row = 0; row <= kSide; ++row) {
            std::copy_n(found[axis] + kSide * row, kSide, lattice->points[axis][row]);
            lattice->points[axis][row][kSide] = found[axis][kSide * (kSide + 1) + row];
        }
    }
}

/// The square of how far points of a row are from the middles between two others.
/// @param down,right  from a point to one of those
HWY_INLINE Floats SquareOff(const ErrorLattice& lattice, int row, int column, int down, int right) {
    const Lanes lanes;
    Floats square = hn::Zero(lanes);
    for (const auto& points : lattice.points) {
        const Floats middle = hn::Mul(
            hn::Set(lanes, 0.5f), hn::Add(hn::LoadU(lanes, points[row - down] + column - right),
                                          hn::LoadU(lanes, points[row + down] + column + right)));
        const Floats off = hn::Sub(hn::LoadU(lanes, points[row] + column), middle);
        square = hn::Add(square, hn::Mul(off, off));
    }
    return square;
}

void MeasureErrorsOf(const ErrorLattice& lattice, float errors[ErrorLattice::kLevels]) {
    constexpr int kSide = ErrorLattice::kSide;
    const Lanes lanes;
    const int laneCount = static_cast<int>(hn::Lanes(lanes));
    for (int level = 0; level < ErrorLattice::kLevels; ++level) {
        const int half = kSide >> (level + 1);
        Floats most = hn::Zero(lanes);
        // Along rows, along columns and along diagonals.
        for (int direction = 0; direction < 3; ++direction) {
            const int down = direction == 0 ? 0 : half, right = direction == 1 ? 0 : half;
            for (int row = down; row <= kSide - down; ++row) {
                for (int column = right; column <= kSide - right; column += laneCount) {
                    const int left = kSide - right - column + 1;
                    const auto isThere = hn::FirstN(lanes, static_cast<size_t>(left));
                    const Floats square = SquareOff(lattice, row, column, down, right);
                    most = hn::Max(most, hn::IfThenElseZero(isThere, square));
                }
            }
        }
        errors[level] = hn::GetLane(hn::Sqrt(hn::MaxOfLanes(lanes, most)));
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace cc
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cc {

HWY_EXPORT(BSplineErrorsOf);
HWY_EXPORT(EvaluateLatticeOf);
HWY_EXPORT(MeasureErrorsOf);

void BSplineErrors(const uint32_t* const* indices, size_t count, const Vec3f* points,
                   float* errors) {
    HWY_DYNAMIC_DISPATCH(BSplineErrorsOf)(indices, count, points, errors);
}

void EvaluateLattice(const LimitGridPlan& plan, const ControlPoints& indices, const Vec3f* points,
                     ErrorLattice* lattice) {
    HWY_DYNAMIC_DISPATCH(EvaluateLatticeOf)(plan, indices, points, lattice);
}

void MeasureErrors(const ErrorLattice& lattice, float errors[ErrorLattice::kLevels]) {
    HWY_DYNAMIC_DISPATCH(MeasureErrorsOf)(lattice, errors);
}

}  // namespace cc
#endif  // HWY_ONCE
