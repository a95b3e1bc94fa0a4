#ifndef PXR_IMAGING_HD_MESH_H
#define PXR_IMAGING_HD_MESH_H

#include "pxr/imaging/hd/api.h"
#include "pxr/imaging/hd/enums.h"
#include "pxr/imaging/hd/meshTopology.h"
#include "pxr/imaging/hd/rprim.h"
#include "pxr/imaging/hd/version.h"
#include "pxr/imaging/pxOsd/subdivTags.h"
#include "pxr/pxr.h"

PXR_NAMESPACE_OPEN_SCOPE

/// A polygon mesh or a subdivision surface.
class HdMesh : public HdRprim {
  public:
    HdMesh() = delete;
    HdMesh(HdMesh const &) = delete;
    HdMesh &operator=(HdMesh const &) = delete;
    HD_API ~HdMesh() override;

    bool IsDoubleSided(HdSceneDelegate *d) const { return d->GetDoubleSided(GetId()); }
    HdCullStyle GetCullStyle(HdSceneDelegate *d) const { return d->GetCullStyle(GetId()); }
    HdDisplayStyle GetDisplayStyle(HdSceneDelegate *d) const { return d->GetDisplayStyle(GetId()); }
    HdMeshTopology GetMeshTopology(HdSceneDelegate *d) const { return d->GetMeshTopology(GetId()); }
    PxOsdSubdivTags GetSubdivTags(HdSceneDelegate *d) const { return d->GetSubdivTags(GetId()); }

    /// For drawing by the library; null unless a delegate shares its topology.
    HD_API virtual HdMeshTopologySharedPtr GetTopology() const;

    HD_API TfTokenVector const &GetBuiltinPrimvarNames() const override;

  protected:
    HD_API HdMesh(SdfPath const &id);
};

PXR_NAMESPACE_CLOSE_SCOPE

#endif
