#include <algorithm>
#include <array>
#include <map>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <hwy/highway.h>

#include "core/trace/limitGrid-inl.h"
#include "core/trace/surface.h"
#include "tests/unit/subdiv/testCages.h"

namespace cc::test {
namespace {

namespace simd = HWY_NAMESPACE;

constexpr int kSplits = 4, kSide = 1 << kSplits;

/// Points along a border of a patch, from the vertex of the lower index on.
using Border = std::vector<std::array<float, 3>>;
using Edge = std::pair<uint32_t, uint32_t>;

LimitGrid GridOf(const Surface& surface, uint32_t patch) {
    BezierRows bezier;
    simd::GatherRegular(surface.Patches(), patch, surface.PatchPoints().data(), &bezier);
    LimitGrid grid;
    grid.side = kSide;
    for (int row = 0; row <= kSide; ++row) {
        simd::EvaluateRow(bezier, kSplits, row, &grid);
    }
    return grid;
}

/// Adds the four borders of a regular patch.
void AddBorders(const Surface& surface, uint32_t patch,
                std::map<Edge, std::vector<Border>>* borders) {
    // The quad's own corners, in the order of the square's.
    constexpr int kInner[4] = {5, 6, 10, 9};
    constexpr int kRow[4] = {0, 0, 1, 1}, kColumn[4] = {0, 1, 1, 0};
    const LimitGrid grid = GridOf(surface, patch);
    for (int e = 0; e < 4; ++e) {
        const int f = (e + 1) % 4;
        const uint32_t a = surface.Patches().Indices(patch)[kInner[e]];
        const uint32_t b = surface.Patches().Indices(patch)[kInner[f]];
        Border border;
        for (int i = 0; i <= kSide; ++i) {
            const Vec3f p = grid.At(kRow[e] * (kSide - i) + kRow[f] * i,
                                    kColumn[e] * (kSide - i) + kColumn[f] * i);
            border.push_back({p.x, p.y, p.z});
        }
        if (b < a) {
            std::reverse(border.begin(), border.end());
        }
        (*borders)[{std::min(a, b), std::max(a, b)}].push_back(border);
    }
}

/// A cage at a size and a place that leave no coordinate a round number.
Cage Odd(Cage cage) {
    for (Vec3f& p : cage.points) {
        p = 1.234567e-4f * p + Vec3f{3.21e-4f, -1.7e-5f, 0};
    }
    return cage;
}

TEST(LimitGrid, RegularPatchesHaveTheSameBordersToTheBit) {
    int shared = 0, creased = 0;
    for (Cage cage : Catalogue()) {
        ValidateControlMesh(&cage.mesh, cage.points.size());
        const Cage odd = Odd(cage);
        const Surface surface(odd.mesh, odd.points);
        std::map<Edge, std::vector<Border>> borders;
        for (uint32_t patch = 0; patch < surface.Patches().Count(); ++patch) {
            if (surface.Patches().At(patch).kind == PatchKind::Regular) {
                AddBorders(surface, patch, &borders);
                creased += surface.Patches().At(patch).extrapolatedSides != 0;
            }
        }
        for (const auto& [edge, sides] : borders) {
            for (size_t i = 1; i < sides.size(); ++i) {
                ++shared;
                EXPECT_EQ(sides[i], sides[0])
                    << cage.name << " " << edge.first << " " << edge.second;
            }
        }
    }
    EXPECT_GT(shared, 1000);
    EXPECT_GT(creased, 400);
}

}  // namespace
}  // namespace cc::test
