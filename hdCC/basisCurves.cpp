#include "hdCC/basisCurves.h"

#include <utility>
#include <vector>

#include "pxr/base/tf/diagnostic.h"

PXR_NAMESPACE_OPEN_SCOPE

HdCCBasisCurves::HdCCBasisCurves(SdfPath const &id, HdCCRenderParam *param)
    : HdCCBasisCurves(id, param, param->GetScene()->AddCurves(id.GetString())) {}

HdCCBasisCurves::HdCCBasisCurves(SdfPath const &id, HdCCRenderParam *param, cc::Curves *curves)
    : HdCCShape(id, param, curves), _curves(curves) {}

void HdCCBasisCurves::_SyncGeometry(HdSceneDelegate *delegate, HdCCRenderParam *,
                                    HdDirtyBits bits) {
    if (bits & HdChangeTracker::DirtyTopology) {
        _SyncTopology(delegate);
    }
    if (bits & (HdChangeTracker::DirtyPoints | HdChangeTracker::DirtyComputationPrimvarDesc)) {
        cc::Moving<std::vector<cc::Vec3f>> points;
        _arePoints =
            HdCCSyncPoints(delegate, GetId(), "curves are", _GetParam()->GetShutter(), &points);
        _curves->SetMovingPoints(std::move(points));
    }
    if (bits & (HdChangeTracker::DirtyWidths | HdChangeTracker::DirtyPrimvar)) {
        _curves->SetWidths(HdCCSyncValues(delegate, GetId(), TfToken("widths")));
    }
    if (bits & (HdChangeTracker::DirtyNormals | HdChangeTracker::DirtyPrimvar)) {
        _curves->SetNormals(HdCCSyncValues(delegate, GetId(), TfToken("normals")));
    }
}

/// Returns false if there is no such basis.
static bool _ToBasis(HdBasisCurvesTopology const &topology, cc::CurveBasis *basis) {
    if (topology.GetCurveType() == "linear") {
        *basis = cc::CurveBasis::Linear;
    } else if (topology.GetCurveBasis() == "bezier") {
        *basis = cc::CurveBasis::Bezier;
    } else if (topology.GetCurveBasis() == "bspline") {
        *basis = cc::CurveBasis::BSpline;
    } else if (topology.GetCurveBasis() == "catmullRom") {
        *basis = cc::CurveBasis::CatmullRom;
    } else {
        return false;
    }
    return true;
}

/// Returns false if there is no such wrap.
static bool _ToWrap(TfToken const &token, cc::CurveWrap *wrap) {
    if (token == "nonperiodic") {
        *wrap = cc::CurveWrap::Nonperiodic;
    } else if (token == "periodic") {
        *wrap = cc::CurveWrap::Periodic;
    } else if (token == "pinned") {
        *wrap = cc::CurveWrap::Pinned;
    } else {
        return false;
    }
    return true;
}

void HdCCBasisCurves::_SyncTopology(HdSceneDelegate *delegate) {
    const HdBasisCurvesTopology topology = delegate->GetBasisCurvesTopology(GetId());
    cc::CurveTopology curves;
    const bool hasBasis = _ToBasis(topology, &curves.basis);
    const bool hasWrap = _ToWrap(topology.GetCurveWrap(), &curves.wrap);
    const bool isIndexed = !topology.GetCurveIndices().empty();
    if (!hasBasis) {
        TF_WARN("<%s>: curves of type '%s' and basis '%s' are not supported; they are left out",
                GetId().GetText(), topology.GetCurveType().GetText(),
                topology.GetCurveBasis().GetText());
    } else if (!hasWrap || isIndexed) {
        TF_WARN("<%s>: %s%s%s not supported; the curves are left out", GetId().GetText(),
                isIndexed ? "indices of curves are" : "the wrap '",
                isIndexed ? "" : topology.GetCurveWrap().GetText(), isIndexed ? "" : "' is");
    }
    VtIntArray const &counts = topology.GetCurveVertexCounts();
    curves.vertexCounts.assign(counts.cbegin(), counts.cend());
    _hasTopology = hasBasis && hasWrap && !isIndexed;
    _hasCurves = !counts.empty();
    _curves->SetTopology(std::move(curves));
}

PXR_NAMESPACE_CLOSE_SCOPE
