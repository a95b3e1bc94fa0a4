#include <cmath>

#include "tests/unit/subdiv/cageKit.h"

namespace cc::test {

namespace {

/// Triangles that meet in one vertex, each with a triangle beyond its outer edge.
Cage TriangleStar(int valence) {
    std::vector<std::vector<int>> faces;
    for (int i = 0; i < valence; ++i) {
        const int a = 1 + i, b = 1 + (i + 1) % valence;
        faces.push_back({0, a, b});
        faces.push_back({b, a, 1 + valence + i});
    }
    Cage cage = FromFaces("triangle star" + std::to_string(valence), faces);
    for (int i = 0; i < 2 * valence; ++i) {
        const int ring = i / valence;
        const float angle = 6.28318530718f * (i + 0.5f * ring) / valence;
        const float radius = ring == 0 ? 1 : 2.1f;
        cage.points[1 + i] = {radius * std::cos(angle), radius * std::sin(angle),
                              0.2f * std::sin(2.3f * i) - 0.5f * ring};
    }
    cage.points[0] = {0, 0, 0.6f};
    return cage;
}

/// An octahedron: triangles only, valence 4 everywhere.
Cage Octahedron() {
    Cage cage;
    cage.points = {{1, 0, 0}, {-1, 0, 0}, {0, 1.2f, 0}, {0, -1.2f, 0}, {0, 0, 1.5f}, {0, 0, -1.5f}};
    for (const std::vector<int>& face : std::vector<std::vector<int>>{{0, 2, 4},
                                                                      {2, 1, 4},
                                                                      {1, 3, 4},
                                                                      {3, 0, 4},
                                                                      {2, 0, 5},
                                                                      {1, 2, 5},
                                                                      {3, 1, 5},
                                                                      {0, 3, 5}}) {
        AddFace(&cage, face);
    }
    return Named(cage, "octahedron");
}

/// Faces of 3, 4, 5 and 6 corners around one vertex, on an open sheet.
Cage MixedFan() {
    return FromFaces("fan of 3 4 5 and 6 corners",
                     {{0, 1, 2}, {0, 2, 3, 4}, {0, 4, 5, 6, 7}, {0, 7, 8, 9, 10, 1}},
                     {{0, 0, 0.7f},
                      {1.2f, 0, 0.1f},
                      {0.4f, 1.1f, -0.1f},
                      {-0.4f, 1.5f, 0.2f},
                      {-1, 0.8f, 0},
                      {-1.7f, 0.5f, 0.2f},
                      {-1.8f, -0.5f, -0.2f},
                      {-1, -0.8f, 0.1f},
                      {-0.6f, -1.7f, -0.2f},
                      {0.5f, -1.9f, 0.2f},
                      {1.3f, -1, 0}});
}

/// Two quads back to back along two edges: their common vertex in the interior has valence 2.
Cage ValenceTwo() {
    return FromFaces(
        "valence 2",
        {{0, 1, 2, 3}, {0, 3, 2, 4}, {1, 5, 6, 2}, {2, 6, 7, 4}, {5, 1, 0, 8}, {8, 0, 4, 7}},
        {{-0.8f, -0.8f, 0.3f},
         {0.8f, -0.7f, 0.5f},
         {0.8f, 0.8f, 0.3f},
         {0.1f, 0, 0.8f},
         {-0.7f, 0.8f, 0.4f},
         {1.8f, -1.8f, 0.1f},
         {1.7f, 1.8f, -0.2f},
         {-1.8f, 1.8f, 0.1f},
         {-1.8f, -1.7f, -0.1f}});
}

Cage QuadPillow() { return FromFaces("two quads back to back", {{0, 1, 2, 3}, {3, 2, 1, 0}}); }

Cage TrianglePillow() { return FromFaces("two triangles back to back", {{0, 1, 2}, {2, 1, 0}}); }

/// Quads of a sheet with a corner pulled into its neighbour: triangles that are written as quads.
Cage Collapsed() {
    Cage cage = Sheet(3);
    cage.mesh.faceVertexIndices[4 * 4 + 2] = cage.mesh.faceVertexIndices[4 * 4 + 1];
    return Named(cage, "sheet with a collapsed edge");
}

Cage CollapsedPentagon() {
    return FromFaces("pentagon with a collapsed edge",
                     {{0, 1, 2, 2, 3}, {1, 0, 4, 5}, {2, 1, 5, 6}, {0, 3, 7, 4}, {3, 2, 6, 7}});
}

Cage Unreferenced() {
    Cage cage = Fan(5);
    cage.points.insert(cage.points.end(), 3, {100, 50, 20});
    return Named(cage, "points that no face uses");
}

Cage LeftHanded(Cage cage, const std::string& name) {
    cage.mesh.leftHanded = true;
    return Named(std::move(cage), name);
}

Cage SmoothTriangles(Cage cage, const std::string& name) {
    cage.mesh.triangleRule = TriangleRule::Smooth;
    return Named(std::move(cage), name);
}

}  // namespace

std::vector<Cage> ShapeCages() {
    std::vector<Cage> cages{Cube(), Sheet(4), Torus(8, 6), Tetrahedron(), Octahedron()};
    for (int valence : {2, 3, 5, 6, 7, 9, 17}) {
        cages.push_back(Fan(valence));
    }
    for (int sides : {3, 5, 6, 12, 30}) {
        cages.push_back(Drum(sides));
    }
    for (int valence : {3, 5, 8}) {
        cages.push_back(TriangleStar(valence));
    }
    cages.insert(cages.end(), {MixedFan(), ValenceTwo(), QuadPillow(), TrianglePillow(),
                               Collapsed(), CollapsedPentagon(), Unreferenced()});
    cages.push_back(Named(Torus(3, 3), "smallest torus"));
    for (int valence : {3, 5, 7}) {
        cages.push_back(Rough(Fan(valence)));
    }
    cages.push_back(Rough(Cube()));
    cages.push_back(LeftHanded(Fan(5), "left-handed fan"));
    cages.push_back(LeftHanded(Drum(5), "left-handed drum"));
    cages.push_back(SmoothTriangles(Tetrahedron(), "tetrahedron, smooth triangles"));
    cages.push_back(SmoothTriangles(Octahedron(), "octahedron, smooth triangles"));
    cages.push_back(SmoothTriangles(MixedFan(), "mixed fan, smooth triangles"));
    cages.push_back(SmoothTriangles(TriangleStar(6), "triangle star, smooth triangles"));
    return cages;
}

}  // namespace cc::test
