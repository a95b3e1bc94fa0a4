#include "core/trace/instanceLevels.h"

#include <algorithm>

namespace cc {

InstanceLevels::Levels InstanceLevels::_Make(const LevelMetric& metric, const Instance& instance,
                                             bool isRemote) {
    const PatchTable& patches = SurfaceOf(instance).Patches();
    const auto adapt = [&](const auto& levels) -> Levels {
        if (patches.Count() == 0 || patches.IsCutAlike()) {
            return UniformMetric{levels.Whole()};
        }
        return levels;
    };
    if (const auto* rule = std::get_if<PixelErrorMetric>(&metric.GetRule())) {
        return adapt(PixelErrorLevels(isRemote ? rule->Remote() : *rule, instance));
    }
    if (const auto* rule = std::get_if<DistanceMetric>(&metric.GetRule())) {
        return adapt(DistanceLevels(*rule, instance));
    }
    return UniformMetric{std::max(metric.Finest(), patches.MaxDepth())};
}

PatchLevels InstanceLevels::Of(uint32_t patch) const {
    if (const auto* levels = std::get_if<PixelErrorLevels>(&_levels)) {
        return levels->Of(patch);
    }
    if (const auto* levels = std::get_if<DistanceLevels>(&_levels)) {
        return levels->Of(patch);
    }
    const auto level = static_cast<uint8_t>(Uniform());
    return {level, {level, level, level, level}};
}

}  // namespace cc
