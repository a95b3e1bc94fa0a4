#include <sstream>

#include <gtest/gtest.h>

#include "tests/unit/subdiv/cageKit.h"
#include "tests/unit/subdiv/generatedCage.h"
#include "tests/unit/subdiv/surfaceComparison.h"

namespace cc::test {
namespace {

/// Why the surface of a cage is not OpenSubdiv's; empty if it is.
std::string DifferenceFromOpenSubdiv(const Cage& cage) {
    const SurfaceDifference difference = CompareWithOracle(cage, OracleKind::Far);
    std::ostringstream failure;
    if (!difference.IsWithinTolerance()) {
        failure << difference.error << "\nposition off by " << difference.position << " at "
                << difference.worstPosition << "\nprimvar off by " << difference.primvar << " at "
                << difference.worstPrimvar << "\nnormal off by " << difference.normal
                << " degrees at " << difference.worstNormal;
    }
    return failure.str();
}

TEST(GeneratedCage, AgreesWithOpenSubdiv) {
    ExpectForGeneratedCages("the limit surface is OpenSubdiv's", DifferenceFromOpenSubdiv);
}

TEST(GeneratedCage, AgreesWithOpenSubdivUnderLoop) {
    ExpectForGeneratedCages(
        "the limit surface of Loop's scheme is OpenSubdiv's",
        [](const Cage& cage) { return DifferenceFromOpenSubdiv(Triangulated(cage)); });
}

}  // namespace
}  // namespace cc::test
