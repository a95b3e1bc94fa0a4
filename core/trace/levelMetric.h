#pragma once

#include <array>
#include <cstdint>

#include "core/math/transform.h"
#include "core/math/vec.h"
#include "core/trace/instance.h"
#include "core/trace/surface.h"

namespace cc {

/// The finest level that there is.
constexpr int kFinestLevel = 8;

/// Into how many quads a patch is cut: 2^level along a base edge, inside and at each of its edges.
struct PatchLevels {
    uint8_t interior = 0;             ///< no less than those of the edges
    uint8_t edges[4] = {0, 0, 0, 0};  ///< edge 0 is v = 0, 1 is u = 1, 2 is v = 1, 3 is u = 0

    bool AreEqual() const {
        return *this == PatchLevels{interior, {interior, interior, interior, interior}};
    }
    bool operator==(const PatchLevels& b) const {
        return interior == b.interior && edges[0] == b.edges[0] && edges[1] == b.edges[1] &&
               edges[2] == b.edges[2] && edges[3] == b.edges[3];
    }
};

/// What levels need to know of a camera.
struct LevelView {
    std::array<double, 3> eye;
    Vec3f forward;  ///< unit, into the picture
    float pixels;   ///< that a unit covers at most: at distance 1 if it is not orthographic
    bool isOrthographic;
    /// The least depth of what is seen, by its distance from the eye. What is nearer to the plane
    /// of the eye than half of that is out of sight.
    float leastCosine;
};

/// How finely surfaces are cut: the same everywhere, or as a camera needs it.
class LevelMetric {
  public:
    /// @param level  0..8, of every patch
    LevelMetric(int level) : _finest(level) {}  // NOLINT(google-explicit-constructor)
    /// @param pixelError  how far quads may be from the surface in the picture, in pixels
    /// @param finest      0..8, the finest level, however large an error that leaves
    LevelMetric(const LevelView& view, float pixelError, int finest)
        : _view(view), _pixelError(pixelError), _finest(finest), _isUniform(false) {}

    bool IsUniform() const { return _isUniform; }
    int Finest() const { return _finest; }
    const LevelView& View() const { return _view; }
    float PixelError() const { return _pixelError; }

  private:
    LevelView _view{};
    float _pixelError = 0;
    int _finest;
    bool _isUniform = true;
};

/// The levels of one instance's patches.
///
/// An edge has a level of its own, which follows from the control points at its ends and nothing
/// else (ChordErrors, PatchTable::EdgeEnds): patches on both sides find the same, to the bit, and
/// need to know nothing of each other. A patch is as fine as its finest edge.
class InstanceLevels {
  public:
    InstanceLevels(const LevelMetric& metric, const Instance& instance);

    /// The level of every patch, if all are alike: where that was asked for, and on surfaces of
    /// triangles, which are cut alike all over.
    bool IsUniform() const { return _isUniform; }
    int Uniform() const { return _least; }
    PatchLevels Of(uint32_t patch) const;

  private:
    int _EdgeLevel(const EdgePoints& edge) const;
    /// How much coarser than its finest edge an edge of a patch may be: what a grid can be stitched
    /// to.
    static constexpr int kMostDifference = 5;

    /// The least level that leaves an error small enough at a depth.
    int _LevelFor(float error, float depth) const;
    /// The depth of what is no further than a distance from a point, or what stands for it out of
    /// sight; not positive if that may hold the eye.
    float _Depth(const Vec3f& middle, float reach) const;
    int _WholeLevel() const;
    Vec3f _FromEye(const Vec3f& p) const;

    const Surface& _surface;
    LevelView _view;
    Vec3f _rows[3];      ///< of the matrix from object to world space
    Vec3f _offset;       ///< of the object's origin from the eye
    float _scale = 0;    ///< pixel errors at depth 1 by errors in object space
    float _stretch = 0;  ///< the most that a length grows by from object to world space
    int _least, _finest;
    bool _isUniform;
};

}  // namespace cc
