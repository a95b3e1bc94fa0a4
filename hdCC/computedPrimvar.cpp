#include "hdCC/computedPrimvar.h"

#include <map>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "pxr/base/gf/matrix4d.h"
#include "pxr/base/gf/matrix4f.h"
#include "pxr/base/gf/vec3f.h"
#include "pxr/base/vt/array.h"
#include "pxr/base/vt/types.h"
#include "pxr/imaging/hd/extComputationContext.h"

PXR_NAMESPACE_OPEN_SCOPE

/// Computations of computations of ...: more are none that anybody meant.
static constexpr int kMostNested = 16;

/// The inputs of one run, and what it makes of them.
class _Run final : public HdExtComputationContext {
  public:
    std::map<TfToken, VtValue> inputs, outputs;
    bool hasFailed = false;

    VtValue const &GetInputValue(TfToken const &name) const override {
        static const VtValue none;
        VtValue const *const value = GetOptionalInputValuePtr(name);
        return value ? *value : none;
    }
    VtValue const *GetOptionalInputValuePtr(TfToken const &name) const override {
        const auto found = inputs.find(name);
        return found == inputs.end() ? nullptr : &found->second;
    }
    void SetOutputValue(TfToken const &name, VtValue const &output) override {
        outputs[name] = output;
    }
    void RaiseComputationError() override { hasFailed = true; }
};

static float _Blend(float a, float b, float weight) { return a + (b - a) * weight; }
static GfVec3f _Blend(GfVec3f const &a, GfVec3f const &b, float weight) {
    return a + (b - a) * weight;
}
static GfMatrix4f _Blend(GfMatrix4f const &a, GfMatrix4f const &b, float weight) {
    return a * (1.0 - weight) + b * double(weight);
}
static GfMatrix4d _Blend(GfMatrix4d const &a, GfMatrix4d const &b, float weight) {
    return a * (1.0 - weight) + b * double(weight);
}

/// Sets a value to one between two arrays of a type, if they are.
template <class T>
static void _BlendArrays(VtValue const &a, VtValue const &b, float weight, VtValue *between) {
    if (!a.IsHolding<VtArray<T>>() || !b.IsHolding<VtArray<T>>()) {
        return;
    }
    VtArray<T> const &first = a.UncheckedGet<VtArray<T>>();
    VtArray<T> const &second = b.UncheckedGet<VtArray<T>>();
    if (first.size() != second.size()) {
        return;
    }
    VtArray<T> blended(first.size());
    for (size_t i = 0; i < first.size(); ++i) {
        blended[i] = _Blend(first.cdata()[i], second.cdata()[i], weight);
    }
    *between = VtValue(blended);
}

/// What cannot be blended stays as it was before.
static VtValue _ValueAt(cc::Moving<VtValue> const &values, float time) {
    const auto [first, second, weight] = values.At(time);
    VtValue between = first;
    if (weight > 0) {
        _BlendArrays<float>(first, second, weight, &between);
        _BlendArrays<GfVec3f>(first, second, weight, &between);
        _BlendArrays<GfMatrix4f>(first, second, weight, &between);
        if (first.IsHolding<GfMatrix4d>() && second.IsHolding<GfMatrix4d>()) {
            between = VtValue(_Blend(first.UncheckedGet<GfMatrix4d>(),
                                     second.UncheckedGet<GfMatrix4d>(), weight));
        }
    }
    return between;
}

namespace {

/// A computation, its inputs over the time that a shutter is open, and those it takes more from.
class _Computation {
  public:
    _Computation(HdSceneDelegate *delegate, SdfPath const &id, HdCCShutter const &shutter,
                 int nesting = 0)
        : _delegate(delegate),
          _id(id),
          _isAggregation(delegate->GetExtComputationOutputDescriptors(id).empty()) {
        for (TfToken const &name : delegate->GetExtComputationSceneInputNames(id)) {
            _inputs[name] = HdCCSample<VtValue>(
                shutter,
                [&](size_t room, float *times, VtValue *values) {
                    return delegate->SampleExtComputationInput(id, name, shutter.open,
                                                               shutter.close, room, times, values);
                },
                [&] { return delegate->GetExtComputationInput(id, name); });
        }
        for (auto const &source : delegate->GetExtComputationInputDescriptors(id)) {
            if (nesting < kMostNested) {
                _sources.emplace_back(
                    source, std::make_unique<_Computation>(delegate, source.sourceComputationId,
                                                           shutter, nesting + 1));
            }
        }
    }

    /// Those at which any input is known.
    void AddTimes(std::set<float> *times) const {
        for (auto const &[name, values] : _inputs) {
            times->insert(values.Times().begin(), values.Times().end());
        }
        for (auto const &[input, source] : _sources) {
            source->AddTimes(times);
        }
    }

    /// An output at a time; empty if the computation fails.
    VtValue Evaluate(TfToken const &output, float time) const {
        _Run run;
        for (auto const &[name, values] : _inputs) {
            run.inputs[name] = _ValueAt(values, time);
        }
        for (auto const &[input, source] : _sources) {
            run.inputs[input.name] = source->Evaluate(input.sourceComputationOutputName, time);
        }
        if (_isAggregation) {
            return run.inputs[output];
        }
        _delegate->InvokeExtComputation(_id, &run);
        return run.hasFailed ? VtValue() : run.outputs[output];
    }

  private:
    HdSceneDelegate *_delegate;
    SdfPath _id;
    /// It computes nothing: its inputs are what others take from it.
    bool _isAggregation;
    std::map<TfToken, cc::Moving<VtValue>> _inputs;
    std::vector<std::pair<HdExtComputationInputDescriptor, std::unique_ptr<_Computation>>> _sources;
};

}  // namespace

cc::Moving<VtValue> HdCCSampleComputedPrimvar(HdSceneDelegate *delegate,
                                              HdExtComputationPrimvarDescriptor const &primvar,
                                              HdCCShutter const &shutter) {
    const _Computation computation(delegate, primvar.sourceComputationId, shutter);
    std::set<float> times;
    computation.AddTimes(&times);
    std::vector<VtValue> poses;
    for (const float time : times) {
        poses.push_back(computation.Evaluate(primvar.sourceComputationOutputName, time));
    }
    if (poses.size() < 2) {
        return poses.empty() ? cc::Moving<VtValue>() : cc::Moving<VtValue>(poses.front());
    }
    return {{times.begin(), times.end()}, std::move(poses)};
}

PXR_NAMESPACE_CLOSE_SCOPE
