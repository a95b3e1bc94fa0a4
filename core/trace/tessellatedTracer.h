#pragma once

#include "core/trace/packetKernels.h"

namespace cc {

/// Packets against the quads that Surface::TessellationAt holds.
PacketKernels TessellatedKernels();

}  // namespace cc
