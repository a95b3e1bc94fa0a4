#ifndef PXR_IMAGING_PXOSD_API_H
#define PXR_IMAGING_PXOSD_API_H

/// \file
/// How pxOsd's symbols are marked: always imported, since the library comes ready-built.

#include "pxr/base/arch/export.h"

#define PXOSD_API ARCH_IMPORT

#endif
