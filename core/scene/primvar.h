#pragma once

#include <cstddef>
#include <vector>

namespace cc {

/// How values are spread over a mesh (UsdGeomPrimvar interpolation), or over its instances.
enum class Interpolation { Constant, Uniform, Varying, Vertex, FaceVarying, Instance };

/// Values of one to four floats on a mesh: displayColor, normals, texture coordinates, whatever a
/// scene names. If indices is not empty, element i has the value that indices[i] names.
struct Primvar {
    Interpolation interpolation = Interpolation::Constant;
    /// Numbers a value, 1 to 4.
    int arity = 3;
    /// The numbers of all values, one value after the other.
    std::vector<float> values;
    std::vector<int> indices;

    bool IsEmpty() const { return values.empty() && indices.empty(); }
    size_t ValueCount() const { return values.size() / static_cast<size_t>(arity); }
    size_t ElementCount() const { return indices.empty() ? ValueCount() : indices.size(); }
    /// The first number of an element.
    const float* Element(size_t i) const {
        const size_t value = indices.empty() ? i : static_cast<size_t>(indices[i]);
        return &values[value * static_cast<size_t>(arity)];
    }

    bool operator==(const Primvar& b) const {
        return interpolation == b.interpolation && arity == b.arity && values == b.values &&
               indices == b.indices;
    }
};

}  // namespace cc
