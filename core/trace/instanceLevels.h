#pragma once

#include <variant>

#include "core/trace/distanceLevels.h"
#include "core/trace/instance.h"
#include "core/trace/levelMetric.h"
#include "core/trace/pixelErrorLevels.h"

namespace cc {

/// The levels of one instance's patches, by whatever metric. Patches on both sides of an edge find
/// the same level for it.
class InstanceLevels {
  public:
    /// @param isRemote  rays start elsewhere (PixelErrorMetric::remoteError)
    InstanceLevels(const LevelMetric& metric, const Instance& instance, bool isRemote = false)
        : _levels(_Make(metric, instance, isRemote)) {}

    /// True if all patches are cut alike: where that was asked for, and on surfaces of triangles.
    bool IsUniform() const { return std::holds_alternative<UniformMetric>(_levels); }
    /// The level of all of them, if they are cut alike.
    int Uniform() const {
        const UniformMetric* uniform = std::get_if<UniformMetric>(&_levels);
        return uniform ? uniform->finest : 0;
    }
    PatchLevels Of(uint32_t patch) const;

  private:
    using Levels = std::variant<UniformMetric, PixelErrorLevels, DistanceLevels>;
    static Levels _Make(const LevelMetric& metric, const Instance& instance, bool isRemote);

    const Levels _levels;
};

}  // namespace cc
