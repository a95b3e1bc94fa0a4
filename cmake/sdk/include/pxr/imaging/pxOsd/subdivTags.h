#ifndef PXR_IMAGING_PX_OSD_SUBDIV_TAGS_H
#define PXR_IMAGING_PX_OSD_SUBDIV_TAGS_H

#include "pxr/base/tf/token.h"
#include "pxr/base/vt/array.h"
#include "pxr/base/vt/types.h"
#include "pxr/imaging/pxOsd/api.h"
#include "pxr/pxr.h"

#include <cstddef>
#include <iosfwd>

PXR_NAMESPACE_OPEN_SCOPE

/// The rules of a subdivision surface, its creases and its corners.
///
/// A rule that nobody has authored is the empty token.
class PxOsdSubdivTags {
  public:
    using ID = size_t;

    PxOsdSubdivTags() = default;
    PxOsdSubdivTags(TfToken const &vertexInterpolationRule,
                    TfToken const &faceVaryingInterpolationRule, TfToken const &creaseMethod,
                    TfToken const &triangleSubdivision, VtIntArray const &creaseIndices,
                    VtIntArray const &creaseLengths, VtFloatArray const &creaseWeights,
                    VtIntArray const &cornerIndices, VtFloatArray const &cornerWeights)
        : _vertexRule(vertexInterpolationRule),
          _faceVaryingRule(faceVaryingInterpolationRule),
          _creaseMethod(creaseMethod),
          _triangleRule(triangleSubdivision),
          _creaseIndices(creaseIndices),
          _creaseLengths(creaseLengths),
          _creaseWeights(creaseWeights),
          _cornerIndices(cornerIndices),
          _cornerWeights(cornerWeights) {}

    TfToken GetVertexInterpolationRule() const { return _vertexRule; }
    TfToken GetFaceVaryingInterpolationRule() const { return _faceVaryingRule; }
    TfToken GetCreaseMethod() const { return _creaseMethod; }
    TfToken GetTriangleSubdivision() const { return _triangleRule; }

    /// Vertices of all creases, one after the other, and how many each crease has.
    VtIntArray const &GetCreaseIndices() const { return _creaseIndices; }
    VtIntArray const &GetCreaseLengths() const { return _creaseLengths; }

    /// Sharpness: one value a crease, or one an edge.
    VtFloatArray const &GetCreaseWeights() const { return _creaseWeights; }

    VtIntArray const &GetCornerIndices() const { return _cornerIndices; }
    VtFloatArray const &GetCornerWeights() const { return _cornerWeights; }

    PXOSD_API ID ComputeHash() const;

  private:
    TfToken _vertexRule;
    TfToken _faceVaryingRule;
    TfToken _creaseMethod;
    TfToken _triangleRule;
    VtIntArray _creaseIndices;
    VtIntArray _creaseLengths;
    VtFloatArray _creaseWeights;
    VtIntArray _cornerIndices;
    VtFloatArray _cornerWeights;
};

PXOSD_API std::ostream &operator<<(std::ostream &out, PxOsdSubdivTags const &);
PXOSD_API bool operator==(PxOsdSubdivTags const &lhs, PxOsdSubdivTags const &rhs);
PXOSD_API bool operator!=(PxOsdSubdivTags const &lhs, PxOsdSubdivTags const &rhs);

PXR_NAMESPACE_CLOSE_SCOPE

#endif
