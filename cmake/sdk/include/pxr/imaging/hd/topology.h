#ifndef PXR_IMAGING_HD_TOPOLOGY_H
#define PXR_IMAGING_HD_TOPOLOGY_H

#include "pxr/imaging/hd/api.h"
#include "pxr/imaging/hd/version.h"
#include "pxr/pxr.h"

#include <cstdint>

PXR_NAMESPACE_OPEN_SCOPE

/// What the topologies of all kinds of geometry have in common: a hash.
class HdTopology {
  public:
    using ID = uint64_t;

    HdTopology() = default;
    virtual ~HdTopology() = default;
    virtual ID ComputeHash() const = 0;
};

PXR_NAMESPACE_CLOSE_SCOPE

#endif
