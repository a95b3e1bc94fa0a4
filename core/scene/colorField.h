#pragma once

#include <string>

#include "core/math/vec.h"
#include "core/scene/faceVertices.h"
#include "core/scene/primvar.h"
#include "core/subdiv/faceVaryingChannel.h"
#include "core/subdiv/patchTable.h"

namespace cc {

/// What a mesh without displayColor looks like.
constexpr Vec3f kDefaultDisplayColor{0.18f, 0.18f, 0.18f};

/// A colour primvar spread over the patches of a mesh: constant, one a face, refined like the
/// points, bilinear over each authored face, or a face-varying surface of its own.
class ColorField {
  public:
    /// The default grey.
    ColorField() = default;

    /// Takes a primvar that CheckColor finds nothing wrong with.
    /// @param channel  for face-varying values that are smooth over faces; else empty
    ColorField(Primvar3f color, const PatchTable& patches, FaceVaryingChannel channel = {});

    /// The value at parameters u, v of a patch; patches and faces are those of the same mesh.
    Vec3f Evaluate(const PatchTable& patches, const FaceVertices& faces, uint32_t patch, float u,
                   float v) const;

    /// Gives the primvar back.
    Primvar3f TakePrimvar(size_t cagePointCount);

    size_t Bytes() const;

  private:
    Vec3f _EvaluateBilinear(const FaceVertices& faces, const FaceParameter& at) const;

    /// Vertex primvars hold the values of all patch points, the cage's first, and no indices.
    Primvar3f _color;
    FaceVaryingChannel _channel;
};

/// What is wrong with a colour for a mesh of these faces and this many points: too many or too few
/// elements, indices out of range, values that are not finite. Empty if it can be used; a colour
/// without values gives the default grey and is fine.
std::string CheckColor(const Primvar3f& color, const FaceVertices& faces, size_t pointCount);

}  // namespace cc
