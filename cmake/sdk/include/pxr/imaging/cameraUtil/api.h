#ifndef PXR_IMAGING_CAMERAUTIL_API_H
#define PXR_IMAGING_CAMERAUTIL_API_H

/// \file
/// How cameraUtil's symbols are marked: always imported, since the library comes ready-built.

#include "pxr/base/arch/export.h"

#define CAMERAUTIL_API ARCH_IMPORT

#endif
