#pragma once

#include <cstddef>
#include <cstdint>

#include "core/math/vec.h"
#include "core/subdiv/limitGridPlan.h"

namespace cc {

/// How far the two triangles of level 0 may be from bicubic B-splines. To the bit the same on all
/// SIMD targets.
/// @param indices  of the 16 points of each patch
/// @param errors   written, one a patch
void BSplineErrors(const uint32_t* const* indices, size_t count, const Vec3f* points,
                   float* errors);

/// Points of a patch at multiples of a sixteenth, [axis][row along v][column along u]; what is
/// beyond the last column counts for nothing.
struct ErrorLattice {
    static constexpr int kSide = kPlanSide, kStride = 2 * kSide;
    /// Levels that can be measured: there are points between their corners.
    static constexpr int kLevels = 4;

    alignas(64) float points[3][kSide + 1][kStride] = {};
};

/// Evaluates a patch by its plan, relative to its first control point. To the bit the same on all
/// SIMD targets.
/// @param indices  the patch's control points (GatherControlPoints)
void EvaluateLattice(const LimitGridPlan& plan, const ControlPoints& indices, const Vec3f* points,
                     ErrorLattice* lattice);

/// How far the middles of edges of each level's triangles are from the surface, and of those that
/// one could cut between other points as far apart. To the bit the same on all SIMD targets.
void MeasureErrors(const ErrorLattice& lattice, float errors[ErrorLattice::kLevels]);

}  // namespace cc
