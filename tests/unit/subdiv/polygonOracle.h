#pragma once

#include <memory>
#include <vector>

#include "core/subdiv/controlMesh.h"
#include "tests/unit/subdiv/limitOracle.h"

namespace cc::test {

/// The surface of scheme none, in floats: each polygon as the triangles of TriangulatePolygon,
/// whose own tests say that they cover it. Its values are the points again.
std::unique_ptr<LimitOracle> MakePolygonOracle(const ControlMesh& mesh,
                                               const std::vector<Vec3f>& points);

}  // namespace cc::test
