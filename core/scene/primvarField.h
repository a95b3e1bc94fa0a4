#pragma once

#include <string>
#include <utility>

#include "core/scene/faceVertices.h"
#include "core/scene/primvar.h"
#include "core/subdiv/faceVaryingChannel.h"
#include "core/subdiv/patchTable.h"
#include "core/subdiv/patchValues.h"

namespace cc {

/// A point of a shape that a ray hits: of which of its instances it is, and where on the shape.
struct ShapePoint {
    uint32_t instance = 0;
    uint32_t primitive = 0;  ///< of the shape's geometry
    float u = 0, v = 0;      ///< in the primitive
};

/// A primvar spread over a shape, or over its instances. Over the patches of a mesh it is constant,
/// one a face, refined like the points, linear over each authored face, or a face-varying surface
/// of its own; other shapes take its elements and spread them by themselves.
class PrimvarField {
  public:
    /// A field without values, which must not be evaluated.
    PrimvarField() = default;

    /// Takes a primvar that has values and that CheckPrimvar finds nothing wrong with.
    explicit PrimvarField(Primvar primvar) : _primvar(std::move(primvar)) {}

    /// The same for a mesh. The field refers to its patches.
    /// @param channel  for face-varying values that are smooth over faces; else empty
    PrimvarField(Primvar primvar, const PatchTable& patches, FaceVaryingChannel channel = {});

    bool IsEmpty() const { return _primvar.arity == 0; }
    /// Numbers a value, 1 to 4.
    int Arity() const { return _primvar.arity; }

    /// The value at a point, and its derivatives by the parameters of the authored face, zero for
    /// constant, uniform and instance ones. Patches and faces are those of the mesh.
    SurfaceValue Evaluate(const PatchTable& patches, const FaceVertices& faces,
                          const ShapePoint& at) const;

    Interpolation GetInterpolation() const { return _primvar.interpolation; }
    /// The first number of an element, of a field that was made without patches.
    const float* Element(size_t i) const { return _primvar.Element(i); }
    /// The same element as a value that does not change along the shape.
    SurfaceValue AtElement(size_t i) const;

    bool IsOfInstances() const { return _primvar.interpolation == Interpolation::Instance; }

    /// True if the field is made of just these values.
    bool IsMadeOf(const Primvar& primvar) const;
    /// The primvar that the field is made of. Indices of vertex primvars are resolved.
    Primvar CopyPrimvar() const;
    /// Gives it back; the field is empty then.
    Primvar TakePrimvar();

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
    /// That _vertexValues are spread over; null if there are none.
    const PatchTable* _patches = nullptr;
    FaceVaryingChannel _channel;
};

/// How many elements a primvar of each interpolation has on a shape; a constant one has one.
struct PrimvarSizes {
    size_t uniform, varying, vertex, faceVarying, instance;
};

/// What is wrong with how many elements a primvar has, on a shape of these sizes, and with its
/// indices; empty if nothing is.
std::string CheckPrimvarSize(const std::string& name, const Primvar& primvar,
                             const PrimvarSizes& sizes);

/// The same, and whether values are not finite. Empty if the primvar can be used.
std::string CheckPrimvar(const std::string& name, const Primvar& primvar,
                         const PrimvarSizes& sizes);

}  // namespace cc
