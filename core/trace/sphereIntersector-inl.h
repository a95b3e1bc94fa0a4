// Per-target include guard, as Highway's foreach_target asks for.
#if defined(CC_TRACE_SPHERE_INTERSECTOR_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef CC_TRACE_SPHERE_INTERSECTOR_INL_H
#undef CC_TRACE_SPHERE_INTERSECTOR_INL_H
#else
#define CC_TRACE_SPHERE_INTERSECTOR_INL_H
#endif

#include <hwy/highway.h>

#include "core/trace/boxTests-inl.h"
#include "core/trace/rayPacket.h"
#include "core/trace/spheres.h"

HWY_BEFORE_NAMESPACE();
namespace cc {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Where lines meet a sphere: distances along them in units of length. Lines that miss have numbers
/// that are not.
template <class V>
struct SphereRoots {
    V near, far;
};

/// The quadratic equation of Haines, Gunther and Akenine-Moeller 2019 (Precision improvements for
/// ray/sphere intersection): exact enough for small spheres that are far away and for large ones
/// that are near.
/// @param x, y, z     from the sphere's centre to the origin of the line
/// @param dx, dy, dz  the line's direction, of length 1
template <class D, class V = hn::Vec<D>>
HWY_INLINE SphereRoots<V> IntersectSphere(D d, V x, V y, V z, V dx, V dy, V dz, V radius) {
    const auto dot = [](V ax, V ay, V az, V bx, V by, V bz) {
        return hn::MulAdd(ax, bx, hn::MulAdd(ay, by, hn::Mul(az, bz)));
    };
    // Towards the middle of the chord.
    const V b = hn::Neg(dot(x, y, z, dx, dy, dz));
    const V lx = hn::MulAdd(b, dx, x), ly = hn::MulAdd(b, dy, y), lz = hn::MulAdd(b, dz, z);
    const V l = hn::Sqrt(dot(lx, ly, lz, lx, ly, lz));
    // Squares of a chord's half, and the power of the origin, by factors that hardly cancel.
    const V square = hn::Mul(hn::Sub(radius, l), hn::Add(radius, l));
    const V length = hn::Sqrt(dot(x, y, z, x, y, z));
    const V power = hn::Mul(hn::Sub(length, radius), hn::Add(length, radius));
    const V q = hn::Add(b, hn::CopySign(hn::Sqrt(square), b));
    const V other = hn::IfThenElseZero(hn::Ne(q, hn::Zero(d)), hn::Div(power, q));
    return {hn::Min(q, other), hn::Max(q, other)};
}

/// Intersects rays with the spheres of one geometry.
/// @tparam Rays     PacketRays or SingleRay
/// @tparam kAnyHit  rays end at whatever they hit first, and hits are not recorded
template <class Rays, bool kAnyHit>
class SphereIntersector {
  public:
    /// @param number  of the instance, as hits give it
    SphereIntersector(const Spheres& spheres, uint32_t number, Rays* rays, HitPacket* hits)
        : _spheres(spheres), _instance(number), _rays(*rays), _hits(hits) {}

    /// @param hitting  a bit for each ray that hits the sphere's box
    /// Returns true if a ray hits it.
    bool Intersect(uint32_t index, uint64_t hitting) {
        const Tag d;
        const int lanes = static_cast<int>(hn::Lanes(d));
        const uint64_t group = (uint64_t(1) << lanes) - 1;
        const Sphere& sphere = _spheres.At(index);
        bool isHit = false;
        for (int first = 0; first < _rays.rays.count; first += lanes) {
            const uint64_t among = hitting >> first & group;
            if (among != 0) {
                isHit |= _IntersectGroup(index, sphere, first, among);
            }
        }
        return isHit;
    }

  private:
    using Tag = typename Rays::Tag;

    bool _IntersectGroup(uint32_t index, const Sphere& sphere, int first, uint64_t among) {
        const Tag d;
        ObjectRays& rays = _rays.rays;
        const auto length = hn::Load(d, rays.length + first);
        const auto inverse = hn::Div(hn::Set(d, 1.0f), length);
        const auto roots = IntersectSphere(
            d, hn::Sub(hn::Load(d, rays.originX + first), hn::Set(d, sphere.center.x)),
            hn::Sub(hn::Load(d, rays.originY + first), hn::Set(d, sphere.center.y)),
            hn::Sub(hn::Load(d, rays.originZ + first), hn::Set(d, sphere.center.z)),
            hn::Mul(hn::Load(d, rays.directionX + first), inverse),
            hn::Mul(hn::Load(d, rays.directionY + first), inverse),
            hn::Mul(hn::Load(d, rays.directionZ + first), inverse), hn::Set(d, sphere.radius));
        const auto tMin = hn::Load(d, rays.tMin + first), tMax = hn::Load(d, rays.tMax + first);
        const auto near = hn::Mul(roots.near, inverse), far = hn::Mul(roots.far, inverse);
        // The near end, unless it lies behind the ray's begin.
        const auto t = hn::IfThenElse(hn::Gt(near, tMin), near, far);
        const auto hit = hn::And(hn::Gt(t, tMin), hn::Lt(t, tMax));
        alignas(64) float distance[hn::MaxLanes(Tag())];
        hn::Store(t, d, distance);
        const uint64_t bits = LaneBits(d, hit) & among;
        for (uint64_t rest = bits; rest != 0; rest &= rest - 1) {
            const int lane = __builtin_ctzll(rest);
            _Record(index, sphere, first + lane, distance[lane]);
        }
        return bits != 0;
    }

    void _Record(uint32_t index, const Sphere& sphere, int ray, float t) {
        ObjectRays& rays = _rays.rays;
        if (kAnyHit) {
            rays.tMax[ray] = -1;
            return;
        }
        rays.tMax[ray] = t;
        const Vec3f begin =
            Vec3f{rays.originX[ray], rays.originY[ray], rays.originZ[ray]} - sphere.center;
        const Vec3f direction{rays.directionX[ray], rays.directionY[ray], rays.directionZ[ray]};
        const Vec2f parameters = SphereParameters(begin + direction * t);
        _hits->instance[ray] = _instance;
        _hits->patch[ray] = index;
        _hits->u[ray] = parameters.x;
        _hits->v[ray] = parameters.y;
    }

    const Spheres& _spheres;
    const uint32_t _instance;
    Rays& _rays;
    HitPacket* const _hits;
};

}  // namespace HWY_NAMESPACE
}  // namespace cc
HWY_AFTER_NAMESPACE();

#endif
