#include "core/subdiv/faceVaryingChannel.h"

#include <algorithm>
#include <numeric>

#include "core/subdiv/faceVaryingMesh.h"
#include "core/subdiv/patchBuilder.h"

namespace cc {
namespace {

/// Parameters of a patch.
struct PatchParameter {
    float u, v;

    bool IsInside() const { return u >= 0 && u <= 1 && v >= 0 && v <= 1; }
};

/// The inverse of PatchTable::ToFace, for a patch of the same face and corner. Exact, as cells are
/// powers of two.
PatchParameter FromFace(const Patch& patch, const FaceParameter& at) {
    const auto cells = static_cast<float>(1 << (patch.depth - patch.isSubQuad));
    const float u = at.u * cells - static_cast<float>(patch.cellU);
    const float v = at.v * cells - static_cast<float>(patch.cellV);
    switch (patch.rotation) {
        case 1: return {v, 1 - u};
        case 2: return {1 - u, 1 - v};
        case 3: return {1 - v, u};
        default: return {u, v};
    }
}

}  // namespace

FaceVaryingChannel::FaceVaryingChannel(const ControlMesh& mesh, size_t pointCount, int arity,
                                       const std::vector<float>& values,
                                       const std::vector<int>& valueIndices, std::string* error) {
    const FaceVaryingMesh channel = MakeFaceVaryingMesh(mesh, pointCount, valueIndices);
    _patches = BuildPatchTable(channel.mesh, channel.values.size(), error);
    if (!channel.error.empty()) {
        *error = channel.error;
    }
    std::vector<float> vertexValues;
    vertexValues.reserve(channel.values.size() * static_cast<size_t>(arity));
    for (int value : channel.values) {
        const auto first = values.begin() + static_cast<ptrdiff_t>(value) * arity;
        vertexValues.insert(vertexValues.end(), first, first + arity);
    }
    _values = PatchValues(_patches, arity, vertexValues);

    std::vector<uint32_t> order(_patches.Count());
    std::iota(order.begin(), order.end(), 0);
    const auto isBefore = [this](uint32_t a, uint32_t b) {
        return _patches.AuthoredFace(a) < _patches.AuthoredFace(b);
    };
    if (!std::is_sorted(order.begin(), order.end(), isBefore)) {
        std::stable_sort(order.begin(), order.end(), isBefore);
        _byFace = std::move(order);
    }
}

uint32_t FaceVaryingChannel::_PatchAt(size_t i) const {
    return _byFace.empty() ? static_cast<uint32_t>(i) : _byFace[i];
}

uint32_t FaceVaryingChannel::_AuthoredFace(size_t i) const {
    return _patches.AuthoredFace(_PatchAt(i));
}

SurfaceValue FaceVaryingChannel::Evaluate(const FaceParameter& at) const {
    size_t first = 0, count = _patches.Count();
    while (count > 0) {
        const size_t half = count / 2;
        if (_AuthoredFace(first + half) < at.face) {
            first += half + 1;
            count -= half + 1;
        } else {
            count = half;
        }
    }
    for (size_t i = first; i < _patches.Count() && _AuthoredFace(i) == at.face; ++i) {
        const Patch& patch = _patches.At(_PatchAt(i));
        const PatchParameter p = FromFace(patch, at);
        if (patch.corner == at.corner && p.IsInside()) {
            return _values.Evaluate(_patches, _PatchAt(i), p.u, p.v);
        }
    }
    return {};
}

size_t FaceVaryingChannel::Bytes() const {
    return _patches.Bytes() + _values.Bytes() + _byFace.capacity() * sizeof(uint32_t);
}

}  // namespace cc
