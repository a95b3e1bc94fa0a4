#include "core/subdiv/ringTable.h"

#include <vector>

namespace cc {

bool RingTable::Find(int vertex, int face, RingPlace* place) {
    const auto found = _places.find(_Key(vertex, face));
    if (found != _places.end()) {
        *place = found->second;
        return true;
    }
    if (_level->Topology().GetVertexFaces(vertex).size() > kMaxRingFaces) {
        return false;
    }
    CornerRing ring;
    if (!GatherCornerRing(*_level, vertex, face, &ring)) {
        return false;
    }
    *place = Add(ring, face);
    return true;
}

RingPlace RingTable::Add(const CornerRing& ring, int face) {
    const int vertex = ring.vertices.front();
    const auto found = _places.find(_Key(vertex, face));
    if (found != _places.end()) {
        return found->second;
    }
    std::vector<uint32_t> points;
    for (int v : ring.vertices) {
        points.push_back(_level->PatchPoint(v, _table));
    }
    const RingTags& tags = ring.tags;
    PatchRing stored{};
    stored.faceCount = static_cast<uint16_t>(ring.faces.size());
    stored.outsideCount = static_cast<uint16_t>(tags.outsideSharpness.size());
    stored.seamCount = static_cast<uint16_t>(tags.seamSharpness.size());
    stored.isClosed = tags.isClosed;
    stored.outsideNeighborCount = static_cast<uint8_t>(tags.outsideNeighborCount);
    stored.vertexSharpness = tags.vertexSharpness;
    std::vector<float> sharpnesses(tags.edgeSharpness.begin(), tags.edgeSharpness.end());
    sharpnesses.insert(sharpnesses.end(), tags.outsideSharpness.begin(),
                       tags.outsideSharpness.end());
    if (_table->Decay() == SharpnessDecay::Chaikin) {
        sharpnesses.insert(sharpnesses.end(), tags.farSharpness.begin(), tags.farSharpness.end());
        sharpnesses.insert(sharpnesses.end(), tags.seamSharpness.begin(), tags.seamSharpness.end());
    }
    const uint32_t index = _table->AddRing(stored, points, sharpnesses);
    for (uint32_t i = 0; i < stored.faceCount; ++i) {
        _places[_Key(vertex, ring.faces[i])] = {index, i};
    }
    return _places[_Key(vertex, face)];
}

}  // namespace cc
