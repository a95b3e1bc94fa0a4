#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/math/transform.h"
#include "core/scene/moving.h"
#include "core/trace/instance.h"

namespace cc {

/// Where a shape stands in the world: in one place, or wherever its instances are. Both may move:
/// the numbers of their transforms change steadily from pose to pose.
class Placement {
  public:
    /// Moves the shape, each instance of it in that instance's own space.
    /// Returns true if that changes anything.
    bool SetTransform(Moving<AffineTransform> objectToWorld);
    /// Puts instances in the place of the shape itself; none is nowhere. Each map is applied after
    /// the shape's own transform.
    /// @param instanceToWorld  every pose has as many
    void SetInstances(Moving<std::vector<AffineTransform>> instanceToWorld);
    /// Puts the shape itself back. Returns true if there were instances.
    bool ClearInstances();

    const Moving<AffineTransform>& Transform() const { return _objectToWorld; }
    /// Null if the shape stands by itself.
    const Moving<std::vector<AffineTransform>>* Instances() const {
        return _instances ? &*_instances : nullptr;
    }
    bool IsInstanced() const { return _instances.has_value(); }
    size_t Count() const { return _instances ? _instances->Poses()[0].size() : 1; }
    bool IsMoving() const {
        return _objectToWorld.IsMoving() || (_instances && _instances->IsMoving());
    }

    enum class Obstacle { None, Singular, TooLarge };
    /// Puts a geometry into a place, 0..Count()-1, as it is at a time (Moving). If that cannot be,
    /// the instance is left alone.
    Obstacle Place(const Geometry& geometry, size_t index, float time, Instance* instance) const;
    /// What keeps a geometry from a place at the time of some pose, or at time 0.
    Obstacle FindObstacle(const Geometry& geometry, size_t index) const;
    /// Bounds in the world of a box that is in a place at all times.
    Box3f WorldBox(size_t index, const Box3f& box) const;

    /// What keeps a geometry from how many of its places.
    struct Obstacles {
        size_t singular = 0, tooLarge = 0;

        size_t Count() const { return singular + tooLarge; }
        bool operator==(const Obstacles& b) const {
            return singular == b.singular && tooLarge == b.tooLarge;
        }
    };
    /// Looks for those of all places, in parallel.
    Obstacles FindObstacles(const Geometry& geometry) const;
    /// Says them in lines for people, without the name of what is placed.
    /// @param is  what is placed, and its verb: "the mesh is"
    std::vector<std::string> Describe(const Obstacles& obstacles, const std::string& is) const;

    /// Memory held, in bytes.
    size_t Bytes() const;

  private:
    std::string _DescribeOne(size_t count, const std::string& ofOne, const char* ofInstances) const;
    AffineTransform _ObjectToWorld(size_t index, float time) const;
    void _NoteTimes();

    Moving<AffineTransform> _objectToWorld;
    /// Without a value the shape is not instanced.
    std::optional<Moving<std::vector<AffineTransform>>> _instances;
    /// Those of all poses, and 0.
    std::vector<float> _times{0};
};

}  // namespace cc
