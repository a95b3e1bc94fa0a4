#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/bvh/bvh.h"
#include "core/math/transform.h"
#include "core/trace/surface.h"

namespace cc {

/// A geometry placed in the world.
struct Instance {
    const Geometry* geometry = nullptr;
    AffineTransform objectToWorld;
    AffineTransform worldToObject;
    /// True if the geometry's own space is the world: rays need no transform. Set by InstanceBvh.
    bool isInPlace = false;
};

/// The geometry of an instance that is known to have a surface.
inline const Surface& SurfaceOf(const Instance& instance) {
    return static_cast<const Surface&>(*instance.geometry);
}

/// What lies below a node, or below one child of it, of the hierarchy of an instance's geometry.
struct InstancePart {
    uint32_t instance;
    uint32_t node;  ///< of the geometry's PrimitiveBvh
    int slot;       ///< of the child, or kWhole

    static constexpr int kWhole = -1;
};

/// The top level: a BVH over the world bounds of parts of instances. What a tracer traces.
///
/// Large instances are opened: their nodes stand in the top level by themselves, so that rays meet
/// what is near first, even where instances overlap (Benthin, Woop, Wald, Afra 2017: partial
/// re-braiding).
class InstanceBvh {
  public:
    /// Gives the bounds in the world of a box of an instance's surface, wherever the instance
    /// moves.
    using WorldBox = std::function<Box3f(size_t instance, const Box3f& box)>;

    InstanceBvh() = default;
    /// Of instances that rest.
    explicit InstanceBvh(std::vector<Instance> instances);
    /// @param worldBox  may be called from many threads
    InstanceBvh(std::vector<Instance> instances, const WorldBox& worldBox);

    /// Puts an instance elsewhere in what bounds it. Different ones may be moved from different
    /// threads.
    void Move(size_t index, const AffineTransform& objectToWorld,
              const AffineTransform& worldToObject);

    const std::vector<Instance>& Instances() const { return _instances; }
    /// Its primitives are instances.
    const Bvh& TopLevel() const { return _bvh; }
    /// Each primitive of each instance is in one of them.
    const std::vector<InstancePart>& Parts() const { return _parts; }
    /// Its primitives are parts.
    const Bvh& PartBvh() const { return _partBvh; }
    size_t Bytes() const {
        return _bvh.Bytes() + _partBvh.Bytes() + _parts.capacity() * sizeof(InstancePart);
    }
    Box3f Bounds() const { return _bvh.Bounds(); }

  private:
    void _Build(const WorldBox& worldBox);

    std::vector<Instance> _instances;
    Bvh _bvh;
    std::vector<InstancePart> _parts;
    Bvh _partBvh;
};

}  // namespace cc
