#include "tests/watertight/closedCages.h"

#include <map>
#include <utility>

namespace cc::test {
namespace {

bool IsClosed(const ControlMesh& mesh) {
    std::map<std::pair<int, int>, int> edges;
    size_t first = 0;
    for (const int count : mesh.faceVertexCounts) {
        for (int i = 0; i < count; ++i) {
            const int a = mesh.faceVertexIndices[first + i];
            const int b = mesh.faceVertexIndices[first + (i + 1) % count];
            ++edges[{a, b}];
        }
        first += count;
    }
    for (const auto& [edge, count] : edges) {
        const auto back = edges.find({edge.second, edge.first});
        if (edge.first == edge.second || count != 1 || back == edges.end() || back->second != 1) {
            return false;
        }
    }
    return !edges.empty();
}

}  // namespace

std::vector<Cage> ClosedCages() {
    std::vector<Cage> closed;
    for (Cage& cage : Catalogue()) {
        ValidateControlMesh(&cage.mesh, cage.points.size());
        cage.mesh.holeIndices.clear();
        if (IsClosed(cage.mesh)) {
            closed.push_back(std::move(cage));
        }
    }
    return closed;
}

}  // namespace cc::test
