#pragma once

#include <map>
#include <unordered_map>
#include <utility>
#include <vector>

#include <opensubdiv/far/topologyRefiner.h>

#include "core/subdiv/ringTags.h"

namespace cc {

/// By vertex, where there are any: RingTags::seamSharpness.
using Seams = std::map<int, std::vector<float>>;

/// The mean sharpness of the semi-sharp edges at an end of an edge but that one, those beyond seams
/// among them; or its own if there are no others (RingTags::farSharpness).
float MeanOfOthers(const OpenSubdiv::Far::TopologyLevel& level, const Seams& seams, int edge,
                   int end);

/// A refined vertex as a weighted sum of coarse vertices and of refined ones in faces' middles.
struct SeamRow {
    int vertex;
    std::vector<std::pair<int, float>> coarse, facePoints;
};

/// What Chaikin's rule makes of one step at vertices that have seams, which OpenSubdiv does not
/// know of.
struct SeamRefinement {
    Seams seams;
    std::vector<SeamRow> rows;
    /// By edge of the refined level.
    std::unordered_map<int, float> edgeSharpness;
};

/// @param refiner  of two levels, with the topology of both
/// @param seams    of level 0
SeamRefinement RefineSeams(const OpenSubdiv::Far::TopologyRefiner& refiner, const Seams& seams);

}  // namespace cc
