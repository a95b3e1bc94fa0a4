#ifndef PXR_IMAGING_HD_ENUMS_H
#define PXR_IMAGING_HD_ENUMS_H

#include "pxr/imaging/hd/api.h"
#include "pxr/pxr.h"

PXR_NAMESPACE_OPEN_SCOPE

/// Which sides of a face count as visible.
enum HdCullStyle {
    HdCullStyleDontCare = 0,
    HdCullStyleNothing = 1,
    HdCullStyleBack = 2,
    HdCullStyleFront = 3,
    HdCullStyleBackUnlessDoubleSided = 4,
    HdCullStyleFrontUnlessDoubleSided = 5
};

/// The style that shows what the given one hides.
HD_API HdCullStyle HdInvertCullStyle(HdCullStyle cs);

/// The element of a prim that each value of a primvar belongs to.
enum HdInterpolation {
    HdInterpolationConstant = 0,
    HdInterpolationUniform = 1,
    HdInterpolationVarying = 2,
    HdInterpolationVertex = 3,
    HdInterpolationFaceVarying = 4,
    HdInterpolationInstance = 5,
    HdInterpolationCount = 6
};

PXR_NAMESPACE_CLOSE_SCOPE

#endif
