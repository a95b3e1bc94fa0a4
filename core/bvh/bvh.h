#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/math/box.h"

namespace cc {

/// Children of a node: what one SIMD test takes at once.
constexpr int kBvhWidth = 16;

/// No tree has more levels of nodes.
constexpr int kBvhMaxDepth = 64;

/// A wide node in three cache lines. The boxes of its children are quantized in the node's own
/// box, outwards: a bound is origin + scale * byte. Scales are powers of two, so that this has one
/// rounding, with or without a fused multiply-add. Unused slots are at the end.
struct alignas(64) BvhNode {
    uint8_t lower[3][kBvhWidth], upper[3][kBvhWidth];
    /// An inner node's index, or kBvhLeaf | a primitive's index.
    uint32_t child[kBvhWidth];
    float origin[3], scale[3];
    int childCount;

    /// The box of a child, as tracers see it.
    Box3f ChildBox(int slot) const;
};

constexpr uint32_t kBvhLeaf = 0x80000000u;

/// A bounding volume hierarchy over primitives known by their boxes only: patches of a surface, or
/// instances of a scene. Built by the surface area heuristic, in parallel; the same boxes give the
/// same tree, whatever the number of threads.
class Bvh {
  public:
    Bvh() = default;
    /// Primitives with empty boxes are left out.
    explicit Bvh(const std::vector<Box3f>& boxes);

    /// Takes new boxes of the primitives: the tree keeps its shape and its boxes follow, unless
    /// that makes it much worse than it was built, or other boxes are empty than before. Then it
    /// is built anew.
    /// @param boxes  as many as it was built of
    void Move(const std::vector<Box3f>& boxes);

    bool IsEmpty() const { return _nodes.empty(); }
    /// The first node is the root. The nodes below a node follow it without a gap, children in the
    /// order of their slots.
    const std::vector<BvhNode>& Nodes() const { return _nodes; }
    const Box3f& Bounds() const { return _bounds; }
    size_t Bytes() const { return _nodes.capacity() * sizeof(BvhNode); }

  private:
    std::vector<BvhNode> _nodes;
    Box3f _bounds;
    /// As it was built, by the surface area heuristic (TraversalCost).
    double _builtCost = 0;
    /// Those that are not left out.
    size_t _primitiveCount = 0;
};

}  // namespace cc
