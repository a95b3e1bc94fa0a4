#ifndef HDCC_MESH_H
#define HDCC_MESH_H

#include "core/scene/mesh.h"

#include "pxr/imaging/hd/mesh.h"
#include "pxr/pxr.h"

#include "hdCC/shape.h"

PXR_NAMESPACE_OPEN_SCOPE

/// A UsdGeomMesh: hands the scene's mesh what changed, and nothing else.
///
/// The refine level (usdview's complexity) plays no part: the limit surface is always shown.
class HdCCMesh final : public HdCCShape<HdMesh> {
  public:
    HdCCMesh(SdfPath const &id, HdCCRenderParam *param);

    HdDirtyBits GetInitialDirtyBitsMask() const override;

  protected:
    HdDirtyBits _PropagateDirtyBits(HdDirtyBits bits) const override;
    void _SyncGeometry(HdSceneDelegate *delegate, HdCCRenderParam *param,
                       HdDirtyBits bits) override;
    TfTokenVector _PrimvarNames(TfTokenVector asked) const override;
    bool _IsUsable() const override { return _hasTopology && _hasPoints; }
    bool _HasElements() const override { return _hasFaces; }

  private:
    HdCCMesh(SdfPath const &id, HdCCRenderParam *param, cc::Mesh *mesh);

    void _SyncTopology(HdSceneDelegate *delegate, HdCCRenderParam *param);
    void _SyncSubsets(HdMeshTopology const &topology);
    void _SyncPoints(HdSceneDelegate *delegate);
    void _SyncSides(HdSceneDelegate *delegate);

    cc::Mesh *const _mesh;
    /// Of what the scene's mesh was given last.
    size_t _topologyHash = 0;
    bool _hasTopology = false, _hasPoints = false, _hasFaces = false;
    /// Polygons have normals of their own; subdivision takes those of the surface.
    bool _isPolygonal = false;
};

PXR_NAMESPACE_CLOSE_SCOPE

#endif
