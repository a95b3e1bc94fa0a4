#pragma once

#include "core/math/vec.h"
#include "core/subdiv/extraordinaryPatch.h"
#include "core/subdiv/irregularPatch.h"

namespace cc {

/// The finest grid that is made into a plan: 2^4 x 2^4 quads.
constexpr int kPlanSplits = 4;
constexpr int kPlanSide = 1 << kPlanSplits;

/// Points of the limit surface of a patch in a square grid of (side + 1)^2.
struct LimitPoints {
    int side = 0;  ///< quads along each side: 1, 2, 4, 8 or 16
    /// [row along v][column along u]
    Vec3f at[kPlanSide + 1][kPlanSide + 1];
};

/// Evaluates a patch at 2^splits x 2^splits quads by subdividing it until its parts are B-splines:
/// the slow way, for any topology (LimitGridPlan).
/// @param splits  0..kPlanSplits
void EvaluateLimitPoints(const IrregularPatch& patch, int splits, LimitPoints* points);
void EvaluateLimitPoints(const ExtraordinaryPatch& patch, int splits, LimitPoints* points);

}  // namespace cc
