#pragma once

#include <vector>

namespace cc {

/// Side of a tile in pixels: its samples are one packet of 64 rays.
constexpr int kTileSize = 8;

/// Pixels that are rendered together: a ray each, row by row from the lower left. Tiles at the
/// upper and right edge may be smaller.
struct Tile {
    int x, y, width, height;
    int stride = 1;  ///< from each pixel to the next, in both directions

    int Count() const { return width * height; }
    int X(int ray) const { return x + stride * (ray % width); }
    int Y(int ray) const { return y + stride * (ray / width); }
};

/// All tiles of a picture, from the middle outwards in blocks, where a person looks first;
/// neighbours in the order are neighbours in the picture and hit the same patches.
std::vector<Tile> TilesFromTheMiddle(int width, int height);

/// The same in parts of stride x stride: of each square of as many pixels every part has one, as
/// Interleaved Sampling has it (Keller, Heidrich 2001). Parts come in an order in which each is far
/// from those before it.
/// @param stride  a power of two
std::vector<std::vector<Tile>> InterleavedTiles(int width, int height, int stride);

}  // namespace cc
