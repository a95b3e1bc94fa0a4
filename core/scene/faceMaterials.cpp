#include "core/scene/faceMaterials.h"

#include <limits>

namespace cc {
namespace {

constexpr size_t kMostNames = std::numeric_limits<uint16_t>::max();

std::string Describe(size_t missing, size_t taken, size_t subsetsLeftOut) {
    std::string text;
    const auto add = [&text](size_t count, const char* what) {
        if (count > 0) {
            text += (text.empty() ? "" : ", ") + std::to_string(count) + what;
        }
    };
    add(missing, " indices of faces that there are not");
    add(taken, " faces that an earlier subset has");
    add(subsetsLeftOut, " subsets too many");
    return text.empty() ? text : "its subsets have " + text + "; they are ignored";
}

}  // namespace

FaceMaterials::FaceMaterials(const std::string& whole, const std::vector<FaceSubset>& subsets,
                             size_t faceCount, std::string* warning)
    : _names{whole} {
    size_t missing = 0, taken = 0, subsetsLeftOut = 0;
    for (const FaceSubset& subset : subsets) {
        if (_names.size() == kMostNames) {
            ++subsetsLeftOut;
            continue;
        }
        const auto name = static_cast<uint16_t>(_names.size());
        _names.push_back(subset.material);
        _ofFaces.resize(faceCount, 0);
        for (const int face : subset.faces) {
            if (face < 0 || static_cast<size_t>(face) >= faceCount) {
                ++missing;
            } else if (_ofFaces[face] == 0) {
                _ofFaces[face] = name;
            } else {
                taken += _ofFaces[face] != name;
            }
        }
    }
    *warning = Describe(missing, taken, subsetsLeftOut);
}

}  // namespace cc
