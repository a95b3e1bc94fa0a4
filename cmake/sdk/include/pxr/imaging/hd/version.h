#ifndef PXR_IMAGING_HD_VERSION_H
#define PXR_IMAGING_HD_VERSION_H

/// \file
/// The revision of Hydra's interface, for sources that have to tell revisions apart.

#define HD_API_VERSION 81

#endif
