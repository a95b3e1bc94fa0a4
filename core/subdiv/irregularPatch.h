#pragma once

#include "core/math/box.h"
#include "core/math/vec.h"
#include "core/subdiv/extraordinaryPatch.h"
#include "core/subdiv/patchTable.h"
#include "core/subdiv/vertexRing.h"

namespace cc {

/// A quad with the rings of its four corners: all that shapes it, whatever valences, creases,
/// corners and boundaries are there. Corners are at parameters (0,0) (1,0) (1,1) (0,1).
struct IrregularPatch {
    VertexRing rings[4];
    /// Which face of each ring the quad is: its next corner is that ring's edge neighbour of the
    /// same number, its previous corner the one after.
    int faces[4];

    /// One Catmull-Clark step. Quarter i holds corner i of the patch, and the quarters' parameters
    /// run as the patch's do.
    void Subdivide(IrregularPatch quarters[4]) const;

    /// If the surface is a bicubic B-spline, writes its 4x4 points in rows along u.
    bool ToBSpline(Vec3f points[16]) const;

    /// If one corner is an extraordinary vertex and the rest is regular, writes the patch as the
    /// points of an ExtraordinaryPatch that is turned to begin at that corner. Returns the corner,
    /// or -1.
    int ToExtraordinary(ExtraordinaryPatch::Points* points) const;

    /// Box of all points that shape the quad: it holds the surface.
    Box3f HullBox() const;

    /// Limit positions of the corners.
    void LimitCorners(Vec3f corners[4]) const;

    /// Moves all points.
    void Translate(const Vec3f& by);

  private:
    bool _IsOpenEdge(int edge) const;
    void _GatherGrid(Vec3f grid[4][4]) const;
};

/// @param values  one value a patch point
IrregularPatch GatherIrregular(const PatchTable& patches, uint32_t patch, const Vec3f* values);

}  // namespace cc
