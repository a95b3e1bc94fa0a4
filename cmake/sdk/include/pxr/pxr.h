#ifndef PXR_H
#define PXR_H

/// \file
/// The version and the namespace of the OpenUSD that these headers describe.
///
/// The base libraries' headers each bring a namespace of their own; tools/setup makes all of them
/// the runtime's, so one pair of macros serves, as in a stock install.

#include "pxr/arch/pxr.h"

#define PXR_MAJOR_VERSION 0
#define PXR_MINOR_VERSION 25
#define PXR_PATCH_VERSION 8
#define PXR_VERSION 2508

#define PXR_USE_NAMESPACES 1
#define PXR_NS ARCH_NS
#define PXR_INTERNAL_NS ARCH_INTERNAL_NS
#define PXR_NS_GLOBAL ::PXR_NS

#define PXR_NAMESPACE_OPEN_SCOPE namespace PXR_INTERNAL_NS {
#define PXR_NAMESPACE_CLOSE_SCOPE }
#define PXR_NAMESPACE_USING_DIRECTIVE using namespace PXR_NS;

#endif
