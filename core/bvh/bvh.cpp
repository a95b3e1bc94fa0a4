#include "core/bvh/bvh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>

#include <tbb/parallel_for.h>

namespace cc {
namespace {

constexpr int kBinCount = 16;
/// Ranges below this are built by one thread.
constexpr size_t kParallelThreshold = 4096;
/// From this depth on ranges are halved, so that no scene makes the tree deeper than kBvhMaxDepth.
constexpr int kMaxHeuristicDepth = kBvhMaxDepth / 2;

struct Primitive {
    Box3f box;
    Vec3f center;
    uint32_t index;
};

struct Range {
    size_t begin, end;
    Box3f box, centerBox;

    size_t Size() const { return end - begin; }
};

/// A node of the tree while it grows: its own children, then those of the inner ones.
struct BuildNode {
    int count = 0;
    Box3f boxes[kBvhWidth];
    uint32_t leaves[kBvhWidth];
    std::unique_ptr<BuildNode> children[kBvhWidth];
    size_t nodeCount = 1;
};

class Builder {
  public:
    explicit Builder(std::vector<Primitive>* primitives) : _primitives(*primitives) {}

    Range Measure(size_t begin, size_t end) const {
        Range range{begin, end, {}, {}};
        for (size_t i = begin; i < end; ++i) {
            range.box.Extend(_primitives[i].box);
            range.centerBox.Extend(_primitives[i].center);
        }
        return range;
    }

    /// Makes the node of a range: ranges that fit into a node of leaves each, or as many as there
    /// are slots; then leaves of what is left of the slots.
    std::unique_ptr<BuildNode> Build(const Range& root, int depth) {
        std::array<Range, kBvhWidth> ranges;
        ranges[0] = root;
        int count = 1;
        // The widest first, until all are small.
        while (count < kBvhWidth) {
            const int widest = _WidestRange(ranges, count);
            if (widest < 0) {
                break;
            }
            _SplitInto(&ranges, &count, widest, depth);
        }
        // A small range needs a node of its own: spare those that the free slots can hold.
        for (int i = _SmallestRange(ranges, count);
             i >= 0 && count + static_cast<int>(ranges[i].Size()) - 1 <= kBvhWidth;
             i = _SmallestRange(ranges, count)) {
            _Scatter(&ranges, &count, i);
        }
        auto node = std::make_unique<BuildNode>();
        node->count = count;
        const auto buildChild = [&](int i) {
            node->boxes[i] = ranges[i].box;
            if (ranges[i].Size() == 1) {
                node->leaves[i] = kBvhLeaf | _primitives[ranges[i].begin].index;
            } else {
                node->children[i] = Build(ranges[i], depth + 1);
            }
        };
        if (root.Size() >= kParallelThreshold) {
            tbb::parallel_for(0, count, buildChild);
        } else {
            for (int i = 0; i < count; ++i) {
                buildChild(i);
            }
        }
        for (int i = 0; i < count; ++i) {
            node->nodeCount += node->children[i] ? node->children[i]->nodeCount : 0;
        }
        return node;
    }

  private:
    /// The range of the largest box among those too large for a node of leaves, or -1.
    static int _WidestRange(const std::array<Range, kBvhWidth>& ranges, int count) {
        int widest = -1;
        float area = -1;
        for (int i = 0; i < count; ++i) {
            if (ranges[i].Size() > kBvhWidth && ranges[i].box.HalfArea() > area) {
                widest = i;
                area = ranges[i].box.HalfArea();
            }
        }
        return widest;
    }

    /// The range of fewest primitives, more than one, or -1.
    static int _SmallestRange(const std::array<Range, kBvhWidth>& ranges, int count) {
        int smallest = -1;
        for (int i = 0; i < count; ++i) {
            if (ranges[i].Size() > 1 &&
                (smallest < 0 || ranges[i].Size() < ranges[smallest].Size())) {
                smallest = i;
            }
        }
        return smallest;
    }

    void _SplitInto(std::array<Range, kBvhWidth>* ranges, int* count, int which, int depth) {
        Range& range = (*ranges)[which];
        const size_t middle = _Split(range, depth);
        (*ranges)[(*count)++] = Measure(middle, range.end);
        range = Measure(range.begin, middle);
    }

    /// Replaces a range by ranges of one primitive each.
    void _Scatter(std::array<Range, kBvhWidth>* ranges, int* count, int which) {
        const Range range = (*ranges)[which];
        (*ranges)[which] = Measure(range.begin, range.begin + 1);
        for (size_t i = range.begin + 1; i < range.end; ++i) {
            (*ranges)[(*count)++] = Measure(i, i + 1);
        }
    }

    struct Bin {
        Box3f box;
        size_t count = 0;
    };

    static int _BinOf(const Range& range, int axis, const Vec3f& center) {
        const float width = range.centerBox.upper[axis] - range.centerBox.lower[axis];
        const float position = (center[axis] - range.centerBox.lower[axis]) / width;
        return std::min(kBinCount - 1, static_cast<int>(position * kBinCount));
    }

    struct Plane {
        int axis = -1;
        int bin = 0;  ///< the first bin on the right
        float cost = std::numeric_limits<float>::infinity();
    };

    /// The cheapest plane between bins of one axis.
    void _TryAxis(const Range& range, int axis, Plane* best) const {
        if (!(range.centerBox.upper[axis] > range.centerBox.lower[axis])) {
            return;
        }
        std::array<Bin, kBinCount> bins;
        for (size_t i = range.begin; i < range.end; ++i) {
            Bin& bin = bins[_BinOf(range, axis, _primitives[i].center)];
            bin.box.Extend(_primitives[i].box);
            ++bin.count;
        }
        std::array<float, kBinCount> leftCost{};
        Bin left;
        for (int b = 0; b + 1 < kBinCount; ++b) {
            left.box.Extend(bins[b].box);
            left.count += bins[b].count;
            leftCost[b + 1] = left.count > 0 ? left.box.HalfArea() * left.count : 0;
        }
        Bin right;
        for (int b = kBinCount - 1; b > 0; --b) {
            right.box.Extend(bins[b].box);
            right.count += bins[b].count;
            if (right.count == 0 || right.count == range.Size()) {
                continue;
            }
            const float cost = leftCost[b] + right.box.HalfArea() * right.count;
            if (cost < best->cost) {
                *best = {axis, b, cost};
            }
        }
    }

    /// Reorders a range's primitives; returns where its right part begins.
    size_t _Split(const Range& range, int depth) {
        Plane plane;
        for (int axis = 0; axis < 3 && depth < kMaxHeuristicDepth; ++axis) {
            _TryAxis(range, axis, &plane);
        }
        const auto begin = _primitives.begin() + range.begin, end = _primitives.begin() + range.end;
        if (plane.axis < 0) {
            return range.begin + range.Size() / 2;  // too deep, or all centres coincide
        }
        const auto middle = std::partition(begin, end, [&](const Primitive& p) {
            return _BinOf(range, plane.axis, p.center) < plane.bin;
        });
        return middle - _primitives.begin();
    }

    std::vector<Primitive>& _primitives;
};

/// Quantizes the bounds of all children along one axis.
void QuantizeAxis(const BuildNode& from, int axis, BvhNode* node) {
    float lowest = from.boxes[0].lower[axis], highest = from.boxes[0].upper[axis];
    for (int i = 1; i < from.count; ++i) {
        lowest = std::min(lowest, from.boxes[i].lower[axis]);
        highest = std::max(highest, from.boxes[i].upper[axis]);
    }
    // The smallest power of two whose 255 steps reach across, also after rounding.
    int exponent =
        std::ilogb(std::max((highest - lowest) / 255, std::numeric_limits<float>::min()));
    while (lowest + std::ldexp(255.0f, exponent) < highest) {
        ++exponent;
    }
    const float scale = std::ldexp(1.0f, exponent);
    node->origin[axis] = lowest;
    node->scale[axis] = scale;
    for (int i = 0; i < from.count; ++i) {
        const float lower = from.boxes[i].lower[axis], upper = from.boxes[i].upper[axis];
        int low = std::clamp(static_cast<int>((lower - lowest) / scale), 0, 255);
        while (low > 0 && lowest + scale * static_cast<float>(low) > lower) {
            --low;
        }
        int high = std::clamp(static_cast<int>((upper - lowest) / scale), 0, 255);
        while (high < 255 && lowest + scale * static_cast<float>(high) < upper) {
            ++high;
        }
        node->lower[axis][i] = static_cast<uint8_t>(low);
        node->upper[axis][i] = static_cast<uint8_t>(high);
    }
}

/// Copies the tree into the array, a node before its children.
void Flatten(const BuildNode& from, std::vector<BvhNode>* nodes) {
    const size_t index = nodes->size();
    nodes->emplace_back();
    BvhNode node{};
    node.childCount = from.count;
    for (int axis = 0; axis < 3; ++axis) {
        QuantizeAxis(from, axis, &node);
    }
    for (int i = 0; i < from.count; ++i) {
        node.child[i] = from.children[i] ? static_cast<uint32_t>(nodes->size()) : from.leaves[i];
        if (from.children[i]) {
            Flatten(*from.children[i], nodes);
        }
    }
    (*nodes)[index] = node;
}

}  // namespace

Box3f BvhNode::ChildBox(int slot) const {
    Box3f box;
    for (int axis = 0; axis < 3; ++axis) {
        box.lower[axis] = origin[axis] + scale[axis] * static_cast<float>(lower[axis][slot]);
        box.upper[axis] = origin[axis] + scale[axis] * static_cast<float>(upper[axis][slot]);
    }
    return box;
}

Bvh::Bvh(const std::vector<Box3f>& boxes) {
    std::vector<Primitive> primitives;
    primitives.reserve(boxes.size());
    for (size_t i = 0; i < boxes.size(); ++i) {
        if (!boxes[i].IsEmpty()) {
            primitives.push_back({boxes[i], boxes[i].Center(), static_cast<uint32_t>(i)});
        }
    }
    if (primitives.empty()) {
        return;
    }
    Builder builder(&primitives);
    const Range root = builder.Measure(0, primitives.size());
    const std::unique_ptr<BuildNode> tree = builder.Build(root, 0);
    _bounds = root.box;
    _nodes.reserve(tree->nodeCount);
    Flatten(*tree, &_nodes);
}

}  // namespace cc
