#include "hdCC/instancer.h"

#include <functional>
#include <set>
#include <string>
#include <utility>

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
#include "hdCC/motion.h"
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
    *dirtyBits = 0;
}

HdCCInstancer const *HdCCInstancer::_Parent() const {
    return GetParentId().IsEmpty()
               ? nullptr
               : static_cast<HdCCInstancer const *>(
                     GetDelegate()->GetRenderIndex().GetInstancer(GetParentId()));
}

static GfVec3d _Blend(GfVec3d const &a, GfVec3d const &b, double weight) {
    return (1 - weight) * a + weight * b;
}
static GfMatrix4d _Blend(GfMatrix4d const &a, GfMatrix4d const &b, double weight) {
    return a * (1 - weight) + b * weight;
}
static GfQuatd _Blend(GfQuatd const &a, GfQuatd const &b, double weight) {
    return GfSlerp(weight, a.GetNormalized(), b.GetNormalized());
}

/// Elements of an array of any of several types, as one type; none of them where there is no array.
template <class T>
class _Array {
  public:
    /// @tparam Arrays  the types
    template <class... Arrays>
    static _Array Read(VtValue const &value) {
        _Array array;
        array._isUsable = value.IsEmpty();
        (array._ReadIfHeld<Arrays>(value), ...);
        return array;
    }

    bool IsUsable() const { return _isUsable; }
    size_t Count() const { return _count; }
    T At(size_t i) const { return _at(i); }

  private:
    template <class Array>
    void _ReadIfHeld(VtValue const &value) {
        if (value.IsHolding<Array>()) {
            _count = value.UncheckedGet<Array>().size();
            _at = [array = value.UncheckedGet<Array>()](size_t i) { return T(array.cdata()[i]); };
            _isUsable = true;
        }
    }

    size_t _count = 0;
    std::function<T(size_t)> _at;
    bool _isUsable = true;
};

/// What a primvar of an instancer says of its elements at a time.
template <class T>
class _ElementsAt {
  public:
    _ElementsAt(cc::Moving<_Array<T>> const &arrays, float time) : _between(arrays.At(time)) {}

    /// False for elements that the primvar says nothing of.
    bool Has(size_t i) const { return i < _between.first.Count() && i < _between.second.Count(); }
    T At(size_t i) const {
        return _between.weight == 0
                   ? _between.first.At(i)
                   : _Blend(_between.first.At(i), _between.second.At(i), _between.weight);
    }

  private:
    typename cc::Moving<_Array<T>>::Between _between;
};

/// Where the elements of an instancer's arrays are in its parent's space, over the shutter's time.
class HdCCInstancer::_Elements {
  public:
    _Elements(HdCCInstancer const &instancer, HdCCShutter const &shutter)
        : _instancerToParent(
              HdCCSampleInstancerTransform(instancer.GetDelegate(), instancer.GetId(), shutter)),
          _translations(_Sample<GfVec3d, VtVec3fArray, VtVec3dArray, VtVec3hArray>(
              instancer, _tokens->translations, shutter)),
          _rotations(_Sample<GfQuatd, VtQuathArray, VtQuatfArray, VtQuatdArray>(
              instancer, _tokens->rotations, shutter)),
          _scales(_Sample<GfVec3d, VtVec3fArray, VtVec3dArray, VtVec3hArray>(
              instancer, _tokens->scales, shutter)),
          _transforms(_Sample<GfMatrix4d, VtMatrix4dArray, VtMatrix4fArray>(
              instancer, _tokens->transforms, shutter)) {}

    bool IsUsable() const { return _isUsable; }

    /// At which any of it is known, rising.
    std::vector<float> Times() const {
        std::set<float> times;
        for (auto const *some : {&_instancerToParent.Times(), &_translations.Times(),
                                 &_rotations.Times(), &_scales.Times(), &_transforms.Times()}) {
            times.insert(some->begin(), some->end());
        }
        return {times.begin(), times.end()};
    }

    std::vector<cc::AffineTransform> At(VtIntArray const &indices, float time) const {
        const auto poses = _instancerToParent.At(time);
        const GfMatrix4d toParent =
            poses.weight == 0 ? poses.first : _Blend(poses.first, poses.second, poses.weight);
        const _ElementsAt<GfMatrix4d> transforms(_transforms, time);
        const _ElementsAt<GfVec3d> scales(_scales, time), translations(_translations, time);
        const _ElementsAt<GfQuatd> rotations(_rotations, time);
        std::vector<cc::AffineTransform> result(indices.size());
        tbb::parallel_for(size_t(0), result.size(), [&](size_t at) {
            // Vectors are rows: what comes first stands on the left.
            const size_t i = size_t(indices.cdata()[at]);
            GfMatrix4d matrix(1), step;
            if (transforms.Has(i)) {
                matrix = transforms.At(i);
            }
            if (scales.Has(i)) {
                matrix *= step.SetScale(scales.At(i));
            }
            if (rotations.Has(i)) {
                matrix *= step.SetRotate(rotations.At(i).GetNormalized());
            }
            if (translations.Has(i)) {
                matrix *= step.SetTranslate(translations.At(i));
            }
            result[at] = HdCCToTransform(matrix * toParent);
        });
        return result;
    }

  private:
    template <class T, class... Arrays>
    cc::Moving<_Array<T>> _Sample(HdCCInstancer const &instancer, TfToken const &name,
                                  HdCCShutter const &shutter) {
        const auto values =
            HdCCSamplePrimvar(instancer.GetDelegate(), instancer.GetId(), name, shutter);
        return HdCCConvertPoses<_Array<T>>(values, [&](VtValue const &value) {
            const auto array = _Array<T>::template Read<Arrays...>(value);
            _isUsable = _isUsable && array.IsUsable();
            return array;
        });
    }

    bool _isUsable = true;
    const cc::Moving<GfMatrix4d> _instancerToParent;
    const cc::Moving<_Array<GfVec3d>> _translations;
    const cc::Moving<_Array<GfQuatd>> _rotations;
    const cc::Moving<_Array<GfVec3d>> _scales;
    const cc::Moving<_Array<GfMatrix4d>> _transforms;
};

using _Places = cc::Moving<std::vector<cc::AffineTransform>>;

static std::vector<cc::AffineTransform> _PlacesAt(_Places const &places, float time) {
    const auto between = places.At(time);
    std::vector<cc::AffineTransform> at = between.first;
    if (between.weight != 0) {
        for (size_t i = 0; i < at.size(); ++i) {
            at[i] = cc::AffineTransform::Lerp(at[i], between.second[i], between.weight);
        }
    }
    return at;
}

/// Each outer place has all the inner ones.
static _Places _Multiply(_Places const &outer, _Places const &inner) {
    std::set<float> times(outer.Times().begin(), outer.Times().end());
    times.insert(inner.Times().begin(), inner.Times().end());
    std::vector<std::vector<cc::AffineTransform>> poses;
    for (const float time : times) {
        const std::vector<cc::AffineTransform> from = _PlacesAt(outer, time);
        const std::vector<cc::AffineTransform> own = _PlacesAt(inner, time);
        std::vector<cc::AffineTransform> all(from.size() * own.size());
        tbb::parallel_for(size_t(0), all.size(),
                          [&](size_t i) { all[i] = from[i / own.size()] * own[i % own.size()]; });
        poses.push_back(std::move(all));
    }
    return {{times.begin(), times.end()}, std::move(poses)};
}

_Places HdCCInstancer::ComputeInstances(SdfPath const &prototype) const {
    // Scene indices leave it to us to hide what an invisible instancer places.
    const bool isVisible = GetDelegate()->GetVisible(GetId());
    const VtIntArray indices =
        isVisible ? GetDelegate()->GetInstanceIndices(GetId(), prototype) : VtIntArray();
    const _Elements elements(*this, _param ? _param->GetShutter() : HdCCShutter());
    if (_param && !elements.IsUsable()) {
        _param->WarnOnce(GetId(),
                         "places of instances have a type that cannot be used; those "
                         "values are ignored");
    }
    std::vector<float> times = elements.Times();
    std::vector<std::vector<cc::AffineTransform>> poses;
    for (const float time : times) {
        poses.push_back(elements.At(indices, time));
    }
    _Places own(std::move(times), std::move(poses));
    HdCCInstancer const *const parent = _Parent();
    return parent ? _Multiply(parent->ComputeInstances(GetId()), own) : own;
}

bool HdCCInstancer::FindPrimvar(SdfPath const &prototype, TfToken const &name, cc::Primvar *primvar,
                                std::string *error) const {
    const VtIntArray indices = GetDelegate()->GetInstanceIndices(GetId(), prototype);
    HdCCInstancer const *const parent = _Parent();
    if (HdCCGetPrimvar(GetDelegate(), GetId(), name, {HdInterpolationInstance}, primvar, error)) {
        const size_t copies = parent ? parent->ComputeInstances(GetId()).Poses().front().size() : 1;
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
