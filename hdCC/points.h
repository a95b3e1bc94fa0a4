#ifndef HDCC_POINTS_H
#define HDCC_POINTS_H

#include "core/scene/points.h"

#include "pxr/imaging/hd/points.h"
#include "pxr/pxr.h"

#include "hdCC/shape.h"

PXR_NAMESPACE_OPEN_SCOPE

/// A UsdGeomPoints: spheres.
class HdCCPoints final : public HdCCShape<HdPoints> {
  public:
    HdCCPoints(SdfPath const &id, HdCCRenderParam *param);

  protected:
    void _SyncGeometry(HdSceneDelegate *delegate, HdCCRenderParam *param,
                       HdDirtyBits bits) override;
    bool _IsUsable() const override { return _arePoints; }
    bool _HasElements() const override { return _hasPoints; }

  private:
    HdCCPoints(SdfPath const &id, HdCCRenderParam *param, cc::Points *points);

    cc::Points *const _points;
    bool _arePoints = false, _hasPoints = false;
};

PXR_NAMESPACE_CLOSE_SCOPE

#endif
