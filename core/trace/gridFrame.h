#pragma once

#include "core/math/vec.h"

namespace cc {

/// What rounding may do to a place in a frame, in units of the coordinates it was computed from.
constexpr float kFrameMargin = 1e-6f;

/// An affine frame in which a limit grid nearly is the square of its parameters: the first axis
/// counts columns, the second rows, the third is the height above the plane that fits the corners.
/// How far points stray from their places is measured (MeasureDeviation). A ray in the frame then
/// knows which quads it may meet: those around its way through a flat box.
struct GridFrame {
    GridFrame() = default;
    /// @param corners  of the grid at columns and rows (0, 0), (side, 0), (side, side), (0, side)
    GridFrame(const Vec3f corners[4], int side);

    /// Sets how far points stray along an axis, but for rounding.
    void SetDeviation(int k, float least, float greatest);
    /// Makes room for quads that may be off by a distance.
    void Widen(float distance);

    Vec3f base;      ///< the place of column 0, row 0
    Vec3f axes[3];   ///< place along an axis by a point relative to base; zero if there is no plane
    float lower[3];  ///< the least deviation of points along an axis
    float upper[3];  ///< the greatest
    float margin[3];   ///< rounding along an axis, for a ray that begins one unit from the base
    float extent = 0;  ///< of the coordinates of points
    int side = 0;
};

}  // namespace cc
