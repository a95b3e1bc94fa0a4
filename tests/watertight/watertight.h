#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/trace/tracer.h"
#include "tests/unit/subdiv/testCages.h"

namespace cc::test {

/// How large a cage is made and how far from the origin it is put.
struct Placement {
    const char* name;
    float scale;
    float offset;      ///< along each axis, after scaling
    bool byTransform;  ///< by an instance's transform, else points are moved
};

/// The size of an experiment. Rays are spread evenly over all else, but cages of the Loop scheme
/// get a tenth of them.
struct WatertightOptions {
    uint64_t rays = 1'000'000;  ///< nearly so many
    uint32_t seed = 1;
    std::vector<int> levels{0, 1, 2, 3, 4, 5, 6};
    /// Levels are then the finest that cameras ask for, which stand anywhere near the surface and
    /// are as particular as makes levels differ.
    bool isAdaptive = false;
    std::vector<TracerKind> tracers{TracerKind::Packet, TracerKind::Single};
    std::vector<Placement> placements;  ///< AllPlacements() if empty
};

/// From 1e-4 to 1e5 in size, and up to 1e5 from the origin.
const std::vector<Placement>& AllPlacements();

/// What came of one level, tracer and placement, over all cages.
struct WatertightCount {
    int level;
    bool isAdaptive;
    TracerKind tracer;
    std::string placement;
    uint64_t rays = 0, escapes = 0;
    std::string firstEscape;  ///< a line that says which ray of which cage; empty without
};

/// Sends rays from points inside closed cages, and through such points from outside: at random, at
/// edges, at vertices, and at the quads' own edges and vertices. Every one of them must hit, by
/// nearest-hit and by any-hit queries. The same options give the same rays; cages are traced in
/// parallel.
std::vector<WatertightCount> CountEscapes(const std::vector<Cage>& closedCages,
                                          const WatertightOptions& options);

}  // namespace cc::test
