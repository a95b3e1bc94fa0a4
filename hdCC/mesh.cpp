#include "hdCC/mesh.h"

#include <string>
#include <vector>

#include "pxr/base/tf/diagnostic.h"
#include "pxr/base/tf/hash.h"
#include "pxr/base/tf/staticTokens.h"
#include "pxr/imaging/hd/changeTracker.h"
#include "pxr/imaging/hd/sceneDelegate.h"

#include "hdCC/convert.h"

PXR_NAMESPACE_OPEN_SCOPE

TF_DEFINE_PRIVATE_TOKENS(_tokens, (normals));

HdCCMesh::HdCCMesh(SdfPath const &id, HdCCRenderParam *param)
    : HdCCMesh(id, param, param->GetScene()->AddMesh(id.GetString())) {}

HdCCMesh::HdCCMesh(SdfPath const &id, HdCCRenderParam *param, cc::Mesh *mesh)
    : HdCCShape(id, param, mesh), _mesh(mesh) {}

HdDirtyBits HdCCMesh::GetInitialDirtyBitsMask() const {
    return HdCCShape::GetInitialDirtyBitsMask() | HdChangeTracker::DirtySubdivTags |
           HdChangeTracker::DirtyDoubleSided | HdChangeTracker::DirtyCullStyle;
}

HdDirtyBits HdCCMesh::_PropagateDirtyBits(HdDirtyBits bits) const {
    constexpr HdDirtyBits surface =
        HdChangeTracker::DirtyTopology | HdChangeTracker::DirtySubdivTags;
    // Topology and tags are one thing to the scene, and either needs the other.
    return bits & surface ? bits | surface : bits;
}

void HdCCMesh::_SyncGeometry(HdSceneDelegate *delegate, HdCCRenderParam *param, HdDirtyBits bits) {
    if (bits & (HdChangeTracker::DirtyTopology | HdChangeTracker::DirtySubdivTags)) {
        _SyncTopology(delegate, param);
        if (!_isPolygonal) {
            _mesh->SetPrimvar(_tokens->normals, cc::Primvar());  // unless asked for
        }
    }
    if (bits & (HdChangeTracker::DirtyPoints | HdChangeTracker::DirtyComputationPrimvarDesc)) {
        _SyncPoints(delegate);
    }
    if (bits & (HdChangeTracker::DirtyDoubleSided | HdChangeTracker::DirtyCullStyle)) {
        _SyncSides(delegate);
    }
}

void HdCCMesh::_SyncTopology(HdSceneDelegate *delegate, HdCCRenderParam *param) {
    const HdMeshTopology topology = delegate->GetMeshTopology(GetId());
    const PxOsdSubdivTags tags = delegate->GetSubdivTags(GetId());
    _SyncSubsets(topology);
    const size_t hash = TfHash::Combine(topology.ComputeHash(), tags.ComputeHash());
    if (_hasTopology && hash == _topologyHash) {
        return;  // subsets count as topology, but shape nothing
    }
    _topologyHash = hash;
    cc::ControlMesh mesh;
    std::vector<std::string> warnings;
    _hasTopology = HdCCToControlMesh(topology, tags, &mesh, &warnings);
    for (std::string const &warning : warnings) {
        param->WarnOnce(GetId(), warning);
    }
    if (!_hasTopology) {
        TF_WARN("<%s>: the subdivision scheme '%s' is not supported; the mesh is left out",
                GetId().GetText(), topology.GetScheme().GetText());
    }
    _hasFaces = !mesh.faceVertexCounts.empty();
    _isPolygonal = _hasTopology && mesh.scheme == cc::Scheme::None;
    _mesh->SetTopology(std::move(mesh));
}

void HdCCMesh::_SyncSubsets(HdMeshTopology const &topology) {
    std::vector<cc::FaceSubset> subsets;
    for (HdGeomSubset const &subset : topology.GetGeomSubsets()) {
        if (!subset.materialId.IsEmpty()) {
            subsets.push_back(
                {subset.materialId.GetString(), {subset.indices.cbegin(), subset.indices.cend()}});
        }
    }
    _mesh->SetSubsets(std::move(subsets));
}

void HdCCMesh::_SyncPoints(HdSceneDelegate *delegate) {
    cc::Moving<std::vector<cc::Vec3f>> points;
    _hasPoints = HdCCSyncPoints(delegate, GetId(), "mesh is", _GetParam()->GetShutter(), &points);
    _mesh->SetMovingPoints(std::move(points));
}

TfTokenVector HdCCMesh::_PrimvarNames(TfTokenVector asked) const {
    if (_isPolygonal) {
        asked.push_back(_tokens->normals);
    }
    return HdCCShape::_PrimvarNames(std::move(asked));
}

void HdCCMesh::_SyncSides(HdSceneDelegate *delegate) {
    const bool isDoubleSided = delegate->GetDoubleSided(GetId());
    cc::CulledSide side = cc::CulledSide::None;
    switch (delegate->GetCullStyle(GetId())) {
        case HdCullStyleDontCare:
        case HdCullStyleNothing: break;
        case HdCullStyleBack: side = cc::CulledSide::Back; break;
        case HdCullStyleFront: side = cc::CulledSide::Front; break;
        case HdCullStyleBackUnlessDoubleSided:
            side = isDoubleSided ? side : cc::CulledSide::Back;
            break;
        case HdCullStyleFrontUnlessDoubleSided:
            side = isDoubleSided ? side : cc::CulledSide::Front;
            break;
    }
    _mesh->SetCulled(side);
}

PXR_NAMESPACE_CLOSE_SCOPE
