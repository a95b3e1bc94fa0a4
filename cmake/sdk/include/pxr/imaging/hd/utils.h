#ifndef PXR_IMAGING_HD_UTILS_H
#define PXR_IMAGING_HD_UTILS_H

/// \file
/// What can be asked of a scene index without reading it oneself.

#include "pxr/imaging/hd/api.h"
#include "pxr/imaging/hd/sceneIndex.h"
#include "pxr/pxr.h"
#include "pxr/usd/sdf/path.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace HdUtils {

/// Whether the application has chosen a render settings prim, and which.
HD_API bool HasActiveRenderSettingsPrim(HdSceneIndexBaseRefPtr const &si,
                                        SdfPath *primPath = nullptr);

}  // namespace HdUtils

PXR_NAMESPACE_CLOSE_SCOPE

#endif
