#pragma once

#include <string>

#include "core/scene/faceVertices.h"
#include "core/scene/primvar.h"
#include "core/subdiv/faceVaryingChannel.h"
#include "core/subdiv/patchTable.h"
#include "core/subdiv/patchValues.h"

namespace cc {

/// A point of a mesh that a ray hits: of which of its instances it is, and where on the mesh.
struct MeshPoint {
    uint32_t instance = 0;
    uint32_t patch = 0;
    float u = 0, v = 0;
};

/// A primvar spread over the patches of a mesh: constant, one a face, refined like the points,
/// linear over each authored face, or a face-varying surface of its own; or over its instances.
class PrimvarField {
  public:
    /// A field without values, which must not be evaluated.
    PrimvarField() = default;

    /// Takes a primvar that has values and that CheckPrimvar finds nothing wrong with.
    /// @param channel  for face-varying values that are smooth over faces; else empty
    PrimvarField(Primvar primvar, const PatchTable& patches, FaceVaryingChannel channel = {});

    bool IsEmpty() const { return _primvar.arity == 0; }
    /// Numbers a value, 1 to 4.
    int Arity() const { return _primvar.arity; }

    /// The value at a point, and its derivatives by the parameters of the authored face, zero for
    /// constant, uniform and instance ones. Patches and faces are those of the mesh.
    SurfaceValue Evaluate(const PatchTable& patches, const FaceVertices& faces,
                          const MeshPoint& at) const;

    bool IsOfInstances() const { return _primvar.interpolation == Interpolation::Instance; }

    /// True if the field is made of just these values.
    bool IsMadeOf(const Primvar& primvar, const PatchTable& patches) const;
    /// Gives the primvar back; the field is empty then. Indices of vertex primvars are resolved.
    Primvar TakePrimvar(const PatchTable& patches);

    /// Memory held, in bytes.
    size_t Bytes() const;

  private:
    /// Of varying and faceVarying values.
    const float* _AtFaceVertex(const FaceVertices& faces, size_t faceVertex) const;
    SurfaceValue _EvaluateOnTriangle(const PatchTable& patches, const FaceVertices& faces,
                                     uint32_t patch, float u, float v) const;
    SurfaceValue _EvaluateOnQuad(const FaceVertices& faces, const FaceParameter& at) const;

    /// Without the values if they are in _vertexValues.
    Primvar _primvar{Interpolation::Constant, 0, {}, {}};
    PatchValues _vertexValues;
    FaceVaryingChannel _channel;
};

/// How many elements a primvar may have on a mesh.
struct PrimvarSizes {
    const FaceVertices& faces;
    size_t pointCount;
    size_t instanceCount;
};

/// What is wrong with a primvar for a mesh of these sizes: too many or too few elements, indices
/// out of range, values that are not finite. Empty if it can be used.
std::string CheckPrimvar(const std::string& name, const Primvar& primvar,
                         const PrimvarSizes& sizes);

}  // namespace cc
