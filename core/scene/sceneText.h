#pragma once

#include "core/scene/camera.h"
#include "core/scene/scene.h"
#include "core/scene/textWriter.h"

namespace cc {

/// Writes all shapes and lights of a built scene, in an order that does not depend on when they
/// came. Shapes that the picture does not show are named, no more.
void WriteText(const Scene& scene, TextWriter* out);

void WriteText(const Camera& camera, TextWriter* out);

}  // namespace cc
