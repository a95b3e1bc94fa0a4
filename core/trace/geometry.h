#pragma once

#include <cstddef>
#include <cstdint>

#include "core/bvh/bvh.h"
#include "core/math/box.h"
#include "core/math/vec.h"

namespace cc {

struct Instance;
class LevelMetric;

/// The kinds of geometry: each is a class of its own, and tracers have an intersector for each.
enum class GeometryKind {
    Surface,        ///< class Surface
    Spheres,        ///< class Spheres
    CurveSegments,  ///< class CurveSegments
};

/// A ray's hit on a geometry, in the geometry's own space.
struct GeometryHit {
    uint32_t primitive = 0;
    float u = 0, v = 0;        ///< in the primitive
    Vec3f origin, direction;   ///< of the ray; the direction has any length
    Vec3f position = Vec3f();  ///< where the ray ends
};

/// What a geometry is like where a ray hits it, in its own space.
struct GeometryPoint {
    Vec3f position;
    Vec3f normal;   ///< unit and outward; zero where there is none
    Vec3f du, dv;   ///< derivatives of the position by parameters that the geometry chooses
    bool isBehind;  ///< the ray hit the inner side, which the normal points away from
};

/// Something that rays can hit, in a space of its own: primitives, and a BVH over them. Hits name a
/// primitive and two parameters in it.
class Geometry {
  public:
    virtual ~Geometry();
    Geometry(const Geometry&) = delete;
    Geometry& operator=(const Geometry&) = delete;

    GeometryKind Kind() const { return _kind; }
    const Bvh& PrimitiveBvh() const { return _bvh; }
    /// Bounds of all primitives.
    const Box3f& Bounds() const { return _bvh.Bounds(); }

    virtual size_t PrimitiveCount() const = 0;
    /// What shading needs to know of a hit.
    /// @param instance  of this geometry, that was hit
    /// @param levels    that the tracer traced
    virtual GeometryPoint PointAt(const GeometryHit& hit, const Instance& instance,
                                  const LevelMetric& levels) const = 0;
    /// Memory held, in bytes.
    virtual size_t Bytes() const = 0;

  protected:
    explicit Geometry(GeometryKind kind) : _kind(kind) {}

    Bvh _bvh;

  private:
    const GeometryKind _kind;
};

}  // namespace cc
