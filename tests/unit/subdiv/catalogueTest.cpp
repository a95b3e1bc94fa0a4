#include <gtest/gtest.h>

#include "tests/unit/subdiv/testCages.h"

namespace cc::test {
namespace {

/// A tag that names nothing is dropped, and a cage would not have what its name says.
TEST(Catalogue, TagsNameWhatIsThere) {
    for (const std::vector<Cage>& cages : {Catalogue(), KnownDifferences()}) {
        for (const Cage& cage : cages) {
            ControlMesh mesh = cage.mesh;
            const ControlMeshReport report = ValidateControlMesh(&mesh, cage.points.size());
            EXPECT_EQ(report.error, "") << cage.name;
            for (const std::string& warning : report.warnings) {
                EXPECT_NE(warning.find("collapsed"), std::string::npos)
                    << cage.name << ": " << warning;
            }
        }
    }
}

}  // namespace
}  // namespace cc::test
