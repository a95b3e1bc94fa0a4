#include "core/trace/gridStitch.h"

#include <cmath>
#include <random>
#include <set>
#include <utility>

#include <gtest/gtest.h>

namespace cc::test {
namespace {

/// A grid whose points are their own places, but for a bump.
LimitGrid Bumpy(int side) {
    LimitGrid grid;
    grid.side = side;
    for (int row = 0; row <= side; ++row) {
        for (int column = 0; column <= side; ++column) {
            grid.points[0][row][column] = static_cast<float>(column);
            grid.points[1][row][column] = static_cast<float>(row);
            grid.points[2][row][column] = static_cast<float>((3 * column + 5 * row) % 7);
        }
    }
    return grid;
}

TEST(GridStitch, IsNotNeededWhereLevelsAreEqual) {
    EXPECT_FALSE(GridStitch({3, {3, 3, 3, 3}}, {0, 0, 1}, 8, false).IsNeeded());
    EXPECT_FALSE(GridStitch().IsNeeded());
    EXPECT_TRUE(GridStitch({3, {3, 3, 2, 3}}, {0, 0, 1}, 8, false).IsNeeded());
}

/// The edges of levels 3, 2, 1 and 0 keep 9, 5, 3 and 2 points.
TEST(GridStitch, BordersKeepThePointsOfTheirLevel) {
    const GridStitch stitch({3, {3, 2, 1, 0}}, {0, 0, 1}, 8, false);
    const LimitGrid before = Bumpy(8);
    LimitGrid grid = before;
    EXPECT_GT(stitch.Apply(&grid), 0);
    const auto expectFrom = [&](int row, int column, int step, bool isRow) {
        const int i = isRow ? column : row;
        const Vec3f p = grid.At(row, column);
        const int kept = static_cast<int>(std::lround(isRow ? p.x : p.y));
        EXPECT_EQ(kept % step, 0) << row << ", " << column;
        EXPECT_LE(std::abs(kept - i), step / 2);
        EXPECT_EQ(p, isRow ? before.At(row, kept) : before.At(kept, column));
    };
    for (int i = 0; i <= 8; ++i) {
        expectFrom(0, i, 1, true);   // v = 0
        expectFrom(i, 8, 2, false);  // u = 1
        expectFrom(8, i, 4, true);   // v = 1
        expectFrom(i, 0, 8, false);  // u = 0
    }
    for (int row = 1; row < 8; ++row) {
        for (int column = 1; column < 8; ++column) {
            EXPECT_EQ(grid.At(row, column), before.At(row, column));
        }
    }
}

/// A coarser inside keeps the points of its level, and between them and a finer edge are fans.
TEST(GridStitch, InsideKeepsThePointsOfItsLevel) {
    const GridStitch stitch({2, {3, 2, 1, 2}}, {0, 0, 1}, 8, false);
    ASSERT_TRUE(stitch.IsNeeded());
    const LimitGrid before = Bumpy(8);
    LimitGrid grid = before;
    stitch.Apply(&grid);
    std::set<std::pair<float, float>> kept;
    for (int row = 1; row < 8; ++row) {
        for (int column = 1; column < 8; ++column) {
            const Vec3f p = grid.At(row, column);
            kept.insert({p.x, p.y});
            EXPECT_EQ(p, before.At(static_cast<int>(p.y), static_cast<int>(p.x)));
        }
    }
    EXPECT_EQ(kept.size(), 9u);
    EXPECT_EQ(*kept.begin(), std::make_pair(2.0f, 2.0f));
    EXPECT_EQ(*kept.rbegin(), std::make_pair(6.0f, 6.0f));
    for (int i = 0; i <= 8; ++i) {
        EXPECT_EQ(grid.At(0, i), before.At(0, i));  // v = 0 is finer
        EXPECT_EQ(static_cast<int>(grid.At(i, 8).y) % 2, 0);
        EXPECT_EQ(static_cast<int>(grid.At(8, i).x) % 4, 0);
    }
    EXPECT_TRUE(stitch.IsInFan(3, 1));
    EXPECT_FALSE(stitch.IsInFan(3, 2));
    EXPECT_TRUE(stitch.IsInFan(3, 6));
    EXPECT_FALSE(stitch.IsInFan(0, 3));
}

/// Moved quads cover the square once, whatever the levels.
TEST(GridStitch, MovedQuadsCoverTheSquare) {
    std::mt19937 random(5);
    for (int n = 0; n < 500; ++n) {
        const int side = 1 << (random() % 5);
        PatchLevels levels;
        levels.interior = static_cast<uint8_t>(random() % 5);
        for (uint8_t& edge : levels.edges) {
            edge = static_cast<uint8_t>(random() % 5);
        }
        const float size = random() % 2 == 0 ? 1 : 0.5f;
        const Square square{size == 1 ? 0 : 0.5f * static_cast<float>(random() % 2),
                            size == 1 ? 0 : 0.5f * static_cast<float>(random() % 2), size};
        LimitGrid grid = Bumpy(side);
        GridStitch(levels, square, side, random() % 2 == 0).Apply(&grid);
        double area = 0;
        for (int row = 0; row < side; ++row) {
            for (int column = 0; column < side; ++column) {
                const Vec3f a = grid.At(row, column), b = grid.At(row, column + 1),
                            c = grid.At(row + 1, column + 1), d = grid.At(row + 1, column);
                for (const float part : {Cross(b - a, c - a).z, Cross(c - a, d - a).z}) {
                    EXPECT_GE(part, 0);
                    area += 0.5 * part;
                }
            }
        }
        EXPECT_EQ(area, side * side) << n;
    }
}

TEST(GridStitch, RowsAndColumnsChangePlacesInTransposedGrids) {
    const PatchLevels levels{3, {1, 3, 3, 3}};
    LimitGrid rows = Bumpy(8), columns = Bumpy(8);
    GridStitch(levels, {0, 0, 1}, 8, false).Apply(&rows);
    GridStitch(levels, {0, 0, 1}, 8, true).Apply(&columns);
    EXPECT_EQ(rows.At(0, 3).x, 4);
    EXPECT_EQ(columns.At(0, 3).x, 3);
    EXPECT_EQ(columns.At(3, 0).y, 4);
}

TEST(GridStitch, PartsOfAPatchAreStitchedAtItsEdgesAlone) {
    const PatchLevels levels{6, {4, 4, 4, 4}};
    LimitGrid inner = Bumpy(8);
    EXPECT_FALSE(GridStitch(levels, {0.25f, 0.25f, 0.125f}, 8, false).IsNeeded());
    const GridStitch corner(levels, {0.875f, 0.875f, 0.125f}, 8, false);
    corner.Apply(&inner);
    EXPECT_EQ(inner.At(0, 3).x, 3);
    EXPECT_EQ(inner.At(8, 3).x, 4);
    EXPECT_EQ(inner.At(3, 8).y, 4);
}

/// The distance of what was moved from where straight borders are.
TEST(GridStitch, SaysHowFarBordersHaveMoved) {
    LimitGrid flat = Bumpy(8);
    for (auto& row : flat.points[2]) {
        std::fill(std::begin(row), std::end(row), 0.0f);
    }
    const GridStitch stitch({3, {1, 1, 1, 1}}, {0, 0, 1}, 8, false);
    LimitGrid grid = flat;
    EXPECT_EQ(stitch.Apply(&grid), 0);
    grid = flat;
    grid.points[2][0][2] = 5;
    EXPECT_EQ(stitch.Apply(&grid), 5);
    // Of points inside, how far they are from the quads that stay, and how far those are twisted.
    const GridStitch inner({1, {3, 3, 3, 3}}, {0, 0, 1}, 8, false);
    grid = flat;
    grid.points[2][3][2] = 5;
    EXPECT_EQ(inner.Apply(&grid), 5);
    grid = flat;
    grid.points[2][4][4] = 8;
    EXPECT_GE(inner.Apply(&grid), 8);
}

/// What a quad shows after points have moved lies in the range that it was widened to.
TEST(GridStitch, RangesHoldTheFans) {
    const GridStitch stitch({4, {2, 4, 4, 1}}, {0, 0, 1}, 16, false);
    int firstColumn = 6, lastColumn = 6, firstRow = 0, lastRow = 2;
    stitch.Widen(&firstColumn, &lastColumn, &firstRow, &lastRow);
    EXPECT_EQ(firstColumn, 4);
    EXPECT_EQ(lastColumn, 7);
    EXPECT_EQ(firstRow, 0);
    EXPECT_EQ(lastRow, 2);
    firstColumn = lastColumn = 0;
    firstRow = lastRow = 9;
    stitch.Widen(&firstColumn, &lastColumn, &firstRow, &lastRow);
    EXPECT_EQ(lastColumn, 0);
    EXPECT_EQ(firstRow, 8);
    EXPECT_EQ(lastRow, 15);
    firstColumn = lastColumn = firstRow = lastRow = 6;
    stitch.Widen(&firstColumn, &lastColumn, &firstRow, &lastRow);
    EXPECT_EQ(firstColumn, 6);
    EXPECT_EQ(lastRow, 6);
}

/// Hits in fans are where the moved points say.
TEST(GridStitch, ParametersAreThoseOfTheMovedPoints) {
    const GridStitch stitch({3, {1, 3, 2, 0}}, {0, 0, 1}, 8, false);
    LimitGrid grid = Bumpy(8);
    stitch.Apply(&grid);
    std::mt19937 random(3);
    std::uniform_real_distribution<float> unit(0, 1);
    for (int n = 0; n < 2000; ++n) {
        const int column = static_cast<int>(random() % 8), row = static_cast<int>(random() % 8);
        const float across = unit(random), along = unit(random);
        const bool isUpper = along > across;
        const float most = std::max(across, along), least = std::min(across, along);
        const Vec3f expected =
            (1 - most) * grid.At(row, column) +
            (most - least) * (isUpper ? grid.At(row + 1, column) : grid.At(row, column + 1)) +
            least * grid.At(row + 1, column + 1);
        float u = static_cast<float>(column) + across, v = static_cast<float>(row) + along;
        stitch.ToUnmoved(2 * (8 * row + column) + static_cast<int>(isUpper), &u, &v);
        // Points of this grid are their own places.
        EXPECT_NEAR(u, expected.x, 1e-5f);
        EXPECT_NEAR(v, expected.y, 1e-5f);
    }
}

}  // namespace
}  // namespace cc::test
