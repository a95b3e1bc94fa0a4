#ifndef PXR_IMAGING_HF_API_H
#define PXR_IMAGING_HF_API_H

/// \file
/// How the plugin foundation's symbols are marked: always imported, since the library comes
/// ready-built.

#include "pxr/base/arch/export.h"

#define HF_API ARCH_IMPORT

#endif
