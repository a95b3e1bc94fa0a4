#pragma once

#include "core/math/vec.h"

namespace cc {

/// What rounding may do to a place in a frame, in units of the coordinates it was computed from.
constexpr float kFrameMargin = 1e-6f;

/// A quadratic surface over a grid of columns and rows, along one axis: what a grid that is bent
/// and twisted has more than an even and flat one. With s for the grid's side, column c and row r
/// are columns c (c - s) + rows r (r - s) + twist (c - s/2) (r - s/2) further.
struct GridBend {
    float columns = 0, rows = 0, twist = 0;

    /// The least and the greatest value over all of a grid.
    struct Range {
        float least, greatest;
    };
    Range Values(int side) const;
    /// How far what is straight between points of the grid may be from it.
    float Sagitta() const;
};

/// An affine frame in which a limit grid nearly is the square of its parameters: the first axis
/// counts columns, the second rows, the third is the height above the plane that fits the corners.
/// How the grid is bent, and how far points stray from that, is measured (MeasureDeviation). A ray
/// in the frame then knows which quads it may meet: those around its way through a box, or through
/// the part of it where the grid can be.
struct GridFrame {
    GridFrame() = default;
    /// @param corners  of the grid at columns and rows (0, 0), (side, 0), (side, side), (0, side)
    GridFrame(const Vec3f corners[4], int side);

    /// Sets what a grid has more than an even and flat one along an axis: a quadratic surface, and
    /// how far points stray from it, but for rounding.
    void SetDeviation(int k, const GridBend& quadratic, float least, float greatest);
    /// Makes room for quads that may be off by a distance.
    void Widen(float distance);
    /// Whether rays that know the bends find so much fewer quads that it is worth the work.
    bool IsBent() const { return _quadsOfBends > 0.5f; }

    Vec3f base;        ///< the place of column 0, row 0
    Vec3f axes[3];     ///< place along an axis by a point relative to base; zero without a plane
    GridBend bend[3];  ///< along each axis
    float lower[3];    ///< the least that points stray from their places and the bend
    float upper[3];    ///< the greatest
    float boxLower[3], boxUpper[3];  ///< where all of the grid is
    float margin[3];   ///< rounding along an axis, for a ray that begins one unit from the base
    float extent = 0;  ///< of the coordinates of points
    int side = 0;

  private:
    float _quadsOfBends = 0;
};

}  // namespace cc
