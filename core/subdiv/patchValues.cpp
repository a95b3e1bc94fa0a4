#include "core/subdiv/patchValues.h"

#include <algorithm>

#include "core/subdiv/limitPoint.h"

namespace cc {

PatchValues::PatchValues(const PatchTable& patches, int arity, const std::vector<float>& cageValues)
    : _arity(arity) {
    for (int first = 0; first < arity; first += 3) {
        std::vector<Vec3f> plane(patches.CagePointCount());
        for (size_t point = 0; point < plane.size(); ++point) {
            for (int i = first; i < std::min(arity, first + 3); ++i) {
                plane[point][i - first] = cageValues[point * static_cast<size_t>(arity) + i];
            }
        }
        _planes[first / 3] = patches.PatchPoints(plane);
    }
}

SurfaceValue PatchValues::Evaluate(const PatchTable& patches, uint32_t patch, float u,
                                   float v) const {
    SurfaceValue result;
    for (int first = 0; first < _arity; first += 3) {
        const LimitPoint limit = ByFaceParameter(
            patches, patch, EvaluateLimit(patches, patch, _planes[first / 3].data(), u, v));
        for (int i = first; i < std::min(_arity, first + 3); ++i) {
            result.value[i] = limit.position[i - first];
            result.du[i] = limit.du[i - first];
            result.dv[i] = limit.dv[i - first];
        }
    }
    return result;
}

std::vector<float> PatchValues::CageValues(const PatchTable& patches) const {
    std::vector<float> values;
    values.reserve(patches.CagePointCount() * static_cast<size_t>(_arity));
    for (size_t point = 0; point < patches.CagePointCount(); ++point) {
        for (int i = 0; i < _arity; ++i) {
            values.push_back(_planes[i / 3][point][i % 3]);
        }
    }
    return values;
}

size_t PatchValues::Bytes() const {
    return (_planes[0].capacity() + _planes[1].capacity()) * sizeof(Vec3f);
}

}  // namespace cc
