#pragma once

#include <memory>
#include <random>
#include <vector>

#include "core/trace/instanceLevels.h"
#include "core/trace/surface.h"

namespace cc::test {

/// A surface that is cut into quads as levels say, and stitched where they differ.
class CutSurface {
  public:
    CutSurface(const Surface& surface, const InstanceLevels& levels);

    /// How often it winds around a point: the solid angles of its triangles, as parts of the
    /// sphere. From a point where this is not zero, every way out leads through the surface.
    double WindingNumber(const Vec3f& point) const;
    /// True if it winds around a point, and around those that rounding may take for it.
    /// @param rounding  how far away those are
    bool Encloses(const Vec3f& point, float rounding) const;

  private:
    class Patch;
    std::vector<std::shared_ptr<const Patch>> _patches;
};

/// Points well inside a closed surface, as many as were found, at most `most`.
std::vector<Vec3f> EnclosedPoints(const Surface& surface, const InstanceLevels& levels, size_t most,
                                  std::mt19937* random);

}  // namespace cc::test
