#include "core/trace/geometry.h"

namespace cc {

Geometry::~Geometry() = default;

}  // namespace cc
