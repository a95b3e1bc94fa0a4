#ifndef HDCC_SHAPE_H
#define HDCC_SHAPE_H

#include <functional>
#include <utility>
#include <vector>

#include "core/scene/moving.h"
#include "core/scene/shape.h"

#include "pxr/base/tf/token.h"
#include "pxr/imaging/hd/changeTracker.h"
#include "pxr/imaging/hd/instancer.h"
#include "pxr/imaging/hd/renderIndex.h"
#include "pxr/imaging/hd/rprim.h"
#include "pxr/imaging/hd/sceneDelegate.h"
#include "pxr/pxr.h"

#include "hdCC/convert.h"
#include "hdCC/renderParam.h"
#include "hdCC/shutter.h"

PXR_NAMESPACE_OPEN_SCOPE

class HdCCInstancer;

/// Hands one of the scene's shapes what changed of what all kinds of prims have.
class HdCCShapeSync {
  public:
    /// Syncs the points of a prim of some kind.
    using SyncPoints = std::function<void(HdSceneDelegate *)>;

    HdCCShapeSync(SdfPath const &id, cc::Shape *shape, HdCCRenderParam *param,
                  SyncPoints syncPoints)
        : _id(id), _shape(shape), _param(param), _syncPoints(std::move(syncPoints)) {}

    void SyncTransform(HdSceneDelegate *delegate);
    void SyncInstances(HdSceneDelegate *delegate, SdfPath const &instancer);
    /// @param hasElements  of a shape without elements nobody expects values
    void SyncPrimvars(HdSceneDelegate *delegate, TfTokenVector const &names, bool hasElements);
    /// Syncs a primvar that is asked for after the prim was synced; if it has not been, nothing.
    void SyncLatePrimvar(TfToken const &name);
    /// Syncs what moves, when another shutter is asked for after the prim was synced.
    void SyncLateMotion();

    SdfPath const &GetId() const { return _id; }
    cc::Shape *GetShape() const { return _shape; }
    HdCCRenderParam *GetParam() const { return _param; }

  private:
    void _SyncPrimvar(TfToken const &name);
    /// Null if the prim is no prototype.
    HdCCInstancer const *_Instancer(HdSceneDelegate *delegate) const;

    SdfPath const _id;
    cc::Shape *const _shape;
    HdCCRenderParam *const _param;
    const SyncPoints _syncPoints;
    /// What the prim was last synced with: primvars may be asked for later.
    HdSceneDelegate *_delegate = nullptr;
    SdfPath _instancerId;
    bool _hasElements = false;
    bool _hasInstances = true;
};

/// Points that a computation makes, as UsdSkel does, or else those of the prim. Returns false, and
/// warns, if they are no points.
bool HdCCSyncPoints(HdSceneDelegate *delegate, SdfPath const &id, char const *noun,
                    HdCCShutter const &shutter, cc::Moving<std::vector<cc::Vec3f>> *points);
/// What only some kinds of prims have, such as widths; empty if there are none. Warns if they are
/// no numbers.
cc::Primvar HdCCSyncValues(HdSceneDelegate *delegate, SdfPath const &id, TfToken const &name);

/// A prim whose shape a scene has: what Sync does for all kinds of them.
/// @tparam Base  HdMesh or one of its like
template <class Base>
class HdCCShape : public Base {
  public:
    HdCCShape(SdfPath const &id, HdCCRenderParam *param, cc::Shape *shape)
        : Base(id), _sync(id, shape, param, [this, param](HdSceneDelegate *delegate) {
              _SyncGeometry(delegate, param, HdChangeTracker::DirtyPoints);
          }) {
        shape->SetVisible(false);
        param->AddShape(&_sync);
    }

    void Sync(HdSceneDelegate *delegate, HdRenderParam *param, HdDirtyBits *dirtyBits,
              TfToken const &) final {
        const HdCCRenderParam::SyncScope scope(param);
        HdCCRenderParam *const shared = static_cast<HdCCRenderParam *>(param);
        const HdDirtyBits bits = *dirtyBits;

        // First, as primvars may be those of instances.
        this->_UpdateInstancer(delegate, dirtyBits);
        HdInstancer::_SyncInstancerAndParents(delegate->GetRenderIndex(), this->GetInstancerId());
        if (bits & (HdChangeTracker::DirtyInstancer | HdChangeTracker::DirtyInstanceIndex)) {
            _sync.SyncInstances(delegate, this->GetInstancerId());
        }
        if (bits & HdChangeTracker::DirtyPrimID) {
            _sync.GetShape()->SetPrimId(this->GetPrimId());
        }
        _SyncGeometry(delegate, shared, bits);
        if (bits & HdChangeTracker::DirtyMaterialId) {
            this->SetMaterialId(delegate->GetMaterialId(this->GetId()));
            _sync.GetShape()->SetMaterial(this->GetMaterialId().GetString());
        }
        if (bits & (HdChangeTracker::DirtyPrimvar | HdChangeTracker::DirtyNormals |
                    HdChangeTracker::DirtyTopology | HdChangeTracker::DirtyInstancer |
                    HdChangeTracker::DirtyInstanceIndex)) {
            _sync.SyncPrimvars(delegate, _PrimvarNames(shared->GetPrimvarsAskedFor()),
                               _HasElements());
        }
        if (bits & HdChangeTracker::DirtyTransform) {
            _sync.SyncTransform(delegate);
        }
        this->_UpdateVisibility(delegate, dirtyBits);
        _sync.GetShape()->SetRenderTag(this->GetRenderTag().GetString());
        _sync.GetShape()->SetVisible(this->IsVisible() && _IsUsable());

        *dirtyBits &= ~HdDirtyBits(HdChangeTracker::AllSceneDirtyBits);
    }

    void UpdateRenderTag(HdSceneDelegate *delegate, HdRenderParam *param) override {
        const HdCCRenderParam::SyncScope scope(param);
        Base::UpdateRenderTag(delegate, param);
        _sync.GetShape()->SetRenderTag(this->GetRenderTag().GetString());
    }

    void Finalize(HdRenderParam *param) override {
        const HdCCRenderParam::SyncScope scope(param);
        HdCCRenderParam *const shared = static_cast<HdCCRenderParam *>(param);
        shared->RemoveShape(&_sync);
        shared->GetScene()->RemoveShape(_sync.GetShape());
        Base::Finalize(param);
    }

    HdDirtyBits GetInitialDirtyBitsMask() const override {
        return HdChangeTracker::DirtyPrimID | HdChangeTracker::DirtyMaterialId |
               HdChangeTracker::DirtyPoints | HdChangeTracker::DirtyPrimvar |
               HdChangeTracker::DirtyNormals | HdChangeTracker::DirtyWidths |
               HdChangeTracker::DirtyComputationPrimvarDesc | HdChangeTracker::DirtyTopology |
               HdChangeTracker::DirtyTransform | HdChangeTracker::DirtyVisibility |
               HdChangeTracker::DirtyInstancer | HdChangeTracker::DirtyInstanceIndex |
               HdChangeTracker::DirtyRenderTag;
    }

  protected:
    /// Syncs what only this kind of prim has.
    virtual void _SyncGeometry(HdSceneDelegate *delegate, HdCCRenderParam *param,
                               HdDirtyBits bits) = 0;
    /// The primvars that are needed.
    /// @param asked  those that somebody asked for
    virtual TfTokenVector _PrimvarNames(TfTokenVector asked) const {
        asked.push_back(TfToken("displayColor"));
        return asked;
    }
    /// False if the prim is left out because of what arrived; a warning says why.
    virtual bool _IsUsable() const = 0;
    virtual bool _HasElements() const = 0;

    HdCCRenderParam *_GetParam() const { return _sync.GetParam(); }

    HdDirtyBits _PropagateDirtyBits(HdDirtyBits bits) const override { return bits; }

    void _InitRepr(TfToken const &repr, HdDirtyBits *) override {
        for (auto const &known : this->_reprs) {
            if (known.first == repr) {
                return;
            }
        }
        this->_reprs.emplace_back(repr, HdReprSharedPtr());
    }

  private:
    HdCCShapeSync _sync;
};

PXR_NAMESPACE_CLOSE_SCOPE

#endif
