#ifndef HDCC_MESH_H
#define HDCC_MESH_H

#include "core/scene/mesh.h"

#include "pxr/imaging/hd/mesh.h"
#include "pxr/pxr.h"

PXR_NAMESPACE_OPEN_SCOPE

class HdCCInstancer;
class HdCCRenderParam;

/// A UsdGeomMesh: hands the scene's mesh what changed, and nothing else.
///
/// The refine level (usdview's complexity) plays no part: the limit surface is always shown.
class HdCCMesh final : public HdMesh {
  public:
    HdCCMesh(SdfPath const &id, HdCCRenderParam *param);

    void Sync(HdSceneDelegate *delegate, HdRenderParam *param, HdDirtyBits *dirtyBits,
              TfToken const &repr) override;
    void UpdateRenderTag(HdSceneDelegate *delegate, HdRenderParam *param) override;
    void Finalize(HdRenderParam *param) override;

    /// Syncs a primvar that is asked for after the mesh was synced; if it has not been, nothing.
    void SyncLatePrimvar(TfToken const &name);
    /// Syncs what moves, when another shutter is asked for after the mesh was synced.
    void SyncLateMotion();

    HdDirtyBits GetInitialDirtyBitsMask() const override;

  protected:
    HdDirtyBits _PropagateDirtyBits(HdDirtyBits bits) const override;
    void _InitRepr(TfToken const &repr, HdDirtyBits *dirtyBits) override;

  private:
    void _SyncTopology(HdSceneDelegate *delegate, HdCCRenderParam *param);
    void _SyncPoints(HdSceneDelegate *delegate);
    void _SyncTransform(HdSceneDelegate *delegate);
    void _SyncPrimvars(HdSceneDelegate *delegate, TfTokenVector names);
    void _SyncPrimvar(HdSceneDelegate *delegate, TfToken const &name);
    void _SyncSides(HdSceneDelegate *delegate);
    void _SyncInstances(HdSceneDelegate *delegate);
    void _SyncShown(HdSceneDelegate *delegate, HdDirtyBits *dirtyBits);
    /// Null if the mesh is no prototype.
    HdCCInstancer const *_Instancer(HdSceneDelegate *delegate) const;

    cc::Mesh *_mesh;
    HdCCRenderParam *_param;
    /// What the mesh was last synced with: primvars may be asked for later.
    HdSceneDelegate *_delegate = nullptr;
    bool _hasTopology = false, _hasPoints = false, _hasFaces = false;
    /// True if the mesh is no prototype.
    bool _hasInstances = true;
    /// Polygons have normals of their own; subdivision takes those of the surface.
    bool _isPolygonal = false;
};

PXR_NAMESPACE_CLOSE_SCOPE

#endif
