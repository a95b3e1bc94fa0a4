#pragma once

#include "core/scene/camera.h"
#include "core/trace/levelMetric.h"

namespace cc {

/// What levels need to know of a camera and the picture it makes. A crop is cut as the whole is.
/// @param width,height  of what is rendered, in pixels
LevelView MakeLevelView(const Camera& camera, int width, int height);

}  // namespace cc
