#pragma once

#include <string>

#include "tests/unit/subdiv/testCages.h"

namespace cc::test {

/// How far our surface may be from OpenSubdiv's: in parts of the mesh's diagonal, and in degrees.
constexpr double kPositionTolerance = 1e-5;
constexpr double kNormalTolerance = 0.05;

/// How far two surfaces are apart, at worst.
struct SurfaceDifference {
    /// Why they cannot be compared: no patches, or patches where the other has no surface.
    std::string error;
    double position = 0;                     ///< in parts of the mesh's diagonal
    double normal = 0;                       ///< in degrees
    std::string worstPosition, worstNormal;  ///< where
    int sampleCount = 0;

    bool IsWithinTolerance() const {
        return error.empty() && position < kPositionTolerance && normal < kNormalTolerance;
    }
};

/// Compares our limit surface of a cage with OpenSubdiv's, in each patch at random parameters,
/// along its edges and at its corners.
SurfaceDifference CompareWithOracle(Cage cage);

/// Compares with a third opinion, for cages on which OpenSubdiv's evaluator contradicts its own
/// refinement: positions only, with the limits of uniformly refined vertices, of which one must lie
/// at each of a grid of points of each patch. Returns the largest distance in diagonals.
double DifferenceFromRefinement(Cage cage);

}  // namespace cc::test
