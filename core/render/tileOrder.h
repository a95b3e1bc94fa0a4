#pragma once

#include <vector>

namespace cc {

/// Side of a tile in pixels: its samples are one packet of 64 rays.
constexpr int kTileSize = 8;

/// Pixels that are rendered together. Tiles at the upper and right edge may be smaller.
struct Tile {
    int x, y, width, height;
};

/// All tiles of a picture, from the middle outwards in blocks, where a person looks first;
/// neighbours in the order are neighbours in the picture and hit the same patches.
std::vector<Tile> TilesFromTheMiddle(int width, int height);

}  // namespace cc
