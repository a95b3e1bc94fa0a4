#pragma once

#include <vector>

#include "core/bvh/bvh.h"
#include "core/math/transform.h"
#include "core/trace/surface.h"

namespace cc {

/// A surface placed in the world.
struct Instance {
    const Surface* surface = nullptr;
    AffineTransform objectToWorld;
    AffineTransform worldToObject;
    /// True if the surface's own space is the world: rays need no transform. Set by InstanceBvh.
    bool isInPlace = false;
};

/// The top level: instances and a BVH over their world bounds. What a tracer traces.
class InstanceBvh {
  public:
    InstanceBvh() = default;
    explicit InstanceBvh(std::vector<Instance> instances);

    const std::vector<Instance>& Instances() const { return _instances; }
    const Bvh& TopLevel() const { return _bvh; }
    Box3f Bounds() const { return _bvh.Bounds(); }

  private:
    std::vector<Instance> _instances;
    Bvh _bvh;
};

}  // namespace cc
