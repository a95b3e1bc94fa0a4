#include "hdCC/instancer.h"

#include <functional>
#include <string>

#include <tbb/parallel_for.h>

#include "pxr/base/gf/matrix4d.h"
#include "pxr/base/gf/matrix4f.h"
#include "pxr/base/gf/quatd.h"
#include "pxr/base/gf/quatf.h"
#include "pxr/base/gf/quath.h"
#include "pxr/base/gf/vec3d.h"
#include "pxr/base/gf/vec3f.h"
#include "pxr/base/gf/vec3h.h"
#include "pxr/base/tf/staticTokens.h"
#include "pxr/base/vt/array.h"
#include "pxr/base/vt/types.h"
#include "pxr/imaging/hd/renderIndex.h"
#include "pxr/imaging/hd/sceneDelegate.h"

#include "hdCC/convert.h"
#include "hdCC/primvars.h"
#include "hdCC/renderParam.h"

PXR_NAMESPACE_OPEN_SCOPE

TF_DEFINE_PRIVATE_TOKENS(
    _tokens, ((translations, "hydra:instanceTranslations"))((rotations, "hydra:instanceRotations"))(
                 (scales, "hydra:instanceScales"))((transforms, "hydra:instanceTransforms")));

HdCCInstancer::HdCCInstancer(HdSceneDelegate *delegate, SdfPath const &id)
    : HdInstancer(delegate, id) {}

void HdCCInstancer::Sync(HdSceneDelegate *delegate, HdRenderParam *param, HdDirtyBits *dirtyBits) {
    _param = static_cast<HdCCRenderParam *>(param);
    _UpdateInstancer(delegate, dirtyBits);
    // Values share the scene's memory: to get them anew costs nothing.
    _translations = delegate->Get(GetId(), _tokens->translations);
    _rotations = delegate->Get(GetId(), _tokens->rotations);
    _scales = delegate->Get(GetId(), _tokens->scales);
    _transforms = delegate->Get(GetId(), _tokens->transforms);
    *dirtyBits = 0;
}

HdCCInstancer const *HdCCInstancer::_Parent() const {
    return GetParentId().IsEmpty()
               ? nullptr
               : static_cast<HdCCInstancer const *>(
                     GetDelegate()->GetRenderIndex().GetInstancer(GetParentId()));
}

/// Elements of an array of any of several types, as one type; none of them where there is no array.
template <class T>
struct _Elements {
    size_t count = 0;
    std::function<T(size_t)> at;
    bool isUsable = true;
};

template <class T, class... Arrays>
static _Elements<T> _Read(VtValue const &value) {
    _Elements<T> elements;
    elements.isUsable = value.IsEmpty();
    const auto tryArray = [&](auto const *example) {
        using Array = std::decay_t<decltype(*example)>;
        if (value.IsHolding<Array>()) {
            elements.count = value.UncheckedGet<Array>().size();
            elements.at = [array = value.UncheckedGet<Array>()](size_t i) {
                return T(array.cdata()[i]);
            };
            elements.isUsable = true;
        }
    };
    (tryArray(static_cast<Arrays const *>(nullptr)), ...);
    return elements;
}

class HdCCInstancer::_ElementTransforms {
  public:
    explicit _ElementTransforms(HdCCInstancer const &instancer)
        : _instancerToParent(instancer.GetDelegate()->GetInstancerTransform(instancer.GetId())),
          _translations(
              _Read<GfVec3d, VtVec3fArray, VtVec3dArray, VtVec3hArray>(instancer._translations)),
          _rotations(
              _Read<GfQuatd, VtQuathArray, VtQuatfArray, VtQuatdArray>(instancer._rotations)),
          _scales(_Read<GfVec3d, VtVec3fArray, VtVec3dArray, VtVec3hArray>(instancer._scales)),
          _transforms(_Read<GfMatrix4d, VtMatrix4dArray, VtMatrix4fArray>(instancer._transforms)) {}

    bool IsUsable() const {
        return _translations.isUsable && _rotations.isUsable && _scales.isUsable &&
               _transforms.isUsable;
    }

    cc::AffineTransform At(int index) const {
        // Vectors are rows: what comes first stands on the left.
        const size_t i = size_t(index);
        GfMatrix4d matrix(1), step;
        if (i < _transforms.count) {
            matrix = _transforms.at(i);
        }
        if (i < _scales.count) {
            matrix *= step.SetScale(_scales.at(i));
        }
        if (i < _rotations.count) {
            matrix *= step.SetRotate(_rotations.at(i).GetNormalized());
        }
        if (i < _translations.count) {
            matrix *= step.SetTranslate(_translations.at(i));
        }
        return HdCCToTransform(matrix * _instancerToParent);
    }

  private:
    const GfMatrix4d _instancerToParent;
    const _Elements<GfVec3d> _translations;
    const _Elements<GfQuatd> _rotations;
    const _Elements<GfVec3d> _scales;
    const _Elements<GfMatrix4d> _transforms;
};

std::vector<cc::AffineTransform> HdCCInstancer::ComputeInstances(SdfPath const &prototype) const {
    const VtIntArray indices = GetDelegate()->GetInstanceIndices(GetId(), prototype);
    const _ElementTransforms elements(*this);
    if (_param && !elements.IsUsable()) {
        _param->WarnOnce(GetId(),
                         "places of instances have a type that cannot be used; those "
                         "values are ignored");
    }
    std::vector<cc::AffineTransform> own(indices.size());
    tbb::parallel_for(size_t(0), own.size(),
                      [&](size_t i) { own[i] = elements.At(indices.cdata()[i]); });
    HdCCInstancer const *const parent = _Parent();
    if (!parent) {
        return own;
    }
    const std::vector<cc::AffineTransform> outer = parent->ComputeInstances(GetId());
    std::vector<cc::AffineTransform> all(outer.size() * own.size());
    tbb::parallel_for(size_t(0), all.size(),
                      [&](size_t i) { all[i] = outer[i / own.size()] * own[i % own.size()]; });
    return all;
}

bool HdCCInstancer::FindPrimvar(SdfPath const &prototype, TfToken const &name, cc::Primvar *primvar,
                                std::string *error) const {
    const VtIntArray indices = GetDelegate()->GetInstanceIndices(GetId(), prototype);
    HdCCInstancer const *const parent = _Parent();
    if (HdCCGetPrimvar(GetDelegate(), GetId(), name, {HdInterpolationInstance}, primvar, error)) {
        const size_t copies = parent ? parent->ComputeInstances(GetId()).size() : 1;
        const std::vector<int> valueOf = std::move(primvar->indices);
        primvar->indices.clear();
        for (size_t copy = 0; copy < copies; ++copy) {
            for (const int element : indices) {
                const bool isNamed = !valueOf.empty();
                const bool isThere = element >= 0 && size_t(element) < valueOf.size();
                primvar->indices.push_back(!isNamed ? element : isThere ? valueOf[element] : -1);
            }
        }
        return true;
    }
    if (!parent || !parent->FindPrimvar(GetId(), name, primvar, error)) {
        return false;
    }
    std::vector<int> spread;
    for (const int value : primvar->indices) {
        spread.insert(spread.end(), indices.size(), value);
    }
    primvar->indices = std::move(spread);
    return true;
}

PXR_NAMESPACE_CLOSE_SCOPE
