#ifndef PXR_IMAGING_HD_BASIS_CURVES_H
#define PXR_IMAGING_HD_BASIS_CURVES_H

#include "pxr/imaging/hd/api.h"
#include "pxr/imaging/hd/basisCurvesTopology.h"
#include "pxr/imaging/hd/rprim.h"
#include "pxr/imaging/hd/version.h"
#include "pxr/pxr.h"

PXR_NAMESPACE_OPEN_SCOPE

/// A batch of curves.
class HdBasisCurves : public HdRprim {
  public:
    HD_API ~HdBasisCurves() override;

    HD_API TfTokenVector const &GetBuiltinPrimvarNames() const override;

    HdBasisCurvesTopology GetBasisCurvesTopology(HdSceneDelegate *d) const {
        return d->GetBasisCurvesTopology(GetId());
    }

  protected:
    HD_API HdBasisCurves(SdfPath const &id);
};

PXR_NAMESPACE_CLOSE_SCOPE

#endif
