#pragma once

#include <string>
#include <vector>

#include "tests/unit/subdiv/testCages.h"

namespace cc::test {

/// Cages that belong together and are shown in one colour.
struct SheetTheme {
    std::string name;
    Vec3f color;
    std::vector<Cage> cages;
};

/// True if what a cage is about is below it.
bool IsSeenFromBelow(const Cage& cage);

/// What the contact sheet shows, in its order: of each kind of cage of the catalogue a few, without
/// those that USD cannot say (Chaikin's crease rule), and some under the schemes without
/// subdivision or smoothing.
/// @param error  set to the name of a cage that the catalogue lacks
std::vector<SheetTheme> SheetThemes(std::string* error);

}  // namespace cc::test
