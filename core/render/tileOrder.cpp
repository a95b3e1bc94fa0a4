#include "core/render/tileOrder.h"

#include <algorithm>
#include <cstdint>

namespace cc {
namespace {

/// Side of a block of tiles in pixels.
constexpr int kBlockSize = 8 * kTileSize;

/// Square of twice the distance between the middles of a tile and of the picture.
int64_t DistanceToMiddle(const Tile& tile, int width, int height) {
    const int64_t dx = 2 * int64_t(tile.x) + tile.width - width;
    const int64_t dy = 2 * int64_t(tile.y) + tile.height - height;
    return dx * dx + dy * dy;
}

/// Cuts a rectangle into squares of a size, in rows from its lower left corner.
std::vector<Tile> Cut(const Tile& area, int size) {
    std::vector<Tile> pieces;
    for (int y = 0; y < area.height; y += size) {
        for (int x = 0; x < area.width; x += size) {
            pieces.push_back({area.x + x, area.y + y, std::min(size, area.width - x),
                              std::min(size, area.height - y)});
        }
    }
    return pieces;
}

}  // namespace

std::vector<Tile> TilesFromTheMiddle(int width, int height) {
    std::vector<Tile> blocks = Cut({0, 0, width, height}, kBlockSize);
    std::stable_sort(blocks.begin(), blocks.end(), [&](const Tile& a, const Tile& b) {
        return DistanceToMiddle(a, width, height) < DistanceToMiddle(b, width, height);
    });
    std::vector<Tile> tiles;
    for (const Tile& block : blocks) {
        for (const Tile& tile : Cut(block, kTileSize)) {
            tiles.push_back(tile);
        }
    }
    return tiles;
}

}  // namespace cc
