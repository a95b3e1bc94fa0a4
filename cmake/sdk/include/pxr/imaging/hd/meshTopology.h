#ifndef PXR_IMAGING_HD_MESH_TOPOLOGY_H
#define PXR_IMAGING_HD_MESH_TOPOLOGY_H

#include "pxr/base/tf/token.h"
#include "pxr/base/vt/array.h"
#include "pxr/base/vt/types.h"
#include "pxr/imaging/hd/api.h"
#include "pxr/imaging/hd/geomSubset.h"
#include "pxr/imaging/hd/topology.h"
#include "pxr/imaging/hd/version.h"
#include "pxr/imaging/pxOsd/meshTopology.h"
#include "pxr/pxr.h"

#include <memory>

PXR_NAMESPACE_OPEN_SCOPE

using HdMeshTopologySharedPtr = std::shared_ptr<class HdMeshTopology>;

/// A mesh's topology as Hydra hands it over, with the subsets of its faces.
///
/// Invisible faces and points are what imaging hides; a hole is authored with the mesh.
class HdMeshTopology : public HdTopology {
  public:
    HD_API HdMeshTopology();
    HD_API HdMeshTopology(HdMeshTopology const &, int refineLevel = 0);
    HD_API HdMeshTopology(PxOsdMeshTopology const &, int refineLevel = 0);
    HD_API HdMeshTopology(TfToken const &scheme, TfToken const &orientation,
                          VtIntArray const &faceVertexCounts, VtIntArray const &faceVertexIndices,
                          int refineLevel = 0);
    HD_API HdMeshTopology(TfToken const &scheme, TfToken const &orientation,
                          VtIntArray const &faceVertexCounts, VtIntArray const &faceVertexIndices,
                          VtIntArray const &holeIndices, int refineLevel = 0);
    HD_API ~HdMeshTopology() override;

    HD_API HdMeshTopology &operator=(HdMeshTopology const &copy);
    HD_API bool operator==(HdMeshTopology const &other) const;
    HD_API ID ComputeHash() const override;

    PxOsdMeshTopology const &GetPxOsdMeshTopology() const { return _topology; }

    TfToken const GetScheme() const { return _topology.GetScheme(); }
    TfToken const &GetOrientation() const { return _topology.GetOrientation(); }
    VtIntArray const &GetFaceVertexCounts() const { return _topology.GetFaceVertexCounts(); }
    VtIntArray const &GetFaceVertexIndices() const { return _topology.GetFaceVertexIndices(); }
    VtIntArray const &GetHoleIndices() const { return _topology.GetHoleIndices(); }
    PxOsdSubdivTags const &GetSubdivTags() const { return _topology.GetSubdivTags(); }
    int GetRefineLevel() const { return _refineLevel; }

    HD_API int GetNumFaces() const;
    HD_API int GetNumFaceVaryings() const;
    HD_API int GetNumPoints() const;

    HdGeomSubsets const &GetGeomSubsets() const { return _geomSubsets; }
    VtIntArray const &GetInvisiblePoints() const { return _invisiblePoints; }
    VtIntArray const &GetInvisibleFaces() const { return _invisibleFaces; }

    /// Replaces the tags. A mesh's topology arrives without them; the scene delegate has them.
    void SetSubdivTags(PxOsdSubdivTags const &subdivTags) {
        _topology = PxOsdMeshTopology(GetScheme(), GetOrientation(), GetFaceVertexCounts(),
                                      GetFaceVertexIndices(), GetHoleIndices(), subdivTags);
    }

  protected:
    PxOsdMeshTopology _topology;
    HdGeomSubsets _geomSubsets;
    VtIntArray _invisiblePoints;
    VtIntArray _invisibleFaces;
    int _refineLevel;
    int _numPoints;
};

PXR_NAMESPACE_CLOSE_SCOPE

#endif
