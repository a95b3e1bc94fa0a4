#ifndef PXR_IMAGING_HD_BASIS_CURVES_TOPOLOGY_H
#define PXR_IMAGING_HD_BASIS_CURVES_TOPOLOGY_H

#include "pxr/base/tf/token.h"
#include "pxr/base/vt/array.h"
#include "pxr/base/vt/types.h"
#include "pxr/imaging/hd/api.h"
#include "pxr/imaging/hd/topology.h"
#include "pxr/imaging/hd/version.h"
#include "pxr/pxr.h"

#include <cstddef>

PXR_NAMESPACE_OPEN_SCOPE

/// How a batch of curves is made of its points.
class HdBasisCurvesTopology : public HdTopology {
  public:
    HD_API HdBasisCurvesTopology();
    HD_API HdBasisCurvesTopology(HdBasisCurvesTopology const &);
    HD_API HdBasisCurvesTopology(TfToken const &curveType, TfToken const &curveBasis,
                                 TfToken const &curveWrap, VtIntArray const &curveVertexCounts,
                                 VtIntArray const &curveIndices);
    HD_API ~HdBasisCurvesTopology() override;

    HD_API bool operator==(HdBasisCurvesTopology const &other) const;
    HD_API ID ComputeHash() const override;

    /// linear or cubic
    TfToken GetCurveType() const { return _curveType; }
    /// Of cubic ones: bezier, bspline, catmullRom.
    TfToken GetCurveBasis() const { return _curveBasis; }
    /// nonperiodic, periodic, pinned, segmented
    TfToken GetCurveWrap() const { return _curveWrap; }
    VtIntArray const &GetCurveVertexCounts() const { return _curveVertexCounts; }
    /// Which point each vertex is; empty if they follow each other.
    VtIntArray const &GetCurveIndices() const { return _curveIndices; }
    VtIntArray const &GetInvisiblePoints() const { return _invisiblePoints; }
    VtIntArray const &GetInvisibleCurves() const { return _invisibleCurves; }

  private:
    TfToken _curveType, _curveBasis, _curveWrap;
    VtIntArray _curveVertexCounts, _curveIndices;
    VtIntArray _invisiblePoints, _invisibleCurves;
    size_t _numPoints;
};

PXR_NAMESPACE_CLOSE_SCOPE

#endif
