#pragma once

#include <cstdint>
#include <unordered_map>

#include "core/subdiv/oneRing.h"
#include "core/subdiv/patchTable.h"
#include "core/subdiv/refinementLevel.h"

namespace cc {

/// A ring of the table, and which of its faces a face is.
struct RingPlace {
    uint32_t ring, face;
};

/// Adds the rings of a level's vertices to a patch table, each once for all faces on its side.
class RingTable {
  public:
    RingTable(RefinementLevel* level, PatchTable* table) : _level(level), _table(table) {}

    /// Finds the ring of a vertex on the side of a face, and adds it if it is new. Returns false if
    /// there is none (GatherCornerRing), or if the vertex has more than kMaxRingFaces.
    bool Find(int vertex, int face, RingPlace* place);

    /// Adds a ring that was gathered; returns where a face of it is.
    RingPlace Add(const CornerRing& ring, int face);

  private:
    RefinementLevel* const _level;
    PatchTable* const _table;
    static uint64_t _Key(int vertex, int face) {
        return uint64_t(static_cast<uint32_t>(vertex)) << 32 | static_cast<uint32_t>(face);
    }

    /// By vertex and face of the level.
    std::unordered_map<uint64_t, RingPlace> _places;
};

}  // namespace cc
