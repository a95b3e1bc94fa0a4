#ifndef PXR_IMAGING_HD_POINTS_H
#define PXR_IMAGING_HD_POINTS_H

#include "pxr/imaging/hd/api.h"
#include "pxr/imaging/hd/rprim.h"
#include "pxr/imaging/hd/version.h"
#include "pxr/pxr.h"

PXR_NAMESPACE_OPEN_SCOPE

/// Points that have a size.
class HdPoints : public HdRprim {
  public:
    HD_API HdPoints(SdfPath const &id);
    HD_API ~HdPoints() override;

    HD_API TfTokenVector const &GetBuiltinPrimvarNames() const override;
};

PXR_NAMESPACE_CLOSE_SCOPE

#endif
