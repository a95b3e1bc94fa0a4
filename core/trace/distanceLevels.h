#pragma once

#include "core/trace/eyeSpace.h"
#include "core/trace/levelMetric.h"
#include "core/trace/surface.h"

namespace cc {

/// The levels of one instance's patches by distance, as in section 3.7 of the paper: coarse, medium
/// or fine, by log2(reach / D), where D is how far the middle of a patch is from the eye.
///
/// An edge has a level of its own that follows from the control points at its ends: that of what is
/// as near as the nearest that may lie on either side of it. Where neighbours differ it is the
/// finer one's, and the coarser one ends in fans.
class DistanceLevels {
  public:
    DistanceLevels(const DistanceMetric& metric, const Instance& instance);

    /// One level for all patches.
    int Whole() const;
    PatchLevels Of(uint32_t patch) const;

  private:
    int _LevelAt(float distance) const;

    const Surface& _surface;
    const EyeSpace _space;
    const float _reach;
    const int _coarse, _fine;
};

}  // namespace cc
