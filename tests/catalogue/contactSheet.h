#pragma once

#include <string>

namespace cc::test {

/// The contact sheet as the text of a USD scene: the cages of SheetThemes in rows, each turned,
/// centred and scaled to fill its cell, with its name below; a camera and a light.
/// @param error  set to the reason if there is none
std::string ContactSheet(std::string* error);

}  // namespace cc::test
