#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/render/renderer.h"
#include "core/scene/scene.h"
#include "tests/unit/subdiv/testCages.h"

namespace cc::test {

inline const std::vector<Aov> kAllAovs = {Aov::Color,  Aov::Depth,      Aov::CameraDepth,
                                          Aov::PrimId, Aov::InstanceId, Aov::ElementId,
                                          Aov::Normal, Aov::Neye};

inline AffineTransform Placed(double scale, double x, double y, double z) {
    return AffineTransform({{{scale, 0, 0, x}, {0, scale, 0, y}, {0, 0, scale, z}}});
}

inline Mesh* AddCage(Scene* scene, const std::string& name, const Cage& cage) {
    Mesh* mesh = scene->AddMesh(name);
    mesh->SetTopology(cage.mesh);
    mesh->SetPoints(cage.points);
    mesh->SetPrimId(0);
    return mesh;
}

/// A primvar of three numbers a value.
inline Primvar Primvar3(Interpolation interpolation, const std::vector<Vec3f>& values,
                        std::vector<int> indices = {}) {
    Primvar primvar{interpolation, 3, {}, std::move(indices)};
    for (const Vec3f& v : values) {
        for (int axis = 0; axis < 3; ++axis) {
            primvar.values.push_back(v[axis]);
        }
    }
    return primvar;
}

inline Primvar ConstantColor(const Vec3f& color) {
    return Primvar3(Interpolation::Constant, {color});
}

/// A flat square of one bilinear face in the xy plane that faces +z, from -1 to 1.
inline Cage Square() {
    Cage cage;
    cage.name = "square";
    cage.mesh.scheme = Scheme::Bilinear;
    cage.mesh.faceVertexCounts = {4};
    cage.mesh.faceVertexIndices = {0, 1, 2, 3};
    cage.points = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    return cage;
}

/// A cage with its faces turned round.
inline Cage Reversed(Cage cage) {
    size_t first = 0;
    for (const int count : cage.mesh.faceVertexCounts) {
        const auto begin = cage.mesh.faceVertexIndices.begin() + first;
        std::vector<int> reversed(std::make_reverse_iterator(begin + count),
                                  std::make_reverse_iterator(begin));
        std::copy(reversed.begin(), reversed.end(), begin);
        first += count;
    }
    return cage;
}

/// A camera on the z axis that looks at the origin; the window is 1 high and wide at distance 2.
inline Camera CameraAt(double z) {
    Camera camera;
    camera.cameraToWorld = Placed(1, 0, 0, z);
    camera.windowLower = {-0.5f, -0.5f};
    camera.windowUpper = {0.5f, 0.5f};
    camera.clipNear = 0.1f;
    camera.clipFar = 100;
    return camera;
}

inline void AddHeadlight(Scene* scene) {
    Light* light = scene->AddLight();
    light->direction = {0, 0, -1};
    light->power = {3.14159265f, 3.14159265f, 3.14159265f};
}

/// All bits of a film.
inline std::string Bits(const Film& film) {
    std::string bits;
    const size_t pixels = size_t(film.Width()) * film.Height();
    for (const Aov& aov : film.Aovs()) {
        const void* plane =
            LayoutOf(aov).isInteger ? static_cast<const void*>(film.Ints(aov)) : film.Floats(aov);
        bits.append(static_cast<const char*>(plane), 4 * pixels * LayoutOf(aov).components);
    }
    return bits;
}

}  // namespace cc::test
