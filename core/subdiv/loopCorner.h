#pragma once

#include "core/math/inlineVector.h"
#include "core/math/vec.h"
#include "core/subdiv/ringTags.h"

namespace cc {

/// The edges of a sharp corner, from the corner to its neighbours, counterclockwise: one a face if
/// they close around it, one more if they are open between two that are sharp for ever.
using CornerEdges = InlineVector<Vec3f, RingTags::kInlineEdges + 1>;

/// Tangents, of arbitrary length, in the plane that a face's edges at a sharp corner tend to under
/// Loop's scheme; their cross product points along the outward normal. Where both edges tend to
/// the same direction they lie to either side of it. Returns false where the edges that decide are
/// parallel but for rounding, as those of a corner of two faces on a straight boundary: no mask is
/// known to us then.
bool LoopCornerTangents(const CornerEdges& edges, bool isClosed, int face, Vec3f* towardsEdge,
                        Vec3f* towardsNextEdge);

}  // namespace cc
