#include "core/bvh/bvh.h"

#include <algorithm>
#include <array>
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

    /// Splits the widest of a node's ranges until it has all children it can hold.
    std::unique_ptr<BuildNode> Build(const Range& root, int depth) {
        std::array<Range, kBvhWidth> ranges;
        ranges[0] = root;
        int count = 1;
        while (count < kBvhWidth) {
            const int widest = _WidestRange(ranges, count);
            if (ranges[widest].Size() < 2) {
                break;
            }
            const size_t middle = _Split(ranges[widest], depth);
            ranges[count++] = Measure(middle, ranges[widest].end);
            ranges[widest] = Measure(ranges[widest].begin, middle);
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
    static int _WidestRange(const std::array<Range, kBvhWidth>& ranges, int count) {
        int widest = 0;
        float area = -1;
        for (int i = 0; i < count; ++i) {
            if (ranges[i].Size() > 1 && ranges[i].box.HalfArea() > area) {
                widest = i;
                area = ranges[i].box.HalfArea();
            }
        }
        return widest;
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

/// Copies the tree into the array, a node before its children.
void Flatten(const BuildNode& from, std::vector<BvhNode>* nodes) {
    const size_t index = nodes->size();
    nodes->emplace_back();
    BvhNode node;
    node.childCount = from.count;
    for (int i = 0; i < kBvhWidth; ++i) {
        const Box3f box = i < from.count ? from.boxes[i] : Box3f();
        node.lowerX[i] = box.lower.x;
        node.lowerY[i] = box.lower.y;
        node.lowerZ[i] = box.lower.z;
        node.upperX[i] = box.upper.x;
        node.upperY[i] = box.upper.y;
        node.upperZ[i] = box.upper.z;
        node.child[i] = 0;
        if (i < from.count) {
            node.child[i] =
                from.children[i] ? static_cast<uint32_t>(nodes->size()) : from.leaves[i];
        }
        if (i < from.count && from.children[i]) {
            Flatten(*from.children[i], nodes);
        }
    }
    (*nodes)[index] = node;
}

}  // namespace

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
