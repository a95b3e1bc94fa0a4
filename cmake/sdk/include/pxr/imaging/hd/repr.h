#ifndef PXR_IMAGING_HD_REPR_H
#define PXR_IMAGING_HD_REPR_H

#include "pxr/base/tf/token.h"
#include "pxr/imaging/hd/api.h"
#include "pxr/pxr.h"

#include <cstddef>
#include <memory>

PXR_NAMESPACE_OPEN_SCOPE

/// Storage that a rasterizer hangs on a way of drawing a prim. A tracer leaves it null.
class HdRepr;
using HdReprSharedPtr = std::shared_ptr<HdRepr>;

/// The ways in which a prim should be drawn: as a surface, as its cage, as its points.
class HdReprSelector {
  public:
    static size_t const MAX_TOPOLOGY_REPRS = 3;

    explicit HdReprSelector(TfToken const &refined = {}, TfToken const &unrefined = {},
                            TfToken const &points = {})
        : _refined(refined), _unrefined(unrefined), _points(points) {}

    HD_API bool Contains(TfToken const &reprToken) const;
    HD_API bool IsActiveRepr(size_t topologyIndex) const;
    HD_API bool AnyActiveRepr() const;
    HD_API bool operator==(HdReprSelector const &rhs) const;
    HD_API bool operator!=(HdReprSelector const &rhs) const;
    HD_API TfToken const &operator[](size_t topologyIndex) const;

  private:
    TfToken _refined;
    TfToken _unrefined;
    TfToken _points;
};

PXR_NAMESPACE_CLOSE_SCOPE

#endif
