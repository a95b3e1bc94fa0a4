#include "core/bvh/bvh.h"

#include <cstddef>
#include <cstring>
#include <random>
#include <set>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

namespace cc::test {
namespace {

std::vector<Box3f> RandomBoxes(int count) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> position(-10, 10), size(0, 0.5f);
    std::vector<Box3f> boxes(count);
    for (Box3f& box : boxes) {
        box.Extend(Vec3f{position(random), position(random), position(random)});
        box.Extend(box.lower + Vec3f{size(random), size(random), size(random)});
    }
    return boxes;
}

bool Holds(const Box3f& outer, const Box3f& inner) {
    Box3f both = outer;
    both.Extend(inner);
    return both.lower == outer.lower && both.upper == outer.upper;
}

Box3f Common(const Box3f& a, const Box3f& b) {
    Box3f box;
    for (int axis = 0; axis < 3; ++axis) {
        box.lower[axis] = std::max(a.lower[axis], b.lower[axis]);
        box.upper[axis] = std::min(a.upper[axis], b.upper[axis]);
    }
    return box;
}

/// Checks that all boxes above a primitive hold it, and collects the primitives.
/// @param bounds  what the boxes above the node have in common
void Visit(const Bvh& bvh, uint32_t index, const Box3f& bounds, const std::vector<Box3f>& boxes,
           int depth, std::multiset<uint32_t>* found) {
    ASSERT_LE(depth, kBvhMaxDepth);
    const BvhNode& node = bvh.Nodes()[index];
    for (int slot = 0; slot < node.childCount; ++slot) {
        const Box3f box = Common(bounds, node.ChildBox(slot));
        if (node.child[slot] & kBvhLeaf) {
            const uint32_t primitive = node.child[slot] & ~kBvhLeaf;
            EXPECT_TRUE(Holds(box, boxes[primitive]));
            found->insert(primitive);
        } else {
            Visit(bvh, node.child[slot], box, boxes, depth + 1, found);
        }
    }
}

void ExpectWhole(const Bvh& bvh, const std::vector<Box3f>& boxes) {
    std::multiset<uint32_t> found;
    Visit(bvh, 0, bvh.Bounds(), boxes, 1, &found);
    EXPECT_EQ(found.size(), boxes.size());
    EXPECT_EQ(std::set<uint32_t>(found.begin(), found.end()).size(), boxes.size());
}

void ExpectWhole(const std::vector<Box3f>& boxes) { ExpectWhole(Bvh(boxes), boxes); }

bool IsSame(const Bvh& a, const Bvh& b) {
    bool same = a.Nodes().size() == b.Nodes().size() && a.Bounds().lower == b.Bounds().lower &&
                a.Bounds().upper == b.Bounds().upper;
    for (size_t i = 0; same && i < a.Nodes().size(); ++i) {
        same = std::memcmp(&a.Nodes()[i], &b.Nodes()[i],
                           offsetof(BvhNode, childCount) + sizeof(int)) == 0;
    }
    return same;
}

bool HaveSameChildren(const Bvh& a, const Bvh& b) {
    bool same = a.Nodes().size() == b.Nodes().size();
    for (size_t i = 0; same && i < a.Nodes().size(); ++i) {
        same = std::memcmp(a.Nodes()[i].child, b.Nodes()[i].child, sizeof(BvhNode::child)) == 0;
    }
    return same;
}

/// Moves each box by up to a distance along each axis.
std::vector<Box3f> Shaken(std::vector<Box3f> boxes, float distance) {
    std::mt19937 random(2);
    std::uniform_real_distribution<float> move(-distance, distance);
    for (Box3f& box : boxes) {
        const Vec3f by{move(random), move(random), move(random)};
        box.lower += by;
        box.upper += by;
    }
    return boxes;
}

TEST(Bvh, HoldsEveryPrimitiveOnce) {
    for (int count : {1, 2, 8, 9, 100, 20000}) {
        ExpectWhole(RandomBoxes(count));
    }
}

TEST(Bvh, CopesWithBoxesThatCoincide) {
    Box3f box;
    box.Extend(Vec3f{1, 2, 3});
    ExpectWhole(std::vector<Box3f>(5000, box));
}

TEST(Bvh, StaysShallowWhenPositionsGrowExponentially) {
    std::vector<Box3f> boxes(240);
    float position = 1e-36f;
    for (Box3f& box : boxes) {
        box.Extend(Vec3f{position, 0, 0});
        position *= 2;
    }
    ExpectWhole(boxes);
}

TEST(Bvh, LeavesEmptyBoxesOut) {
    std::vector<Box3f> boxes = RandomBoxes(3);
    boxes[1] = Box3f();
    const Bvh bvh(boxes);
    ASSERT_EQ(bvh.Nodes().size(), 1u);
    EXPECT_EQ(bvh.Nodes()[0].childCount, 2);
    EXPECT_TRUE(Bvh({Box3f()}).IsEmpty());
}

TEST(Bvh, KeepsItsShapeWhenPrimitivesMoveALittle) {
    for (int count : {1, 16, 17, 2000, 20000}) {
        const std::vector<Box3f> boxes = RandomBoxes(count);
        const Bvh built(boxes);
        Bvh moved = built;
        for (float distance : {0.05f, 0.02f, 0.1f}) {
            const std::vector<Box3f> shaken = Shaken(boxes, distance);
            moved.Move(shaken);
            EXPECT_TRUE(HaveSameChildren(moved, built)) << count;
            ExpectWhole(moved, shaken);
        }
        moved.Move(boxes);
        EXPECT_TRUE(IsSame(moved, built)) << count;
    }
}

TEST(Bvh, IsBuiltAnewWhenPrimitivesMoveFar) {
    const std::vector<Box3f> boxes = RandomBoxes(2000), shaken = Shaken(boxes, 20);
    const Bvh built(boxes);
    Bvh moved = built;
    moved.Move(shaken);
    EXPECT_FALSE(HaveSameChildren(moved, built));
    EXPECT_TRUE(IsSame(moved, Bvh(shaken)));
}

TEST(Bvh, IsBuiltAnewWhenBoxesBecomeEmptyOrFull) {
    const std::vector<Box3f> full = RandomBoxes(40);
    std::vector<Box3f> first = full, second = full;
    first[7] = second[8] = Box3f();
    Bvh bvh(full);
    for (const auto& boxes : {first, second, full, std::vector<Box3f>(40), full}) {
        bvh.Move(boxes);
        EXPECT_TRUE(IsSame(bvh, Bvh(boxes)));
    }
}

TEST(Bvh, DoesNotDependOnTheNumberOfThreads) {
    const std::vector<Box3f> boxes = RandomBoxes(150000), shaken = Shaken(boxes, 0.05f);
    std::vector<Bvh> built, moved;
    for (size_t threads : {1, 2, 4}) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        built.emplace_back(boxes);
        moved.push_back(built.back());
        moved.back().Move(shaken);
        EXPECT_TRUE(IsSame(built.back(), built.front()));
        EXPECT_TRUE(IsSame(moved.back(), moved.front()));
    }
    EXPECT_FALSE(IsSame(built.front(), moved.front()));
}

}  // namespace
}  // namespace cc::test
