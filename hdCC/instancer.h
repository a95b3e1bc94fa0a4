#ifndef HDCC_INSTANCER_H
#define HDCC_INSTANCER_H

#include <vector>

#include "core/math/transform.h"
#include "core/scene/moving.h"
#include "core/scene/primvar.h"

#include "pxr/imaging/hd/instancer.h"
#include "pxr/pxr.h"

PXR_NAMESPACE_OPEN_SCOPE

class HdCCRenderParam;

/// A point instancer, or all native instances of one prototype.
///
/// Where instancers are nested, each instance of the outer one has all of the inner one's: the
/// index of the innermost changes fastest, and that of instance 0 of all is 0. Instance ids count
/// so.
class HdCCInstancer final : public HdInstancer {
  public:
    HdCCInstancer(HdSceneDelegate *delegate, SdfPath const &id);

    void Sync(HdSceneDelegate *delegate, HdRenderParam *param, HdDirtyBits *dirtyBits) override;

    /// The maps to the world of all instances of a prototype, nested ones multiplied out, as they
    /// move while the shutter is open.
    cc::Moving<std::vector<cc::AffineTransform>> ComputeInstances(SdfPath const &prototype) const;

    /// Finds a primvar that this instancer has, or else one around it, and spreads it over the
    /// instances of a prototype. Returns false if there is none.
    /// @param error  set if there is one of a type that makes no sense
    bool FindPrimvar(SdfPath const &prototype, TfToken const &name, cc::Primvar *primvar,
                     std::string *error) const;

  private:
    HdCCInstancer const *_Parent() const;
    class _Elements;

    HdCCRenderParam *_param = nullptr;
};

PXR_NAMESPACE_CLOSE_SCOPE

#endif
