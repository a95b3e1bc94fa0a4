#include "core/trace/simdTargets.h"

#include <algorithm>
#include <cstdint>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/trace/simdTargets.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace cc {
namespace HWY_NAMESPACE {

/// A kernel that knows which target it is compiled for, and nothing else.
const char* TargetOfKernel() { return hwy::TargetName(HWY_TARGET); }

}  // namespace HWY_NAMESPACE
}  // namespace cc
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cc {
namespace {

HWY_EXPORT(TargetOfKernel);

/// Read before any target is chosen: afterwards Highway knows of the chosen one only.
const std::vector<int64_t>& AllTargets() {
    static const std::vector<int64_t> targets = hwy::SupportedAndGeneratedTargets();
    return targets;
}

}  // namespace

std::vector<std::string> SimdTargets() {
    std::vector<std::string> names;
    for (const int64_t target : AllTargets()) {
        names.emplace_back(hwy::TargetName(target));
    }
    return names;
}

std::string CurrentSimdTarget() { return HWY_DYNAMIC_DISPATCH(TargetOfKernel)(); }

std::string UseSimdTarget(const std::string& name) {
    const std::vector<std::string> names = SimdTargets();
    const auto found = name.empty() ? names.begin() : std::find(names.begin(), names.end(), name);
    if (found == names.end()) {
        std::string line = "there is no SIMD target '" + name + "' here; there are:";
        for (const std::string& known : names) {
            line += " " + known;
        }
        return line;
    }
    // For tests by its name, but the way to choose anew after kernels have run.
    hwy::SetSupportedTargetsForTest(AllTargets()[found - names.begin()]);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    return {};
}

}  // namespace cc
#endif  // HWY_ONCE
