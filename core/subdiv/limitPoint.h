#pragma once

#include <cstdint>

#include "core/math/vec.h"
#include "core/subdiv/patchTable.h"

namespace cc {

/// A point of the limit surface and the plane that touches it there.
struct LimitPoint {
    Vec3f position;
    /// Derivatives by the patch's parameters u and v. At an extraordinary vertex, where the
    /// parameterization has none, tangents of arbitrary length.
    Vec3f du, dv;
    /// Unit normal, outward for a right-handed mesh (left-handed ones are flipped already);
    /// zero where the surface has none.
    Vec3f normal;
};

/// Evaluates a patch at u, v in 0..1, where u + v <= 1 on a triangle (PatchTable::IsTriangle).
/// @param values  one value a patch point: positions, or any vertex primvar refined alike
LimitPoint EvaluateLimit(const PatchTable& patches, uint32_t patch, const Vec3f* values, float u,
                         float v);

/// The same point with derivatives by the parameters of the authored face (PatchTable::ToFace) in
/// place of the patch's own.
LimitPoint ByFaceParameter(const PatchTable& patches, uint32_t patch, LimitPoint point);

/// As EvaluateLimit, without the derivatives: for primvars.
Vec3f EvaluateLimitValue(const PatchTable& patches, uint32_t patch, const Vec3f* values, float u,
                         float v);

}  // namespace cc
