#include "hdCC/points.h"

#include <utility>
#include <vector>

PXR_NAMESPACE_OPEN_SCOPE

HdCCPoints::HdCCPoints(SdfPath const &id, HdCCRenderParam *param)
    : HdCCPoints(id, param, param->GetScene()->AddPoints(id.GetString())) {}

HdCCPoints::HdCCPoints(SdfPath const &id, HdCCRenderParam *param, cc::Points *points)
    : HdCCShape(id, param, points), _points(points) {}

void HdCCPoints::_SyncGeometry(HdSceneDelegate *delegate, HdCCRenderParam *, HdDirtyBits bits) {
    if (bits & (HdChangeTracker::DirtyPoints | HdChangeTracker::DirtyComputationPrimvarDesc)) {
        cc::Moving<std::vector<cc::Vec3f>> points;
        _arePoints =
            HdCCSyncPoints(delegate, GetId(), "points are", _GetParam()->GetShutter(), &points);
        _hasPoints = !points.Poses().front().empty();
        _points->SetMovingPoints(std::move(points));
    }
    if (bits & (HdChangeTracker::DirtyWidths | HdChangeTracker::DirtyPrimvar)) {
        _points->SetWidths(HdCCSyncValues(delegate, GetId(), TfToken("widths")));
    }
}

PXR_NAMESPACE_CLOSE_SCOPE
