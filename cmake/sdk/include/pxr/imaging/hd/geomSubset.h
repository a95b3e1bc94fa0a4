#ifndef PXR_IMAGING_HD_GEOM_SUBSET_H
#define PXR_IMAGING_HD_GEOM_SUBSET_H

#include "pxr/base/vt/array.h"
#include "pxr/base/vt/types.h"
#include "pxr/imaging/hd/api.h"
#include "pxr/imaging/hd/version.h"
#include "pxr/pxr.h"
#include "pxr/usd/sdf/path.h"

#include <vector>

PXR_NAMESPACE_OPEN_SCOPE

/// Faces of a mesh that have a material of their own.
struct HdGeomSubset {
    enum Type { TypeFaceSet = 0 };

    Type type;
    SdfPath id;
    SdfPath materialId;
    VtIntArray indices;
};

using HdGeomSubsets = std::vector<HdGeomSubset>;

HD_API bool operator==(HdGeomSubset const &lhs, HdGeomSubset const &rhs);

PXR_NAMESPACE_CLOSE_SCOPE

#endif
