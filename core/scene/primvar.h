#pragma once

#include <vector>

#include "core/math/vec.h"

namespace cc {

/// How values are spread over a mesh (UsdGeomPrimvar interpolation).
enum class Interpolation { Constant, Uniform, Varying, Vertex, FaceVarying };

/// A three-component value on a mesh, such as displayColor. If indices is not empty, element i
/// has the value values[indices[i]].
struct Primvar3f {
    Interpolation interpolation = Interpolation::Constant;
    std::vector<Vec3f> values;
    std::vector<int> indices;

    size_t ElementCount() const { return indices.empty() ? values.size() : indices.size(); }
    const Vec3f& Element(size_t i) const { return values[indices.empty() ? i : indices[i]]; }
};

}  // namespace cc
