#include "core/scene/colorField.h"

#include <algorithm>
#include <utility>

#include "core/subdiv/limitPoint.h"

namespace cc {
namespace {

Vec3f Lerp(const Vec3f& a, const Vec3f& b, float t) { return a * (1 - t) + b * t; }

struct Expectation {
    size_t count;
    const char* interpolation;
};

Expectation ExpectedElements(Interpolation interpolation, const FaceVertices& faces,
                             size_t pointCount) {
    switch (interpolation) {
        case Interpolation::Uniform: return {faces.FaceCount(), "uniform"};
        case Interpolation::Varying: return {pointCount, "varying"};
        case Interpolation::Vertex: return {pointCount, "vertex"};
        case Interpolation::FaceVarying: return {faces.Count(), "faceVarying"};
        case Interpolation::Constant: break;
    }
    return {1, "constant"};
}

}  // namespace

ColorField::ColorField(Primvar3f color, const PatchTable& patches, FaceVaryingChannel channel)
    : _color(std::move(color)), _channel(std::move(channel)) {
    if (_color.values.empty() || _color.interpolation != Interpolation::Vertex) {
        return;
    }
    if (!_color.indices.empty()) {
        std::vector<Vec3f> values(_color.ElementCount());
        for (size_t i = 0; i < values.size(); ++i) {
            values[i] = _color.Element(i);
        }
        _color.values = std::move(values);
        _color.indices = {};
    }
    _color.values = patches.PatchPoints(_color.values);
}

Vec3f ColorField::Evaluate(const PatchTable& patches, const FaceVertices& faces, uint32_t patch,
                           float u, float v) const {
    if (_color.values.empty()) {
        return kDefaultDisplayColor;
    }
    switch (_color.interpolation) {
        case Interpolation::Uniform: return _color.Element(patches.AuthoredFace(patch));
        case Interpolation::Vertex:
            return EvaluateLimitValue(patches, patch, _color.values.data(), u, v);
        case Interpolation::FaceVarying:
            if (!_channel.IsEmpty()) {
                return _channel.Evaluate(patches.ToFace(patch, u, v));
            }
            [[fallthrough]];
        case Interpolation::Varying: return _EvaluateBilinear(faces, patches.ToFace(patch, u, v));
        case Interpolation::Constant: break;
    }
    return _color.Element(0);
}

Vec3f ColorField::_EvaluateBilinear(const FaceVertices& faces, const FaceParameter& at) const {
    const size_t first = faces.FirstOfFace(at.face);
    const int count = faces.CountOfFace(at.face);
    const auto corner = [&](int i) {
        const size_t faceVertex = first + i % count;
        return _color.Element(_color.interpolation == Interpolation::FaceVarying
                                  ? faceVertex
                                  : faces.Point(faceVertex));
    };
    if (at.isTriangle) {
        return corner(0) * (1 - at.u - at.v) + (corner(1) * at.u + corner(2) * at.v);
    }
    Vec3f quad[4];
    if (count == 4) {
        for (int i = 0; i < 4; ++i) {
            quad[i] = corner(i);
        }
    } else {
        // The sub-quad of a corner ends at the middles of its two edges and at the face's centre.
        Vec3f sum;
        for (int i = 0; i < count; ++i) {
            sum += corner(i);
        }
        const int c = static_cast<int>(at.corner);
        quad[0] = corner(c);
        quad[1] = (quad[0] + corner(c + 1)) * 0.5f;
        quad[2] = sum * (1 / static_cast<float>(count));
        quad[3] = (quad[0] + corner(c + count - 1)) * 0.5f;
    }
    return Lerp(Lerp(quad[0], quad[1], at.u), Lerp(quad[3], quad[2], at.u), at.v);
}

Primvar3f ColorField::TakePrimvar(size_t cagePointCount) {
    if (_color.interpolation == Interpolation::Vertex && _color.values.size() > cagePointCount) {
        _color.values.resize(cagePointCount);
    }
    _channel = {};
    return std::exchange(_color, {});
}

size_t ColorField::Bytes() const {
    return _color.values.capacity() * sizeof(Vec3f) + _color.indices.capacity() * sizeof(int) +
           _channel.Bytes();
}

std::string CheckColor(const Primvar3f& color, const FaceVertices& faces, size_t pointCount) {
    if (color.values.empty() && color.indices.empty()) {
        return {};
    }
    const Expectation expected = ExpectedElements(color.interpolation, faces, pointCount);
    if (color.ElementCount() != expected.count) {
        return std::string("displayColor is ") + expected.interpolation + " and has " +
               std::to_string(color.ElementCount()) + " elements where " +
               std::to_string(expected.count) + " belong";
    }
    for (const int index : color.indices) {
        if (index < 0 || static_cast<size_t>(index) >= color.values.size()) {
            return "displayColor has index " + std::to_string(index) + " and only " +
                   std::to_string(color.values.size()) + " values";
        }
    }
    if (!std::all_of(color.values.begin(), color.values.end(), IsFinite)) {
        return "displayColor has values that are not finite";
    }
    return {};
}

}  // namespace cc
