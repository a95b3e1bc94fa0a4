#pragma once

#include <cstddef>
#include <cstdint>

#include "core/math/box.h"
#include "core/subdiv/limitGridPlan.h"

namespace cc {

/// Boxes of the Bezier points of bicubic B-splines' four quarters, which hold them.
/// @param indices  of the 16 points of each patch
/// @param boxes    written, one a patch
void BSplineBoxes(const uint32_t* const* indices, size_t count, const Vec3f* points, Box3f* boxes);

/// Box of a patch's hull, by a plan that has one.
/// @param indices  the patch's control points (GatherControlPoints)
Box3f PlannedHullBox(const LimitGridPlan& plan, const ControlPoints& indices, const Vec3f* points);

}  // namespace cc
