#pragma once

#include "core/math/vec.h"
#include "core/trace/eyeSpace.h"
#include "core/trace/levelMetric.h"
#include "core/trace/surface.h"

namespace cc {

/// The levels of one instance's patches, so that their quads are no further from the limit surface
/// than some pixels, seen by a camera.
///
/// An edge has a level of its own, which follows from the control points at its ends and nothing
/// else (ChordErrors, PatchTable::EdgeEnds): patches on both sides find the same, to the bit, and
/// need to know nothing of each other. A patch is as fine as its finest edge.
class PixelErrorLevels {
  public:
    PixelErrorLevels(const PixelErrorMetric& metric, const Instance& instance);

    /// One level for all patches; no edge has a finer one.
    int Whole() const;
    PatchLevels Of(uint32_t patch) const;

  private:
    int _EdgeLevel(const EdgePoints& edge) const;
    /// The least level that leaves an error small enough at a depth.
    int _LevelFor(float error, float depth) const;
    /// The depth of what is no further than a distance from a point, or what stands for it out of
    /// sight; not positive if that may hold the eye.
    float _Depth(const Vec3f& middle, float reach) const;

    /// How much coarser than its finest edge an edge of a patch may be: what a grid can be stitched
    /// to.
    static constexpr int kMostDifference = 5;

    const Surface& _surface;
    const LevelView _view;
    const EyeSpace _space;
    const float _scale;  ///< pixel errors at depth 1 by errors in object space
    int _least, _finest;
};

}  // namespace cc
