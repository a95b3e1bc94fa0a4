#pragma once

namespace cc {

/// A square of a patch's parameters: its lower corner and its side.
struct Square {
    float u, v, size;

    /// The quarter at a corner, counted from (0,0) by (1,0) and (1,1) to (0,1), modulo four.
    Square Quarter(int corner) const {
        const float half = size * 0.5f;
        const int c = corner & 3;
        return {c == 1 || c == 2 ? u + half : u, c >= 2 ? v + half : v, half};
    }
};

}  // namespace cc
