#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace cc {

/// What a pixel can hold. Values at pixels that show nothing are the ones Hydra expects.
struct Aov {
    enum Kind {
        Color,  ///< 4 floats: linear RGB, coverage. Background 0 0 0 0
        Depth,  ///< 1 float: 0 at the near plane, 1 at the far plane, as projected. Background 1
        CameraDepth,  ///< 1 float: distance along the camera's view axis. Background 0
        PrimId,       ///< 1 int. Background -1
        InstanceId,   ///< 1 int. Background -1
        ElementId,    ///< 1 int: the authored face. Background -1
        Normal,       ///< 3 floats: the shading normal, unit, world space. Background 0 0 0
        Neye,         ///< 3 floats: as Normal, in camera space. Background 0 0 0
        Material,     ///< 1 int: which of Scene::MaterialNames. Background and none -1
        Level,        ///< 1 int: of the patch. Background -1
        Fan,      ///< 1 int: 1 where a patch is stitched to a coarser one, else 0. Background -1
        Cost,     ///< 1 float: steps that the packet took, a ray. Background 0
        Primvar,  ///< floats: a primvar of the mesh that is seen. Background 0
    };
    Kind kind = Color;
    /// Of the kind Primvar: its name, without the prefix primvars:, and its numbers a value, 1 to
    /// 4. Fewer leave the last ones of a mesh out, more are zero.
    std::string primvar = {};
    int arity = 3;

    Aov() = default;
    Aov(Kind k) : kind(k) {}
    Aov(Kind k, std::string name, int numbers)
        : kind(k), primvar(std::move(name)), arity(numbers) {}

    /// The same plane, whatever the arity.
    bool operator==(const Aov& b) const { return kind == b.kind && primvar == b.primvar; }
    bool operator!=(const Aov& b) const { return !(*this == b); }
};

/// Number of components of an AOV, and whether they are 32-bit ints in place of floats.
struct AovLayout {
    int components;
    bool isInteger;
};
AovLayout LayoutOf(const Aov& aov);
/// Hydra's name of an AOV ("color", "cameraDepth", "primvars:st", ...).
std::string NameOf(const Aov& aov);
/// Returns false if no AOV has that name. Primvars have three numbers a value until more is known.
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
    bool Has(const Aov& aov) const;
    /// Of a plane that the film has, with the arity that the film was made with.
    AovLayout Layout(const Aov& aov) const;

    /// Sets all planes to background.
    void Clear();

    /// The plane of an AOV, components interleaved; null if the film has none or it holds the other
    /// type.
    const float* Floats(const Aov& aov) const;
    float* Floats(const Aov& aov);
    const int32_t* Ints(const Aov& aov) const;
    int32_t* Ints(const Aov& aov);
    /// Of a primvar's plane, a byte a pixel: 0 where nothing is seen that has the primvar. Null for
    /// other planes.
    const uint8_t* Coverage(const Aov& aov) const;
    uint8_t* Coverage(const Aov& aov);

  private:
    /// Either floats or ints is empty.
    struct Plane {
        std::vector<float> floats;
        std::vector<int32_t> ints;
        std::vector<uint8_t> coverage;
    };
    const Plane* _Find(const Aov& aov) const;

    int _width = 0, _height = 0;
    std::vector<Aov> _aovs;
    std::vector<Plane> _planes;
};

}  // namespace cc
