#include "hdCC/mesh.h"

#include <algorithm>
#include <string>
#include <vector>

#include "pxr/base/tf/diagnostic.h"
#include "pxr/base/tf/staticTokens.h"
#include "pxr/imaging/hd/changeTracker.h"
#include "pxr/imaging/hd/extComputationUtils.h"
#include "pxr/imaging/hd/renderIndex.h"
#include "pxr/imaging/hd/sceneDelegate.h"

#include "hdCC/convert.h"
#include "hdCC/instancer.h"
#include "hdCC/motion.h"
#include "hdCC/primvars.h"
#include "hdCC/renderParam.h"

PXR_NAMESPACE_OPEN_SCOPE

TF_DEFINE_PRIVATE_TOKENS(_tokens, (points)(displayColor)(normals));

HdCCMesh::HdCCMesh(SdfPath const &id, HdCCRenderParam *param)
    : HdMesh(id), _mesh(param->GetScene()->AddMesh(id.GetString())), _param(param) {
    _mesh->SetVisible(false);
    param->AddMesh(this);
}

HdDirtyBits HdCCMesh::GetInitialDirtyBitsMask() const {
    return HdChangeTracker::DirtyPrimID | HdChangeTracker::DirtyTopology |
           HdChangeTracker::DirtySubdivTags | HdChangeTracker::DirtyPoints |
           HdChangeTracker::DirtyPrimvar | HdChangeTracker::DirtyNormals |
           HdChangeTracker::DirtyComputationPrimvarDesc | HdChangeTracker::DirtyTransform |
           HdChangeTracker::DirtyVisibility | HdChangeTracker::DirtyDoubleSided |
           HdChangeTracker::DirtyCullStyle | HdChangeTracker::DirtyInstancer |
           HdChangeTracker::DirtyInstanceIndex | HdChangeTracker::DirtyRenderTag;
}

HdDirtyBits HdCCMesh::_PropagateDirtyBits(HdDirtyBits bits) const {
    constexpr HdDirtyBits surface =
        HdChangeTracker::DirtyTopology | HdChangeTracker::DirtySubdivTags;
    // Topology and tags are one thing to the scene, and either needs the other.
    return bits & surface ? bits | surface : bits;
}

void HdCCMesh::_InitRepr(TfToken const &repr, HdDirtyBits *) {
    for (auto const &known : _reprs) {
        if (known.first == repr) {
            return;
        }
    }
    _reprs.emplace_back(repr, HdReprSharedPtr());
}

void HdCCMesh::Sync(HdSceneDelegate *delegate, HdRenderParam *param, HdDirtyBits *dirtyBits,
                    TfToken const &) {
    const HdCCRenderParam::SyncScope scope(param);
    HdCCRenderParam *const shared = static_cast<HdCCRenderParam *>(param);
    const HdDirtyBits bits = *dirtyBits;
    _delegate = delegate;

    // First, as primvars may be those of instances.
    _UpdateInstancer(delegate, dirtyBits);
    HdInstancer::_SyncInstancerAndParents(delegate->GetRenderIndex(), GetInstancerId());
    if (bits & (HdChangeTracker::DirtyInstancer | HdChangeTracker::DirtyInstanceIndex)) {
        _SyncInstances(delegate);
    }
    if (bits & HdChangeTracker::DirtyPrimID) {
        _mesh->SetPrimId(GetPrimId());
    }
    if (bits & (HdChangeTracker::DirtyTopology | HdChangeTracker::DirtySubdivTags)) {
        _SyncTopology(delegate, shared);
    }
    if (bits & (HdChangeTracker::DirtyPoints | HdChangeTracker::DirtyComputationPrimvarDesc)) {
        _SyncPoints(delegate);
    }
    if (bits & (HdChangeTracker::DirtyPrimvar | HdChangeTracker::DirtyNormals |
                HdChangeTracker::DirtyTopology | HdChangeTracker::DirtyInstancer |
                HdChangeTracker::DirtyInstanceIndex)) {
        _SyncPrimvars(delegate, shared->GetPrimvarsAskedFor());
    }
    if (bits & HdChangeTracker::DirtyTransform) {
        _SyncTransform(delegate);
    }
    if (bits & (HdChangeTracker::DirtyDoubleSided | HdChangeTracker::DirtyCullStyle)) {
        _SyncSides(delegate);
    }
    _SyncShown(delegate, dirtyBits);

    *dirtyBits &= ~HdDirtyBits(HdChangeTracker::AllSceneDirtyBits);
}

void HdCCMesh::_SyncTopology(HdSceneDelegate *delegate, HdCCRenderParam *param) {
    const HdMeshTopology topology = delegate->GetMeshTopology(GetId());
    const PxOsdSubdivTags tags = delegate->GetSubdivTags(GetId());
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

/// Points that a computation makes, as UsdSkel does; an empty value if none makes them.
static VtValue _ComputedPoints(HdSceneDelegate *delegate, SdfPath const &id) {
    const HdExtComputationPrimvarDescriptorVector primvars =
        delegate->GetExtComputationPrimvarDescriptors(id, HdInterpolationVertex);
    for (HdExtComputationPrimvarDescriptor const &primvar : primvars) {
        if (primvar.name == _tokens->points) {
            return HdExtComputationUtils::GetComputedPrimvarValues({primvar},
                                                                   delegate)[_tokens->points];
        }
    }
    return VtValue();
}

void HdCCMesh::_SyncPoints(HdSceneDelegate *delegate) {
    const VtValue computed = _ComputedPoints(delegate, GetId());
    const cc::Moving<VtValue> values =
        computed.IsEmpty()
            ? HdCCSamplePrimvar(delegate, GetId(), _tokens->points, _param->GetShutter())
            : cc::Moving<VtValue>(computed);
    _hasPoints = true;
    cc::Moving<std::vector<cc::Vec3f>> points =
        HdCCConvertPoses<std::vector<cc::Vec3f>>(values, [&](VtValue const &value) {
            std::vector<cc::Vec3f> pose;
            if (!HdCCToVec3fs(value, &pose) && _hasPoints) {
                _hasPoints = false;
                TF_WARN("<%s>: points have the type %s, not point3f[]; the mesh is left out",
                        GetId().GetText(), value.GetTypeName().c_str());
            }
            return pose;
        });
    if (points.IsMoving()) {
        _mesh->SetMovingPoints(std::move(points));
    } else {
        _mesh->SetPoints(std::move(points.Poses().front()));
    }
}

void HdCCMesh::_SyncTransform(HdSceneDelegate *delegate) {
    _mesh->SetMovingTransform(HdCCSampleTransform(delegate, GetId(), _param->GetShutter()));
}

void HdCCMesh::SyncLateMotion() {
    if (_delegate) {
        _SyncPoints(_delegate);
        _SyncTransform(_delegate);
        _SyncInstances(_delegate);
    }
}

void HdCCMesh::_SyncPrimvar(HdSceneDelegate *delegate, TfToken const &name) {
    cc::Primvar primvar;
    std::string error;
    const bool isOwn =
        HdCCGetPrimvar(delegate, GetId(), name,
                       {HdInterpolationConstant, HdInterpolationUniform, HdInterpolationVarying,
                        HdInterpolationVertex, HdInterpolationFaceVarying},
                       &primvar, &error);
    HdCCInstancer const *const instancer = _Instancer(delegate);
    const bool isFound =
        isOwn || (instancer && instancer->FindPrimvar(GetId(), name, &primvar, &error));
    if (!error.empty()) {
        TF_WARN("<%s>: %s", GetId().GetText(), error.c_str());
    } else if (isFound && primvar.IsEmpty() && _hasFaces && _hasInstances) {
        TF_WARN("<%s>: primvars:%s has no values; it is ignored", GetId().GetText(),
                name.GetText());
    }
    _mesh->SetPrimvar(name.GetString(), std::move(primvar));
}

void HdCCMesh::_SyncPrimvars(HdSceneDelegate *delegate, TfTokenVector names) {
    names.push_back(_tokens->displayColor);
    if (_isPolygonal) {
        names.push_back(_tokens->normals);
    } else if (std::find(names.begin(), names.end(), _tokens->normals) == names.end()) {
        _mesh->SetPrimvar(_tokens->normals, cc::Primvar());
    }
    for (TfToken const &name : names) {
        _SyncPrimvar(delegate, name);
    }
}

void HdCCMesh::SyncLatePrimvar(TfToken const &name) {
    if (_delegate && name != _tokens->displayColor) {
        _SyncPrimvar(_delegate, name);
    }
}

void HdCCMesh::_SyncSides(HdSceneDelegate *delegate) {
    const HdCullStyle style = delegate->GetCullStyle(GetId());
    _mesh->SetCullBackFaces(
        style == HdCullStyleBack ||
        (style == HdCullStyleBackUnlessDoubleSided && !delegate->GetDoubleSided(GetId())));
    if (style == HdCullStyleFront || style == HdCullStyleFrontUnlessDoubleSided) {
        TF_WARN("<%s>: culling front faces is not supported; both sides are shown",
                GetId().GetText());
    }
}

void HdCCMesh::_SyncShown(HdSceneDelegate *delegate, HdDirtyBits *dirtyBits) {
    _UpdateVisibility(delegate, dirtyBits);
    _mesh->SetRenderTag(GetRenderTag().GetString());
    _mesh->SetVisible(IsVisible() && _hasTopology && _hasPoints);
}

HdCCInstancer const *HdCCMesh::_Instancer(HdSceneDelegate *delegate) const {
    return static_cast<HdCCInstancer const *>(
        delegate->GetRenderIndex().GetInstancer(GetInstancerId()));
}

void HdCCMesh::_SyncInstances(HdSceneDelegate *delegate) {
    HdCCInstancer const *const instancer = _Instancer(delegate);
    if (!instancer) {
        _mesh->ClearInstances();
        _hasInstances = true;
        return;
    }
    cc::Moving<std::vector<cc::AffineTransform>> instances = instancer->ComputeInstances(GetId());
    _hasInstances = !instances.Poses().front().empty();
    _mesh->SetMovingInstances(std::move(instances));
}

void HdCCMesh::UpdateRenderTag(HdSceneDelegate *delegate, HdRenderParam *param) {
    const HdCCRenderParam::SyncScope scope(param);
    HdMesh::UpdateRenderTag(delegate, param);
    _mesh->SetRenderTag(GetRenderTag().GetString());
}

void HdCCMesh::Finalize(HdRenderParam *param) {
    const HdCCRenderParam::SyncScope scope(param);
    HdCCRenderParam *const shared = static_cast<HdCCRenderParam *>(param);
    shared->RemoveMesh(this);
    shared->GetScene()->RemoveMesh(_mesh);
    _mesh = nullptr;
    HdMesh::Finalize(param);
}

PXR_NAMESPACE_CLOSE_SCOPE
