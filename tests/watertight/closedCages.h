#pragma once

#include <vector>

#include "tests/unit/subdiv/testCages.h"

namespace cc::test {

/// The cages of the catalogue that enclose something: every edge of a face is an edge of just one
/// other, which runs along it the other way. Holes are filled: they are faces like others.
std::vector<Cage> ClosedCages();

}  // namespace cc::test
