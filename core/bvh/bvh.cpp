#include "core/bvh/bvh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include "core/math/float4.h"

namespace cc {
namespace {

constexpr int kBinCount = 16;
/// Ranges below this are built by one thread.
constexpr size_t kParallelThreshold = 4096;
/// Ranges from this on are put into bins by all threads.
constexpr size_t kParallelBinThreshold = 1 << 16;
/// From this depth on ranges are halved, so that no scene makes the tree deeper than kBvhMaxDepth.
constexpr int kMaxHeuristicDepth = kBvhMaxDepth / 2;

/// Trees of fewer nodes are refitted by one thread.
constexpr size_t kParallelRefitThreshold = 64;
/// A tree that costs more than it did when it was built, times this, is built anew.
constexpr double kWorstRefitCost = 1.3;

struct alignas(16) Primitive {
    Vec3f lower;
    uint32_t index;
    Vec3f upper;

    BoxFloat4 Box() const { return {ToFloat4(lower), ToFloat4(upper)}; }
    Float4 Center() const { return (ToFloat4(lower) + ToFloat4(upper)) * 0.5f; }
};

struct Range {
    size_t begin, end;
    BoxFloat4 box, centerBox;

    size_t Size() const { return end - begin; }
};

struct Bin {
    BoxFloat4 box;
    size_t count = 0;

    void Extend(const Bin& bin) {
        box.Extend(bin.box);
        count += bin.count;
    }
    /// Of a bin that is not empty, by the surface area heuristic.
    float Cost() const {
        const Float4 size = box.upper - box.lower;
        const float area = size[0] * size[1] + size[1] * size[2] + size[2] * size[0];
        return area * static_cast<float>(count);
    }
};

/// The bins of a range along each axis, by the centres of primitives.
class Bins {
  public:
    explicit Bins(const Range& range) : _lower(range.centerBox.lower) {
        const Float4 width = range.centerBox.upper - _lower;
        // Along a flat axis all primitives are in the first bin. So they are where the width is so
        // small that its inverse overflows.
        _scale = width > kLeastWidth ? static_cast<float>(kBinCount) / width : Float4{};
    }

    /// The bin of a centre along each axis.
    Int4 Find(const Float4& center) const {
        const Int4 bin = __builtin_convertvector((center - _lower) * _scale, Int4);
        return bin < kBinCount ? bin : kBinCount - 1;
    }

    void Add(const Primitive& primitive) {
        const BoxFloat4 box = primitive.Box();
        const Int4 place = Find(primitive.Center());
        for (int axis = 0; axis < 3; ++axis) {
            Bin& bin = _bins[axis][place[axis]];
            bin.box.Extend(box);
            ++bin.count;
        }
    }
    void Add(const Bins& other) {
        for (int axis = 0; axis < 3; ++axis) {
            for (int b = 0; b < kBinCount; ++b) {
                _bins[axis][b].Extend(other._bins[axis][b]);
            }
        }
    }

    const std::array<Bin, kBinCount>& Along(int axis) const { return _bins[axis]; }

  private:
    static constexpr float kLeastWidth = 1e-36f;

    Float4 _lower, _scale;
    std::array<Bin, kBinCount> _bins[3];
};

/// Quantizes the bounds of all children along one axis.
void QuantizeAxis(const std::array<Box3f, kBvhWidth>& boxes, int axis, BvhNode* node) {
    float lowest = boxes[0].lower[axis], highest = boxes[0].upper[axis];
    for (int i = 1; i < node->childCount; ++i) {
        lowest = std::min(lowest, boxes[i].lower[axis]);
        highest = std::max(highest, boxes[i].upper[axis]);
    }
    // The smallest power of two whose 255 steps reach across, also after rounding.
    int exponent =
        std::ilogb(std::max((highest - lowest) / 255, std::numeric_limits<float>::min()));
    float scale = std::ldexp(1.0f, exponent);
    while (lowest + 255 * scale < highest) {
        scale *= 2;
        ++exponent;
    }
    const float inverse = std::ldexp(1.0f, -exponent);
    node->origin[axis] = lowest;
    node->scale[axis] = scale;
    for (int i = 0; i < node->childCount; ++i) {
        const float lower = boxes[i].lower[axis], upper = boxes[i].upper[axis];
        int low = std::clamp(static_cast<int>((lower - lowest) * inverse), 0, 255);
        while (low > 0 && lowest + scale * static_cast<float>(low) > lower) {
            --low;
        }
        int high = std::clamp(static_cast<int>((upper - lowest) * inverse), 0, 255);
        while (high < 255 && lowest + scale * static_cast<float>(high) < upper) {
            ++high;
        }
        node->lower[axis][i] = static_cast<uint8_t>(low);
        node->upper[axis][i] = static_cast<uint8_t>(high);
    }
}

/// Writes the boxes of a node's children.
void Quantize(const std::array<Box3f, kBvhWidth>& boxes, BvhNode* node) {
    for (int axis = 0; axis < 3; ++axis) {
        QuantizeAxis(boxes, axis, node);
    }
}

class Builder {
  public:
    explicit Builder(std::vector<Primitive>* primitives) : _primitives(*primitives) {}

    Range Measure(size_t begin, size_t end) const {
        Range range{begin, end, {}, {}};
        for (size_t i = begin; i < end; ++i) {
            range.box.Extend(_primitives[i].Box());
            range.centerBox.Extend(_primitives[i].Center());
        }
        return range;
    }

    /// Appends the node of a range and all below it.
    void Build(const Range& root, int depth, std::vector<BvhNode>* nodes) {
        std::array<Range, kBvhWidth> ranges;
        const int count = _Partition(root, depth, &ranges);
        BvhNode node{};
        node.childCount = count;
        std::array<Box3f, kBvhWidth> boxes;
        for (int i = 0; i < count; ++i) {
            boxes[i] = ranges[i].box.ToBox3f();
            if (ranges[i].Size() == 1) {
                node.child[i] = kBvhLeaf | _primitives[ranges[i].begin].index;
            }
        }
        Quantize(boxes, &node);
        const size_t index = nodes->size();
        nodes->push_back(node);
        if (root.Size() >= kParallelThreshold) {
            _BuildChildrenInParallel(ranges, count, depth, index, nodes);
            return;
        }
        for (int i = 0; i < count; ++i) {
            if (ranges[i].Size() > 1) {
                (*nodes)[index].child[i] = static_cast<uint32_t>(nodes->size());
                Build(ranges[i], depth + 1, nodes);
            }
        }
    }

  private:
    /// Divides the range of a node: into ranges that fit into a node of leaves each, or as many as
    /// there are slots; then into leaves what is left of the slots. Returns how many they are.
    int _Partition(const Range& root, int depth, std::array<Range, kBvhWidth>* ranges) {
        (*ranges)[0] = root;
        int count = 1;
        // The widest first, until all are small.
        while (count < kBvhWidth) {
            const int widest = _WidestRange(*ranges, count);
            if (widest < 0) {
                break;
            }
            _SplitInto(ranges, &count, widest, depth);
        }
        // A small range needs a node of its own: spare those that the free slots can hold.
        for (int i = _SmallestRange(*ranges, count);
             i >= 0 && count + static_cast<int>((*ranges)[i].Size()) - 1 <= kBvhWidth;
             i = _SmallestRange(*ranges, count)) {
            _Scatter(ranges, &count, i);
        }
        return count;
    }

    /// Builds the nodes below a node apart, then appends them in the order of the slots.
    void _BuildChildrenInParallel(const std::array<Range, kBvhWidth>& ranges, int count, int depth,
                                  size_t index, std::vector<BvhNode>* nodes) {
        std::array<std::vector<BvhNode>, kBvhWidth> parts;
        tbb::parallel_for(0, count, [&](int i) {
            if (ranges[i].Size() > 1) {
                Build(ranges[i], depth + 1, &parts[i]);
            }
        });
        for (int i = 0; i < count; ++i) {
            if (parts[i].empty()) {
                continue;
            }
            const auto first = static_cast<uint32_t>(nodes->size());
            (*nodes)[index].child[i] = first;
            for (BvhNode& node : parts[i]) {
                for (int slot = 0; slot < node.childCount; ++slot) {
                    node.child[slot] += node.child[slot] & kBvhLeaf ? 0 : first;
                }
            }
            nodes->insert(nodes->end(), parts[i].begin(), parts[i].end());
            parts[i] = {};
        }
    }

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
        Range& left = (*ranges)[which];
        Range& right = (*ranges)[(*count)++];
        if (depth >= kMaxHeuristicDepth || !_Split(left, &left, &right)) {
            const size_t middle = left.begin + left.Size() / 2;
            right = Measure(middle, left.end);
            left = Measure(left.begin, middle);
        }
    }

    /// Replaces a range by ranges of one primitive each.
    void _Scatter(std::array<Range, kBvhWidth>* ranges, int* count, int which) {
        const Range range = (*ranges)[which];
        (*ranges)[which] = Measure(range.begin, range.begin + 1);
        for (size_t i = range.begin + 1; i < range.end; ++i) {
            (*ranges)[(*count)++] = Measure(i, i + 1);
        }
    }

    struct Plane {
        int axis = -1;
        int bin = 0;  ///< the first bin on the right
        float cost = std::numeric_limits<float>::infinity();
    };

    Bins _FillBins(const Range& range) const {
        const auto add = [&](const tbb::blocked_range<size_t>& part, Bins bins) {
            for (size_t i = part.begin(); i < part.end(); ++i) {
                bins.Add(_primitives[i]);
            }
            return bins;
        };
        const tbb::blocked_range<size_t> all(range.begin, range.end, kParallelThreshold);
        if (range.Size() < kParallelBinThreshold) {
            return add(all, Bins(range));
        }
        return tbb::parallel_reduce(all, Bins(range), add, [](Bins a, const Bins& b) {
            a.Add(b);
            return a;
        });
    }

    /// The cheapest plane between bins of one axis. Beside an empty bin, two planes are the same.
    static void _TryAxis(const Range& range, const Bins& allBins, int axis, Plane* best) {
        const std::array<Bin, kBinCount>& bins = allBins.Along(axis);
        std::array<float, kBinCount> leftCost;
        leftCost[0] = 0;
        Bin left;
        for (int b = 0; b + 1 < kBinCount; ++b) {
            leftCost[b + 1] = leftCost[b];
            if (bins[b].count > 0) {
                left.Extend(bins[b]);
                leftCost[b + 1] = left.Cost();
            }
        }
        Bin right;
        for (int b = kBinCount - 1; b > 0; --b) {
            if (bins[b].count == 0) {
                continue;
            }
            right.Extend(bins[b]);
            const float cost = leftCost[b] + right.Cost();
            if (right.count < range.Size() && cost < best->cost) {
                *best = {axis, b, cost};
            }
        }
    }

    /// Reorders a range's primitives and measures its parts. Returns false if no plane divides
    /// them.
    /// @param left  may be the range itself
    bool _Split(const Range& range, Range* left, Range* right) {
        const Bins bins = _FillBins(range);
        Plane plane;
        for (int axis = 0; axis < 3; ++axis) {
            _TryAxis(range, bins, axis, &plane);
        }
        if (plane.axis < 0) {
            return false;  // all centres coincide
        }
        Range parts[2]{};
        const auto begin = _primitives.begin() + range.begin, end = _primitives.begin() + range.end;
        const auto middle = std::partition(begin, end, [&](const Primitive& p) {
            const Float4 center = p.Center();
            const bool isLeft = bins.Find(center)[plane.axis] < plane.bin;
            parts[isLeft ? 0 : 1].centerBox.Extend(center);
            return isLeft;
        });
        for (int b = 0; b < kBinCount; ++b) {
            parts[b < plane.bin ? 0 : 1].box.Extend(bins.Along(plane.axis)[b].box);
        }
        parts[0].begin = range.begin;
        parts[0].end = parts[1].begin = middle - _primitives.begin();
        parts[1].end = range.end;
        *left = parts[0];
        *right = parts[1];
        return true;
    }

    std::vector<Primitive>& _primitives;
};

/// Brings the boxes of a tree up to date, children first.
class Refitter {
  public:
    Refitter(const std::vector<Box3f>& primitives, std::vector<BvhNode>* nodes)
        : _primitives(primitives), _nodes(*nodes), _boxes(nodes->size()) {}

    /// Returns the root's box.
    Box3f Refit() {
        _RefitTree(0, _nodes.size());
        return _boxes.front();
    }

  private:
    /// @param end  the first node behind those below the node
    void _RefitTree(size_t index, size_t end) {
        if (end - index < kParallelRefitThreshold) {
            for (size_t i = end; i-- > index;) {
                _RefitNode(i);
            }
            return;
        }
        const BvhNode& node = _nodes[index];
        std::array<size_t, kBvhWidth + 1> first;
        int count = 0;
        for (int slot = 0; slot < node.childCount; ++slot) {
            if (!(node.child[slot] & kBvhLeaf)) {
                first[count++] = node.child[slot];
            }
        }
        first[count] = end;
        tbb::parallel_for(0, count, [&](int i) { _RefitTree(first[i], first[i + 1]); });
        _RefitNode(index);
    }

    void _RefitNode(size_t index) {
        BvhNode& node = _nodes[index];
        std::array<Box3f, kBvhWidth> boxes;
        Box3f all;
        for (int slot = 0; slot < node.childCount; ++slot) {
            const uint32_t child = node.child[slot];
            boxes[slot] = child & kBvhLeaf ? _primitives[child & ~kBvhLeaf] : _boxes[child];
            all.Extend(boxes[slot]);
        }
        Quantize(boxes, &node);
        _boxes[index] = all;
    }

    const std::vector<Box3f>& _primitives;
    std::vector<BvhNode>& _nodes;
    std::vector<Box3f> _boxes;
};

float HalfArea(const BvhNode& node) {
    Box3f box;
    for (int axis = 0; axis < 3; ++axis) {
        const uint8_t highest =
            *std::max_element(node.upper[axis], node.upper[axis] + node.childCount);
        box.lower[axis] = node.origin[axis];
        box.upper[axis] = node.origin[axis] + node.scale[axis] * static_cast<float>(highest);
    }
    return box.HalfArea();
}

/// How many nodes a random line through the root's box meets: what the surface area heuristic
/// keeps small.
double TraversalCost(const std::vector<BvhNode>& nodes) {
    double area = 0;
    for (const BvhNode& node : nodes) {
        area += HalfArea(node);
    }
    return area > 0 ? area / HalfArea(nodes.front()) : 0;
}

size_t CountFull(const std::vector<Box3f>& boxes) {
    return static_cast<size_t>(
        std::count_if(boxes.begin(), boxes.end(), [](const Box3f& box) { return !box.IsEmpty(); }));
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

Bvh::Bvh(const std::vector<Box3f>& boxes) : _primitiveCount(CountFull(boxes)) {
    if (_primitiveCount == 0) {
        return;
    }
    std::vector<Primitive> primitives;
    primitives.reserve(_primitiveCount);
    for (size_t i = 0; i < boxes.size(); ++i) {
        if (!boxes[i].IsEmpty()) {
            primitives.push_back({boxes[i].lower, static_cast<uint32_t>(i), boxes[i].upper});
        }
    }
    Builder builder(&primitives);
    const Range root = builder.Measure(0, primitives.size());
    builder.Build(root, 0, &_nodes);
    _nodes.shrink_to_fit();
    _bounds = root.box.ToBox3f();
    _builtCost = TraversalCost(_nodes);
}

void Bvh::Move(const std::vector<Box3f>& boxes) {
    const bool hasAll = _primitiveCount == boxes.size() && CountFull(boxes) == boxes.size();
    if (_nodes.empty() || !hasAll) {
        *this = Bvh(boxes);
        return;
    }
    _bounds = Refitter(boxes, &_nodes).Refit();
    if (!(TraversalCost(_nodes) <= kWorstRefitCost * _builtCost)) {
        *this = Bvh(boxes);
    }
}

}  // namespace cc
