#pragma once

#include <string>

#include "tests/unit/subdiv/testCages.h"

namespace cc::test {

/// Where a prim stands: scaled, turned about z, tilted about x and moved, in this order.
struct SheetPlace {
    Vec3f scale{1, 1, 1};
    float spin = 0, tilt = 0;  ///< degrees
    Vec3f move;
};

/// A name that a prim may have: letters and digits, and underscores for all else.
std::string PrimName(const std::string& name);

/// A cage as the text of a Mesh prim with all of its tags, its faces in three shades of a colour by
/// turns. UsdGeomMesh has no crease rule: that must be CreaseRule::Uniform.
/// @param prim  the prim's name
/// @param indentation  what each line begins with
std::string MeshPrim(const Cage& cage, const std::string& prim, const SheetPlace& place,
                     const Vec3f& color, const std::string& indentation);

/// A number in as few digits as bring back the same float.
std::string ToText(float value);

}  // namespace cc::test
