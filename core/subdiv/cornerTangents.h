#pragma once

#include "core/math/inlineVector.h"
#include "core/math/vec.h"
#include "core/subdiv/ringTags.h"

namespace cc {

/// What surrounds a sharp corner, as seen from it, counterclockwise.
struct SharpCorner {
    using Vectors = InlineVector<Vec3f, RingTags::kInlineEdges + 1>;

    /// To its neighbours along edges: one a face if the faces close around it, one more if they are
    /// open between two edges that are sharp for ever.
    Vectors edges;
    /// To the opposite corners of its faces, if they are quads of Catmull-Clark; none if they are
    /// triangles of Loop's scheme.
    Vectors diagonals;
    bool isClosed;
};

/// Tangents, of arbitrary length, in the plane that a face's edges at a sharp corner tend to under
/// subdivision; their cross product points along the outward normal. Where both edges tend to the
/// same direction they lie to either side of it. Returns false where what decides is parallel but
/// for rounding, as the ends of two faces on a straight boundary: no mask is known to us then.
bool CornerTangents(const SharpCorner& corner, int face, Vec3f* towardsEdge,
                    Vec3f* towardsNextEdge);

}  // namespace cc
