#pragma once

#include <vector>

#include "core/scene/primvar.h"
#include "core/subdiv/controlMesh.h"
#include "core/subdiv/patchTable.h"

namespace cc::test {

/// A face-varying value that lies on the limit, and where.
struct RefinedValue {
    FaceParameter at;
    std::vector<double> value;
};

/// The limits of face-varying values by Far's uniform refinement, a third opinion where Bfr
/// contradicts it. The values are those of the last level's vertices in the parts of each face that
/// keep its corners, but not of vertices that are no manifold or still semi-sharp, for whose limits
/// Far has no mask.
/// @param mesh  validated, without collapsed edges
std::vector<RefinedValue> RefinedFaceVaryingLimits(const ControlMesh& mesh, size_t pointCount,
                                                   const Primvar& primvar, int levels);

}  // namespace cc::test
