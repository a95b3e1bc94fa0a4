#pragma once

#include <vector>

#include "core/math/vec.h"
#include "core/subdiv/extraordinaryPatch.h"
#include "core/subdiv/irregularPatch.h"

namespace cc {

/// Appends points whose convex hull holds a patch's limit surface: the Bezier points of its parts
/// after a subdivision step, and around vertices that are not regular the rings that a few steps
/// leave. Their number and order depend on topology and tags alone, and each is a weighted sum of
/// the control points.
void AppendHull(const IrregularPatch& patch, std::vector<Vec3f>* hull);
void AppendHull(const ExtraordinaryPatch& patch, std::vector<Vec3f>* hull);

}  // namespace cc
