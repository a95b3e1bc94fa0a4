#include "core/render/tileOrder.h"

#include <gtest/gtest.h>

namespace cc {
namespace {

TEST(TileOrder, CoversEveryPixelOnce) {
    for (const auto& [width, height] : {std::pair{1, 1}, {8, 8}, {9, 7}, {200, 131}, {64, 3}}) {
        std::vector<int> visits(static_cast<size_t>(width) * height);
        for (const Tile& tile : TilesFromTheMiddle(width, height)) {
            EXPECT_GE(tile.width * tile.height, 1);
            EXPECT_LE(tile.width, kTileSize);
            EXPECT_LE(tile.height, kTileSize);
            for (int y = tile.y; y < tile.y + tile.height; ++y) {
                for (int x = tile.x; x < tile.x + tile.width; ++x) {
                    ASSERT_TRUE(x >= 0 && x < width && y >= 0 && y < height);
                    ++visits[y * width + x];
                }
            }
        }
        EXPECT_EQ(visits, std::vector<int>(visits.size(), 1)) << width << " x " << height;
    }
}

TEST(TileOrder, BeginsInTheMiddle) {
    const std::vector<Tile> tiles = TilesFromTheMiddle(640, 320);
    EXPECT_NEAR(tiles.front().x, 320, 64);
    EXPECT_NEAR(tiles.front().y, 160, 64);
    const Tile& last = tiles.back();
    EXPECT_TRUE(last.x < 64 || last.x >= 576) << last.x;
}

TEST(TileOrder, AnEmptyPictureHasNoTiles) { EXPECT_TRUE(TilesFromTheMiddle(0, 0).empty()); }

}  // namespace
}  // namespace cc
