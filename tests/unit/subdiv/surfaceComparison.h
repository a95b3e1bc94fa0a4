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
    double position = 0;  ///< in parts of the mesh's diagonal
    double primvar = 0;   ///< of a vertex primvar, in parts of its range
    double normal = 0;    ///< in degrees
    std::string worstPosition, worstPrimvar, worstNormal;  ///< where
    int sampleCount = 0;

    bool IsWithinTolerance() const {
        return error.empty() && position < kPositionTolerance && primvar < kPositionTolerance &&
               normal < kNormalTolerance;
    }
};

/// Which of OpenSubdiv's evaluators (LimitOracle).
enum class OracleKind { Bfr, Far };

/// Compares our limit surface of a cage with OpenSubdiv's, in each patch at random parameters,
/// along its edges and, with Far, at its corners.
SurfaceDifference CompareWithOracle(Cage cage, OracleKind kind);

}  // namespace cc::test
