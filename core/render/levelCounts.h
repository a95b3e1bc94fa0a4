#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <vector>

#include "core/trace/instance.h"
#include "core/trace/levelMetric.h"

namespace cc {

/// How many patches there are of each level.
using LevelCounts = std::array<uint64_t, kFinestLevel + 1>;

/// Counts the patches of all instances by the level that they are cut to inside, in parallel. Of
/// more than two millions, evenly spread ones stand for the others.
/// @param stop  counts are wrong once it turns true; may be null
LevelCounts CountLevels(const std::vector<Instance>& instances, const LevelMetric& metric,
                        const std::atomic<bool>* stop);

}  // namespace cc
