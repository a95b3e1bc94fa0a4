#ifndef HDCC_MESH_H
#define HDCC_MESH_H

#include "core/scene/scene.h"

#include "pxr/imaging/hd/mesh.h"
#include "pxr/pxr.h"

PXR_NAMESPACE_OPEN_SCOPE

/// A UsdGeomMesh: hands the scene's mesh what changed, and nothing else.
///
/// The refine level (usdview's complexity) plays no part: the limit surface is always shown.
class HdCCMesh final : public HdMesh {
  public:
    /// Meshes are made one after the other, so the scene's order is that of the render index.
    HdCCMesh(SdfPath const &id, cc::Scene *scene);

    void Sync(HdSceneDelegate *delegate, HdRenderParam *param, HdDirtyBits *dirtyBits,
              TfToken const &repr) override;
    void UpdateRenderTag(HdSceneDelegate *delegate, HdRenderParam *param) override;
    void Finalize(HdRenderParam *param) override;
    HdDirtyBits GetInitialDirtyBitsMask() const override;

  protected:
    HdDirtyBits _PropagateDirtyBits(HdDirtyBits bits) const override;
    void _InitRepr(TfToken const &repr, HdDirtyBits *dirtyBits) override;

  private:
    void _SyncTopology(HdSceneDelegate *delegate);
    void _SyncPoints(HdSceneDelegate *delegate);
    void _SyncDisplayColor(HdSceneDelegate *delegate);
    void _SyncSides(HdSceneDelegate *delegate);
    void _SyncShown(HdSceneDelegate *delegate, HdRenderParam *param, HdDirtyBits *dirtyBits);

    cc::Mesh *_mesh;
    bool _hasTopology = false, _hasPoints = false;
};

PXR_NAMESPACE_CLOSE_SCOPE

#endif
