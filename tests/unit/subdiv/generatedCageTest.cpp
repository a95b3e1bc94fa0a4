#include <sstream>

#include <gtest/gtest.h>

#include "tests/unit/subdiv/generatedCage.h"
#include "tests/unit/subdiv/surfaceComparison.h"

namespace cc::test {
namespace {

TEST(GeneratedCage, AgreesWithOpenSubdiv) {
    ExpectForGeneratedCages("the limit surface is OpenSubdiv's", [](const Cage& cage) {
        const SurfaceDifference difference = CompareWithOracle(cage, OracleKind::Far);
        std::ostringstream failure;
        if (!difference.IsWithinTolerance()) {
            failure << difference.error << "\nposition off by " << difference.position << " at "
                    << difference.worstPosition << "\nprimvar off by " << difference.primvar
                    << " at " << difference.worstPrimvar << "\nnormal off by " << difference.normal
                    << " degrees at " << difference.worstNormal;
        }
        return failure.str();
    });
}

}  // namespace
}  // namespace cc::test
