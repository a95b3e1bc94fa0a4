#ifndef PXR_IMAGING_HD_API_H
#define PXR_IMAGING_HD_API_H

/// \file
/// How Hydra's symbols are marked: always imported, since the library comes ready-built.

#include "pxr/base/arch/export.h"

#define HD_API ARCH_IMPORT

#endif
