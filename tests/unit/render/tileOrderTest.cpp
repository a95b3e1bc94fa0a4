#include "core/render/tileOrder.h"

#include <set>
#include <utility>

#include <gtest/gtest.h>

namespace cc {
namespace {

TEST(TileOrder, CoversEveryPixelOnce) {
    for (const int stride : {1, 2, 4}) {
        for (const auto& [width, height] : {std::pair{1, 1}, {8, 8}, {9, 7}, {200, 131}, {64, 3}}) {
            std::vector<int> visits(static_cast<size_t>(width) * height);
            for (const std::vector<Tile>& part : InterleavedTiles(width, height, stride)) {
                for (const Tile& tile : part) {
                    EXPECT_GE(tile.Count(), 1);
                    EXPECT_LE(tile.width, kTileSize);
                    EXPECT_LE(tile.height, kTileSize);
                    for (int ray = 0; ray < tile.Count(); ++ray) {
                        const int x = tile.X(ray), y = tile.Y(ray);
                        ASSERT_TRUE(x >= 0 && x < width && y >= 0 && y < height);
                        ++visits[y * width + x];
                    }
                }
            }
            EXPECT_EQ(visits, std::vector<int>(visits.size(), 1)) << width << " x " << height;
        }
    }
}

TEST(TileOrder, PartsHaveOnePixelOfEverySquare) {
    for (const int stride : {2, 4}) {
        for (const std::vector<Tile>& part : InterleavedTiles(64, 32, stride)) {
            std::set<std::pair<int, int>> squares;
            int pixels = 0;
            for (const Tile& tile : part) {
                for (int ray = 0; ray < tile.Count(); ++ray) {
                    squares.insert({tile.X(ray) / stride, tile.Y(ray) / stride});
                    ++pixels;
                }
            }
            EXPECT_EQ(pixels, 64 * 32 / (stride * stride));
            EXPECT_EQ(int(squares.size()), pixels);
        }
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
