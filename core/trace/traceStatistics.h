#pragma once

#include <cstdint>

namespace cc {

/// Counts of what packets did, as in Table 1 of the paper. One a thread, added up at the end.
struct TraceStatistics {
    uint64_t packets = 0;
    uint64_t rays = 0;
    uint64_t traversals = 0;             ///< BVH nodes visited
    uint64_t leafIntersections = 0;      ///< patches reached through the BVH
    uint64_t subdivisionsRegular = 0;    ///< splits of regular 4x4 patches
    uint64_t subdivisionsIrregular = 0;  ///< splits of patches with an extraordinary vertex
    uint64_t boxTests = 0;               ///< sub-patch boxes tested
    uint64_t earlyHits = 0;              ///< of these, entered because the first active ray hits
    uint64_t intervalCulls = 0;          ///< of these, culled by interval arithmetic
    uint64_t finalIntersections = 0;     ///< quads tested against rays
    uint64_t activeLanes = 0;            ///< rays tested against those quads

    TraceStatistics& operator+=(const TraceStatistics& b) {
        packets += b.packets;
        rays += b.rays;
        traversals += b.traversals;
        leafIntersections += b.leafIntersections;
        subdivisionsRegular += b.subdivisionsRegular;
        subdivisionsIrregular += b.subdivisionsIrregular;
        boxTests += b.boxTests;
        earlyHits += b.earlyHits;
        intervalCulls += b.intervalCulls;
        finalIntersections += b.finalIntersections;
        activeLanes += b.activeLanes;
        return *this;
    }
};

}  // namespace cc
