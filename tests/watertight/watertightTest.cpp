#include <gtest/gtest.h>

#include "tests/repeats.h"
#include "tests/watertight/closedCages.h"
#include "tests/watertight/watertight.h"

namespace cc::test {
namespace {

/// All closed cages, or some of all kinds where tests are to be short.
std::vector<Cage> SomeClosedCages() {
    const std::vector<Cage> all = ClosedCages();
    const size_t count = static_cast<size_t>(Repeats(static_cast<int>(all.size())));
    std::vector<Cage> some;
    for (size_t i = 0; i < count; ++i) {
        some.push_back(all[i * all.size() / count]);
    }
    return some;
}

void ExpectNoEscapes(const WatertightOptions& options) {
    uint64_t rays = 0;
    for (const WatertightCount& count : CountEscapes(SomeClosedCages(), options)) {
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
    options.rays = Repeats(1'100'000);
    options.levels = {0, 1, 2, 3, 4};
    ExpectNoEscapes(options);
}

TEST(Watertight, NothingEscapesWherePatchesAreSplit) {
    WatertightOptions options;
    options.rays = Repeats(50'000);
    options.levels = {5, 6};
    ExpectNoEscapes(options);
}

TEST(Watertight, NothingEscapesBetweenLevels) {
    WatertightOptions options;
    options.rays = Repeats(500'000);
    options.levels = {2, 4, 5, 7};
    options.isAdaptive = true;
    ExpectNoEscapes(options);
}

}  // namespace
}  // namespace cc::test
