#include "core/scene/primvarField.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/subdiv/controlMesh.h"

namespace cc {
namespace {

struct Expectation {
    size_t count;
    const char* interpolation;
};

Expectation ExpectedElements(Interpolation interpolation, const PrimvarSizes& sizes) {
    switch (interpolation) {
        case Interpolation::Uniform: return {sizes.uniform, "uniform"};
        case Interpolation::Varying: return {sizes.varying, "varying"};
        case Interpolation::Vertex: return {sizes.vertex, "vertex"};
        case Interpolation::FaceVarying: return {sizes.faceVarying, "faceVarying"};
        case Interpolation::Instance: return {sizes.instance, "instance"};
        case Interpolation::Constant: break;
    }
    return {1, "constant"};
}

/// The values of a primvar, element by element.
std::vector<float> Elements(const Primvar& primvar) {
    std::vector<float> values;
    values.reserve(primvar.ElementCount() * static_cast<size_t>(primvar.arity));
    for (size_t i = 0; i < primvar.ElementCount(); ++i) {
        const float* const element = primvar.Element(i);
        values.insert(values.end(), element, element + primvar.arity);
    }
    return values;
}

/// A number bilinear over the unit square, from its corners (0,0) (1,0) (1,1) (0,1).
void SetBilinear(const float corners[4], float u, float v, int i, SurfaceValue* result) {
    const float low = corners[0] * (1 - u) + corners[1] * u;
    const float high = corners[3] * (1 - u) + corners[2] * u;
    result->value[i] = low * (1 - v) + high * v;
    result->du[i] = (corners[1] - corners[0]) * (1 - v) + (corners[2] - corners[3]) * v;
    result->dv[i] = high - low;
}

/// The corners of an authored face that its patches were made of (KeptCorners).
class FaceCorners {
  public:
    FaceCorners(const FaceVertices& faces, uint32_t face)
        : _first(faces.FirstOfFace(face)), _count(faces.CountOfFace(face)) {
        for (int i = 0, previous = _count - 1; i < _count; previous = i++) {
            if (faces.Point(_first + i) == faces.Point(_first + previous)) {
                _Keep(faces);
                return;
            }
        }
    }

    int Count() const { return _count; }
    /// The face-vertex of a kept corner, counted modulo their number.
    size_t FaceVertex(int i) const {
        return _first + (_kept.empty() ? i % _count : _kept[i % _count]);
    }
    /// Which of the kept ones an authored corner is.
    int Find(uint32_t corner) const {
        const auto at = static_cast<int>(corner);
        return _kept.empty()
                   ? at
                   : static_cast<int>(std::find(_kept.begin(), _kept.end(), at) - _kept.begin());
    }

  private:
    void _Keep(const FaceVertices& faces) {
        std::vector<int> points;
        for (int i = 0; i < _count; ++i) {
            points.push_back(static_cast<int>(faces.Point(_first + i)));
        }
        _kept = KeptCorners(points.data(), _count);
        _count = _kept.empty() ? _count : static_cast<int>(_kept.size());
    }

    size_t _first;
    int _count;
    /// Empty if all are kept.
    std::vector<int> _kept;
};

}  // namespace

PrimvarField::PrimvarField(Primvar primvar, const PatchTable& patches, FaceVaryingChannel channel)
    : _primvar(std::move(primvar)), _channel(std::move(channel)) {
    if (_primvar.interpolation == Interpolation::Vertex) {
        _patches = &patches;
        _vertexValues = PatchValues(patches, _primvar.arity, Elements(_primvar));
        _primvar.values = {};
        _primvar.indices = {};
    }
}

SurfaceValue PrimvarField::Evaluate(const PatchTable& patches, const FaceVertices& faces,
                                    const ShapePoint& at) const {
    const auto [instance, patch, u, v] = at;
    size_t element = 0;
    switch (_primvar.interpolation) {
        case Interpolation::Vertex: return _vertexValues.Evaluate(patches, patch, u, v);
        case Interpolation::FaceVarying:
            if (!_channel.IsEmpty()) {
                return _channel.Evaluate(patches.ToFace(patch, u, v));
            }
            [[fallthrough]];
        case Interpolation::Varying:
            return patches.IsTriangle(patch) ? _EvaluateOnTriangle(patches, faces, patch, u, v)
                                             : _EvaluateOnQuad(faces, patches.ToFace(patch, u, v));
        case Interpolation::Uniform: element = patches.AuthoredFace(patch); break;
        case Interpolation::Instance: element = instance; break;
        case Interpolation::Constant: break;
    }
    return AtElement(element);
}

SurfaceValue PrimvarField::AtElement(size_t i) const {
    SurfaceValue result;
    std::copy_n(_primvar.Element(i), _primvar.arity, result.value);
    return result;
}

const float* PrimvarField::_AtFaceVertex(const FaceVertices& faces, size_t faceVertex) const {
    const bool isFaceVarying = _primvar.interpolation == Interpolation::FaceVarying;
    return _primvar.Element(isFaceVarying ? faceVertex : faces.Point(faceVertex));
}

SurfaceValue PrimvarField::_EvaluateOnTriangle(const PatchTable& patches, const FaceVertices& faces,
                                               uint32_t patch, float u, float v) const {
    const size_t first = faces.FirstOfFace(patches.AuthoredFace(patch));
    const PolygonTriangle corners = patches.TriangleCorners(patch);
    const float* const a = _AtFaceVertex(faces, first + corners[0]);
    const float* const b = _AtFaceVertex(faces, first + corners[1]);
    const float* const c = _AtFaceVertex(faces, first + corners[2]);
    SurfaceValue result;
    for (int i = 0; i < _primvar.arity; ++i) {
        result.value[i] = a[i] * (1 - u - v) + (b[i] * u + c[i] * v);
        result.du[i] = b[i] - a[i];
        result.dv[i] = c[i] - a[i];
    }
    return result;
}

SurfaceValue PrimvarField::_EvaluateOnQuad(const FaceVertices& faces,
                                           const FaceParameter& at) const {
    const FaceCorners corners(faces, at.face);
    const int count = corners.Count();
    const auto number = [&](int corner, int i) {
        return _AtFaceVertex(faces, corners.FaceVertex(corner))[i];
    };
    SurfaceValue result;
    for (int i = 0; i < _primvar.arity; ++i) {
        float quad[4];
        if (count == 4) {
            for (int corner = 0; corner < 4; ++corner) {
                quad[corner] = number(corner, i);
            }
        } else {
            // The sub-quad of a corner ends at the middles of its two edges and at the face's
            // centre.
            float sum = 0;
            for (int corner = 0; corner < count; ++corner) {
                sum += number(corner, i);
            }
            const int c = corners.Find(at.corner);
            quad[0] = number(c, i);
            quad[1] = (quad[0] + number(c + 1, i)) * 0.5f;
            quad[2] = sum / static_cast<float>(count);
            quad[3] = (quad[0] + number(c + count - 1, i)) * 0.5f;
        }
        SetBilinear(quad, at.u, at.v, i, &result);
    }
    return result;
}

bool PrimvarField::IsMadeOf(const Primvar& primvar) const {
    if (!_patches) {
        return _primvar == primvar;
    }
    return primvar.interpolation == Interpolation::Vertex && primvar.arity == _primvar.arity &&
           primvar.ElementCount() == _patches->CagePointCount() &&
           std::all_of(
               primvar.indices.begin(), primvar.indices.end(),
               [&](int i) { return i >= 0 && static_cast<size_t>(i) < primvar.ValueCount(); }) &&
           Elements(primvar) == _vertexValues.CageValues(*_patches);
}

Primvar PrimvarField::CopyPrimvar() const {
    Primvar primvar = _primvar;
    if (_patches) {
        primvar.values = _vertexValues.CageValues(*_patches);
    }
    return primvar;
}

Primvar PrimvarField::TakePrimvar() {
    if (_patches) {
        _primvar.values = _vertexValues.CageValues(*_patches);
    }
    Primvar primvar = std::move(_primvar);
    *this = PrimvarField();
    return primvar;
}

size_t PrimvarField::Bytes() const {
    return _primvar.values.capacity() * sizeof(float) + _primvar.indices.capacity() * sizeof(int) +
           _vertexValues.Bytes() + _channel.Bytes();
}

std::string CheckPrimvarSize(const std::string& name, const Primvar& primvar,
                             const PrimvarSizes& sizes) {
    const Expectation expected = ExpectedElements(primvar.interpolation, sizes);
    if (primvar.ElementCount() != expected.count) {
        return name + " is " + expected.interpolation + " and has " +
               std::to_string(primvar.ElementCount()) + " elements where " +
               std::to_string(expected.count) + " belong";
    }
    for (const int index : primvar.indices) {
        if (index < 0 || static_cast<size_t>(index) >= primvar.ValueCount()) {
            return name + " has index " + std::to_string(index) + " and only " +
                   std::to_string(primvar.ValueCount()) + " values";
        }
    }
    return {};
}

std::string CheckPrimvar(const std::string& name, const Primvar& primvar,
                         const PrimvarSizes& sizes) {
    std::string error = CheckPrimvarSize(name, primvar, sizes);
    if (!error.empty()) {
        return error;
    }
    const auto isFinite = [](float number) { return std::isfinite(number); };
    if (!std::all_of(primvar.values.begin(), primvar.values.end(), isFinite)) {
        return name + " has values that are not finite";
    }
    return {};
}

}  // namespace cc
