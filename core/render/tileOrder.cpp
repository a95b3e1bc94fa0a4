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

std::vector<Tile> BlocksFromTheMiddle(int width, int height, int size) {
    std::vector<Tile> blocks = Cut({0, 0, width, height}, size);
    std::stable_sort(blocks.begin(), blocks.end(), [&](const Tile& a, const Tile& b) {
        return DistanceToMiddle(a, width, height) < DistanceToMiddle(b, width, height);
    });
    return blocks;
}

/// Which pixel of a square comes at a place of the order of ordered dithering (Bayer 1973): with
/// each two bits of the place the distance halves.
void PixelOfPart(int part, int stride, int* x, int* y) {
    *x = *y = 0;
    for (int step = stride / 2; step > 0; step /= 2, part /= 4) {
        // (0,0), (1,1), (1,0), (0,1)
        *x += (part & 3) == 1 || (part & 3) == 2 ? step : 0;
        *y += (part & 1) != 0 ? step : 0;
    }
}

}  // namespace

std::vector<Tile> TilesFromTheMiddle(int width, int height) {
    return InterleavedTiles(width, height, 1)[0];
}

std::vector<std::vector<Tile>> InterleavedTiles(int width, int height, int stride) {
    const std::vector<Tile> blocks = BlocksFromTheMiddle(width, height, kBlockSize);
    std::vector<std::vector<Tile>> parts(size_t(stride) * stride);
    for (size_t part = 0; part < parts.size(); ++part) {
        int dx, dy;
        PixelOfPart(static_cast<int>(part), stride, &dx, &dy);
        for (const Tile& block : blocks) {
            for (const Tile& area : Cut(block, kTileSize * stride)) {
                const Tile tile{area.x + dx, area.y + dy, (area.width - dx + stride - 1) / stride,
                                (area.height - dy + stride - 1) / stride, stride};
                if (tile.width > 0 && tile.height > 0) {
                    parts[part].push_back(tile);
                }
            }
        }
    }
    return parts;
}

}  // namespace cc
