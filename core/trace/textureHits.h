#pragma once

#include "core/trace/rayPacket.h"

namespace cc {

/// Texture coordinates at the hits of a packet. Lanes of rays without a hit, or with one on a
/// triangle of the Loop scheme, are left alone.
struct alignas(64) TextureHits {
    float s[kPacketSize], t[kPacketSize];
};

}  // namespace cc
