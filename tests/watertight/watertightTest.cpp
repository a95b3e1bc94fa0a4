#include <gtest/gtest.h>

#include "tests/watertight/closedCages.h"
#include "tests/watertight/watertight.h"

namespace cc::test {
namespace {

#if defined(__SANITIZE_ADDRESS__)
constexpr uint64_t kParts = 20;
#else
constexpr uint64_t kParts = 1;
#endif

void ExpectNoEscapes(WatertightOptions options) {
    options.rays /= kParts;  // sanitizers look at arithmetic and memory: some rays will do
    uint64_t rays = 0;
    for (const WatertightCount& count : CountEscapes(ClosedCages(), options)) {
        EXPECT_EQ(count.escapes, 0u)
            << "level " << count.level << ", " << count.placement << ", " << count.firstEscape;
        EXPECT_GT(count.rays, 0u) << "level " << count.level << ", " << count.placement;
        rays += count.rays;
    }
    EXPECT_GE(rays, options.rays * 9 / 10);
}

TEST(Watertight, ThereAreManyClosedCages) { EXPECT_GE(ClosedCages().size(), 40u); }

TEST(Watertight, NothingEscapes) {
    WatertightOptions options;
    options.rays = 1'100'000;
    options.levels = {0, 1, 2, 3, 4};
    ExpectNoEscapes(options);
}

TEST(Watertight, NothingEscapesWherePatchesAreSplit) {
    WatertightOptions options;
    options.rays = 50'000;
    options.levels = {5, 6};
    ExpectNoEscapes(options);
}

}  // namespace
}  // namespace cc::test
