#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace cc {

/// What a pixel can hold. Values at pixels that show nothing are the ones Hydra expects.
enum class Aov {
    Color,        ///< 4 floats: linear RGB, coverage. Background 0 0 0 0
    Depth,        ///< 1 float: 0 at the near plane, 1 at the far plane, as projected. Background 1
    CameraDepth,  ///< 1 float: distance along the camera's view axis. Background 0
    PrimId,       ///< 1 int. Background -1
    InstanceId,   ///< 1 int. Background -1
    ElementId,    ///< 1 int: the authored face. Background -1
    Normal,       ///< 3 floats: unit, world space, of the side that is seen. Background 0 0 0
    Neye,         ///< 3 floats: as Normal, in camera space. Background 0 0 0
};

/// Number of components of an AOV, and whether they are 32-bit ints in place of floats.
struct AovLayout {
    int components;
    bool isInteger;
};
AovLayout LayoutOf(Aov aov);
/// Hydra's name of an AOV ("color", "cameraDepth", ...).
const char* NameOf(Aov aov);
/// Returns false if no AOV has that name.
bool AovFromName(const std::string& name, Aov* aov);

/// The picture in the making: one plane an AOV, rows from the bottom up as in Hydra.
class Film {
  public:
    Film() = default;
    /// Planes start out as background.
    Film(int width, int height, std::vector<Aov> aovs);

    int Width() const { return _width; }
    int Height() const { return _height; }
    const std::vector<Aov>& Aovs() const { return _aovs; }
    bool Has(Aov aov) const;

    /// Sets all planes to background.
    void Clear();

    /// The plane of an AOV, components interleaved; null if the film has none or it holds the other
    /// type.
    const float* Floats(Aov aov) const;
    float* Floats(Aov aov);
    const int32_t* Ints(Aov aov) const;
    int32_t* Ints(Aov aov);

  private:
    /// One of the two is empty.
    struct Plane {
        std::vector<float> floats;
        std::vector<int32_t> ints;
    };
    const Plane* _Find(Aov aov) const;

    int _width = 0, _height = 0;
    std::vector<Aov> _aovs;
    std::vector<Plane> _planes;
};

}  // namespace cc
