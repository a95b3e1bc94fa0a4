#pragma once

#include "core/math/inlineVector.h"
#include "core/math/vec.h"
#include "core/subdiv/patchTable.h"

namespace cc {

/// A quad with its 1-ring where one corner is an extraordinary vertex: a smooth interior vertex of
/// valence n other than 4 (paper, Figure 2c; Stam 1998). The quad's parameters are (0,0) at the
/// extraordinary vertex.
///
/// The 2n + 8 points are: the extraordinary vertex; its ring of n edge neighbours and n face
/// diagonals by turns, e0 f0 e1 f1 ..., where e0 is the quad's corner at (1,0), f0 the one at (1,1)
/// and e1 the one at (0,1); then the seven points that complete the 4x4 grid beyond the quad,
/// from (3,0) by (3,3) to (0,3) in grid columns and rows.
class ExtraordinaryPatch {
  public:
    /// Points up to which a patch needs no allocation: those of valence 8.
    using Points = InlineVector<Vec3f, 24>;

    ExtraordinaryPatch(const Vec3f* points, int valence) : _valence(valence) {
        _points.assign(points, points + 2 * valence + 8);
    }

    int Valence() const { return _valence; }
    const Points& ControlPoints() const { return _points; }

    /// The three regular quarters of one Catmull-Clark step, as 4x4 B-spline points in rows along
    /// u: [0] is u > 1/2, v < 1/2; [1] is u > 1/2, v > 1/2; [2] is u < 1/2, v > 1/2.
    struct RegularQuarters {
        Vec3f points[3][16];
    };

    /// One Catmull-Clark step: returns the regular quarters and becomes the quarter that keeps the
    /// extraordinary vertex.
    void Subdivide(RegularQuarters* quarters);

    /// Limit position of the extraordinary vertex.
    Vec3f LimitPosition() const;

    /// Two independent tangents of the limit surface at the extraordinary vertex, of arbitrary
    /// length; their cross product points along the outward normal (Halstead et al. 1993).
    void LimitTangents(Vec3f* towardsU, Vec3f* towardsV) const;

    /// Limit positions of the quad's corners (0,0) (1,0) (1,1) (0,1).
    void LimitCorners(Vec3f corners[4]) const;

    /// Moves all points.
    void Translate(const Vec3f& by);

  private:
    const Vec3f& _EdgeNeighbor(int i) const { return _points[1 + 2 * (i % _valence)]; }
    const Vec3f& _FaceDiagonal(int i) const { return _points[2 + 2 * (i % _valence)]; }
    void _GatherGrid(Vec3f grid[4][4]) const;
    void _RefineRing();

    int _valence;
    Points _points;
    Points _scratch;
};

/// @param values  one value a patch point
ExtraordinaryPatch GatherExtraordinary(const PatchTable& patches, uint32_t patch,
                                       const Vec3f* values);

}  // namespace cc
