#pragma once

#include <utility>
#include <vector>

#include "core/trace/geometry.h"

namespace cc {

struct Sphere {
    Vec3f center;
    float radius = 0;
};

/// Spheres that rays can hit, exactly. Hits have u, the longitude from the x axis over the y axis
/// in full turns, and v, the angle from the z axis in half turns.
class Spheres final : public Geometry {
  public:
    /// Spheres whose radius is not above zero are there and not hit.
    explicit Spheres(std::vector<Sphere> spheres);

    /// Takes other spheres, as many as before: the BVH follows them (Bvh::Move).
    void Move(std::vector<Sphere> spheres);

    /// Makes bounds hold for several poses of the spheres, and for all that is between any two.
    /// @param poses  each has as many spheres as before, of the same radii
    void SetPoses(const std::vector<std::vector<Sphere>>& poses);
    /// Moves the spheres to between two of the poses.
    void Pose(std::vector<Sphere> spheres) { _spheres = std::move(spheres); }

    const Sphere& At(uint32_t sphere) const { return _spheres[sphere]; }

    size_t PrimitiveCount() const override { return _spheres.size(); }
    GeometryPoint PointAt(const GeometryHit& hit, const Instance& instance,
                          const LevelMetric& levels) const override;
    size_t Bytes() const override;

  private:
    std::vector<Sphere> _spheres;
};

/// A direction from a sphere's centre as the parameters u and v of hits.
Vec2f SphereParameters(const Vec3f& direction);

}  // namespace cc
