#include "core/trace/spheres.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cc {
namespace {

constexpr double kPi = 3.14159265358979323846;

/// Below this cosine between ray and normal, rounding may turn the normal.
constexpr float kGrazingCosine = 1e-3f;

/// Boxes are that much larger than spheres, in parts of their largest coordinate: hits round.
constexpr float kBoxSlack = 5e-7f;

Box3f BoxOf(const Sphere& sphere) {
    Box3f box;
    if (!(sphere.radius > 0)) {
        return box;
    }
    const Vec3f& c = sphere.center;
    const float largest = std::max({std::fabs(c.x), std::fabs(c.y), std::fabs(c.z)});
    const float r = sphere.radius + kBoxSlack * (largest + sphere.radius);
    box.lower = c - Vec3f{r, r, r};
    box.upper = c + Vec3f{r, r, r};
    return box;
}

std::vector<Box3f> BoxesOf(const std::vector<Sphere>& spheres) {
    std::vector<Box3f> boxes(spheres.size());
    std::transform(spheres.begin(), spheres.end(), boxes.begin(), BoxOf);
    return boxes;
}

}  // namespace

Spheres::Spheres(std::vector<Sphere> spheres)
    : Geometry(GeometryKind::Spheres), _spheres(std::move(spheres)) {
    _bvh = Bvh(BoxesOf(_spheres));
}

void Spheres::Move(std::vector<Sphere> spheres) {
    _spheres = std::move(spheres);
    _bvh.Move(BoxesOf(_spheres));
}

void Spheres::SetPoses(const std::vector<std::vector<Sphere>>& poses) {
    std::vector<Box3f> boxes(_spheres.size());
    for (const std::vector<Sphere>& pose : poses) {
        for (size_t i = 0; i < boxes.size(); ++i) {
            boxes[i].Extend(BoxOf(pose[i]));
        }
    }
    _bvh.Move(boxes);
}

GeometryPoint Spheres::PointAt(const GeometryHit& hit, const Instance&, const LevelMetric&) const {
    const Sphere& sphere = _spheres[hit.primitive];
    const double longitude = 2 * kPi * hit.u, angle = kPi * hit.v;
    const double x = std::cos(longitude), y = std::sin(longitude);
    const double width = std::sin(angle), height = std::cos(angle), r = sphere.radius;
    const auto vector = [](double a, double b, double c) {
        return Vec3f{static_cast<float>(a), static_cast<float>(b), static_cast<float>(c)};
    };
    GeometryPoint point;
    point.normal = Normalize(vector(width * x, width * y, height));
    point.position = sphere.center + point.normal * sphere.radius;
    point.du = vector(-2 * kPi * r * width * y, 2 * kPi * r * width * x, 0);
    point.dv = vector(kPi * r * height * x, kPi * r * height * y, -kPi * r * width);
    const float cosine = Dot(point.normal, Normalize(hit.direction));
    point.isBehind = std::fabs(cosine) > kGrazingCosine
                         ? cosine > 0
                         : Length(hit.origin - sphere.center) < sphere.radius;
    return point;
}

size_t Spheres::Bytes() const { return _spheres.capacity() * sizeof(Sphere) + _bvh.Bytes(); }

Vec2f SphereParameters(const Vec3f& direction) {
    const double x = direction.x, y = direction.y, z = direction.z;
    const double turn = std::atan2(y, x) / (2 * kPi);
    const double tilt = std::atan2(std::hypot(x, y), z) / kPi;
    return {std::min(static_cast<float>(turn < 0 ? turn + 1 : turn), 1.0f),
            static_cast<float>(tilt)};
}

}  // namespace cc
