#include "core/bvh/bvh.h"

#include <random>
#include <set>

#include <gtest/gtest.h>

#include "core/bvh/lookAheadBounds.h"
#include "core/subdiv/limitPoint.h"
#include "core/subdiv/patchBuilder.h"
#include "tests/unit/subdiv/testCages.h"

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

void ExpectWhole(const std::vector<Box3f>& boxes) {
    const Bvh bvh(boxes);
    std::multiset<uint32_t> found;
    Visit(bvh, 0, bvh.Bounds(), boxes, 1, &found);
    EXPECT_EQ(found.size(), boxes.size());
    EXPECT_EQ(std::set<uint32_t>(found.begin(), found.end()).size(), boxes.size());
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

TEST(LookAheadBounds, HoldTheSurfaceTightly) {
    for (Cage cage : Catalogue()) {
        ValidateControlMesh(&cage.mesh, cage.points.size());
        std::string error;
        const PatchTable patches = BuildPatchTable(cage.mesh, cage.points.size(), &error);
        const std::vector<Vec3f> points = patches.PatchPoints(cage.points);
        for (uint32_t patch = 0; patch < patches.Count(); ++patch) {
            const Box3f bounds = LookAheadBounds(patches, patch, points.data());
            Box3f exact, ring;
            for (int i = 0; i < 289; ++i) {
                if (patches.IsTriangle(patch) && i % 17 + i / 17 > 16) {
                    continue;
                }
                exact.Extend(EvaluateLimitValue(patches, patch, points.data(), (i % 17) / 16.0f,
                                                (i / 17) / 16.0f));
            }
            EXPECT_TRUE(Holds(bounds, exact)) << cage.name << " patch " << patch;
            const PatchKind kind = patches.At(patch).kind;
            if (kind == PatchKind::Regular || kind == PatchKind::RegularTriangle) {
                for (int i = 0; i < patches.IndexCount(patch); ++i) {
                    ring.Extend(points[patches.Indices(patch)[i]]);
                }
                EXPECT_LT(bounds.Diagonal(), 0.75f * ring.Diagonal()) << cage.name;
            }
        }
    }
}

}  // namespace
}  // namespace cc::test
