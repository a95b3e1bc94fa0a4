#ifndef PXR_IMAGING_HD_VERSION_H
#define PXR_IMAGING_HD_VERSION_H

/// \file
/// The revision of Hydra's interface, for sources that have to tell revisions apart. The library
/// does not have the number; 25.08's is above 78 and below 83, where IsSupported changes.

#define HD_API_VERSION 81

#endif
