#include <cmath>

#include "tests/unit/subdiv/cageKit.h"

namespace cc::test {

namespace {

/// Quads around a vertex on the boundary, which has count + 1 edges.
Cage OpenFan(int count) {
    std::vector<std::vector<int>> faces;
    for (int i = 0; i < count; ++i) {
        faces.push_back({0, 1 + 2 * i, 2 + 2 * i, 3 + 2 * i});
    }
    Cage cage = FromFaces("open fan of " + std::to_string(count), faces);
    for (size_t i = 1; i < cage.points.size(); ++i) {
        const float angle = 5.0f * static_cast<float>(i) / static_cast<float>(cage.points.size());
        cage.points[i] = {2 * std::cos(angle), 2 * std::sin(angle),
                          0.3f * std::sin(2.0f * static_cast<float>(i))};
    }
    cage.points[0] = {0, 0, 0.4f};
    return cage;
}

/// A strip of quads, one wide.
Cage Strip(int length) {
    std::vector<std::vector<int>> faces;
    for (int i = 0; i < length; ++i) {
        faces.push_back({2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1});
    }
    Cage cage = FromFaces("strip", faces);
    for (int i = 0; i <= length; ++i) {
        const float x = static_cast<float>(i);
        cage.points[2 * i] = {x, 0, std::sin(x)};
        cage.points[2 * i + 1] = {x + 0.2f, 1, std::cos(1.3f * x)};
    }
    return cage;
}

/// A sheet without its middle: a boundary whose corners have three faces each.
Cage Frame() {
    Cage cage = Sheet(3);
    cage.mesh.faceVertexCounts.pop_back();
    auto& indices = cage.mesh.faceVertexIndices;
    indices.erase(indices.begin() + 16, indices.begin() + 20);
    return Named(cage, "frame");
}

Cage TriangleSheet() {
    return FromFaces("sheet of triangles", {{0, 1, 2}, {2, 1, 3}, {2, 3, 4}, {4, 3, 5}, {0, 2, 6}});
}

}  // namespace

std::vector<Cage> BoundaryCages() {
    std::vector<Cage> cages;
    const auto addBothRules = [&cages](const Cage& cage) {
        cages.push_back(cage);
        cages.push_back(WithBoundary(cage, BoundaryRule::EdgeOnly, cage.name + " edgeOnly"));
    };
    addBothRules(Named(Sheet(1), "one quad"));
    addBothRules(FromFaces("one triangle", {{0, 1, 2}}));
    addBothRules(FromFaces("one hexagon", {{0, 1, 2, 3, 4, 5}},
                           {{1, 0, 0.2f},
                            {0.5f, 0.9f, -0.2f},
                            {-0.5f, 0.8f, 0.3f},
                            {-1.1f, 0, -0.1f},
                            {-0.4f, -0.9f, 0.2f},
                            {0.5f, -0.8f, -0.3f}}));
    addBothRules(Named(Sheet(2), "sheet of four quads"));
    addBothRules(Strip(4));
    addBothRules(Frame());
    addBothRules(TriangleSheet());
    for (int count : {2, 3, 4, 7}) {
        addBothRules(OpenFan(count));
        addBothRules(Rough(OpenFan(count)));
    }
    addBothRules(Named(Fan(3), "open fan about valence 3"));
    cages.push_back(WithBoundary(Sheet(4), BoundaryRule::EdgeOnly, "sheet edgeOnly"));
    cages.push_back(WithBoundary(Sheet(5), BoundaryRule::None, "sheet none"));
    cages.push_back(WithBoundary(Fan(5), BoundaryRule::None, "fan5 none"));
    cages.push_back(WithBoundary(Drum(5), BoundaryRule::None, "drum none"));
    for (const Cage& cage : {OpenFan(2), OpenFan(3), OpenFan(7)}) {
        cages.push_back(WithCorner(cage, 0, 10, cage.name + " with a corner"));
    }
    return cages;
}

}  // namespace cc::test
