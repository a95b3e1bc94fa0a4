#ifndef HDCC_BASIS_CURVES_H
#define HDCC_BASIS_CURVES_H

#include "core/scene/curves.h"

#include "pxr/imaging/hd/basisCurves.h"
#include "pxr/pxr.h"

#include "hdCC/shape.h"

PXR_NAMESPACE_OPEN_SCOPE

/// A UsdGeomBasisCurves: tubes, or with normals ribbons.
class HdCCBasisCurves final : public HdCCShape<HdBasisCurves> {
  public:
    HdCCBasisCurves(SdfPath const &id, HdCCRenderParam *param);

  protected:
    void _SyncGeometry(HdSceneDelegate *delegate, HdCCRenderParam *param,
                       HdDirtyBits bits) override;
    bool _IsUsable() const override { return _hasTopology && _arePoints; }
    bool _HasElements() const override { return _hasCurves; }

  private:
    HdCCBasisCurves(SdfPath const &id, HdCCRenderParam *param, cc::Curves *curves);

    void _SyncTopology(HdSceneDelegate *delegate);

    cc::Curves *const _curves;
    bool _hasTopology = false, _arePoints = false, _hasCurves = false;
};

PXR_NAMESPACE_CLOSE_SCOPE

#endif
