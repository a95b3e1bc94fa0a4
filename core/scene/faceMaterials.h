#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace cc {

/// Faces of a mesh that have a material of their own.
struct FaceSubset {
    std::string material;
    std::vector<int> faces;

    bool operator==(const FaceSubset& b) const {
        return material == b.material && faces == b.faces;
    }
};

/// Which material each element of a shape has, by name. What materials look like is not known here.
class FaceMaterials {
  public:
    FaceMaterials() = default;
    /// @param whole    of what is in no subset; empty for none
    /// @param warning  set to a line that says which faces are not taken, if any
    FaceMaterials(const std::string& whole, const std::vector<FaceSubset>& subsets,
                  size_t faceCount, std::string* warning);

    /// Empty for those that have none.
    const std::vector<std::string>& Names() const { return _names; }
    /// Which of the names an element has.
    size_t Of(uint32_t element) const { return _ofFaces.empty() ? 0 : _ofFaces[element]; }
    size_t Bytes() const { return _ofFaces.capacity() * sizeof(uint16_t); }

  private:
    std::vector<std::string> _names{std::string()};
    /// Empty if there is only one name.
    std::vector<uint16_t> _ofFaces;
};

}  // namespace cc
