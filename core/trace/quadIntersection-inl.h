// Per-target include guard, as Highway's foreach_target asks for.
#if defined(CC_TRACE_QUAD_INTERSECTION_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CC_TRACE_QUAD_INTERSECTION_INL_H
#undef CC_TRACE_QUAD_INTERSECTION_INL_H
#else
#define CC_TRACE_QUAD_INTERSECTION_INL_H
#endif

#include <hwy/highway.h>

#include "core/math/vec.h"
#include "core/trace/objectRays.h"

HWY_BEFORE_NAMESPACE();
namespace cc {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// As many rays as a vector of D has lanes.
template <class D>
struct RayLanes {
    using V = hn::Vec<D>;
    V ox, oy, oz, dx, dy, dz;

    HWY_INLINE RayLanes(D d, const ObjectRays& rays, size_t first)
        : ox(hn::Load(d, rays.originX + first)),
          oy(hn::Load(d, rays.originY + first)),
          oz(hn::Load(d, rays.originZ + first)),
          dx(hn::Load(d, rays.directionX + first)),
          dy(hn::Load(d, rays.directionY + first)),
          dz(hn::Load(d, rays.directionZ + first)) {}
};

/// Corners of a quad seen from the rays' origins.
template <class D>
struct CornerLanes {
    using V = hn::Vec<D>;
    V x, y, z;

    HWY_INLINE CornerLanes(D d, const RayLanes<D>& rays, const Vec3f& corner)
        : x(hn::Sub(hn::Set(d, corner.x), rays.ox)),
          y(hn::Sub(hn::Set(d, corner.y), rays.oy)),
          z(hn::Sub(hn::Set(d, corner.z), rays.oz)) {}
};

/// Six times the signed volume between a ray's direction and the edge from a to b. The other
/// direction of the edge gives exactly the negative: two triangles agree on who has the ray.
template <class D>
HWY_INLINE hn::Vec<D> EdgeVolume(const RayLanes<D>& rays, const CornerLanes<D>& a,
                                 const CornerLanes<D>& b) {
    const auto ex = hn::Sub(b.x, a.x), ey = hn::Sub(b.y, a.y), ez = hn::Sub(b.z, a.z);
    const auto sx = hn::Add(b.x, a.x), sy = hn::Add(b.y, a.y), sz = hn::Add(b.z, a.z);
    const auto nx = hn::Sub(hn::Mul(ey, sz), hn::Mul(ez, sy));
    const auto ny = hn::Sub(hn::Mul(ez, sx), hn::Mul(ex, sz));
    const auto nz = hn::Sub(hn::Mul(ex, sy), hn::Mul(ey, sx));
    return hn::Add(hn::Add(hn::Mul(nx, rays.dx), hn::Mul(ny, rays.dy)), hn::Mul(nz, rays.dz));
}

/// Where rays hit a triangle. Lanes outside hit are meaningless.
template <class D>
struct TriangleHit {
    hn::Mask<D> hit;
    hn::Vec<D> t;
    hn::Vec<D> weightB, weightC;  ///< barycentric, of the second and third corner
};

/// Intersects rays with a triangle, inside-outside test first (paper, section 3.5).
/// @param slack  an edge volume this far on the wrong side still counts as inside: what rounding
///               may part between neighbouring patches
template <class D>
HWY_INLINE TriangleHit<D> IntersectTriangle(D d, const RayLanes<D>& rays, const CornerLanes<D>& a,
                                            const CornerLanes<D>& b, const CornerLanes<D>& c,
                                            hn::Vec<D> slack, hn::Vec<D> tMin, hn::Vec<D> tMax) {
    TriangleHit<D> result{};
    const auto volumeA = EdgeVolume(rays, b, c);
    const auto volumeB = EdgeVolume(rays, c, a);
    const auto volumeC = EdgeVolume(rays, a, b);
    const auto least = hn::Min(hn::Min(volumeA, volumeB), volumeC);
    const auto most = hn::Max(hn::Max(volumeA, volumeB), volumeC);
    result.hit = hn::Or(hn::Ge(least, hn::Neg(slack)), hn::Le(most, slack));
    if (hn::AllFalse(d, result.hit)) {
        return result;
    }
    const auto sum = hn::Add(hn::Add(volumeA, volumeB), volumeC);
    // The plane through the triangle.
    const auto e1x = hn::Sub(b.x, a.x), e1y = hn::Sub(b.y, a.y), e1z = hn::Sub(b.z, a.z);
    const auto e2x = hn::Sub(c.x, a.x), e2y = hn::Sub(c.y, a.y), e2z = hn::Sub(c.z, a.z);
    const auto nx = hn::Sub(hn::Mul(e1y, e2z), hn::Mul(e1z, e2y));
    const auto ny = hn::Sub(hn::Mul(e1z, e2x), hn::Mul(e1x, e2z));
    const auto nz = hn::Sub(hn::Mul(e1x, e2y), hn::Mul(e1y, e2x));
    const auto along =
        hn::Add(hn::Add(hn::Mul(nx, rays.dx), hn::Mul(ny, rays.dy)), hn::Mul(nz, rays.dz));
    const auto height = hn::Add(hn::Add(hn::Mul(nx, a.x), hn::Mul(ny, a.y)), hn::Mul(nz, a.z));
    const auto zero = hn::Zero(d);
    result.t = hn::Div(height, along);
    // A triangle thinner than the slack has no plane worth the name; its neighbours have the ray.
    result.hit = hn::And(result.hit, hn::Gt(hn::Max(most, hn::Neg(least)), slack));
    result.hit = hn::And(result.hit, hn::And(hn::Ne(along, zero), hn::Ne(sum, zero)));
    result.hit = hn::And(result.hit, hn::And(hn::Ge(result.t, tMin), hn::Le(result.t, tMax)));
    const auto inverse = hn::Div(hn::Set(d, 1.0f), sum);
    const auto one = hn::Set(d, 1.0f);
    result.weightB = hn::Min(hn::Max(hn::Mul(volumeB, inverse), zero), one);
    result.weightC = hn::Min(hn::Max(hn::Mul(volumeC, inverse), zero), one);
    return result;
}

}  // namespace HWY_NAMESPACE
}  // namespace cc
HWY_AFTER_NAMESPACE();

#endif
