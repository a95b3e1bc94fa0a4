#include <cmath>

#include "tests/unit/subdiv/cageKit.h"

namespace cc::test {
namespace {

constexpr float kTwoPi = 6.28318530718f;

}  // namespace

Cage TriangleSheet(int n) { return Named(Triangulated(Sheet(n)), "loop sheet"); }

Cage TriangleTorus(int around, int across) {
    return Named(Triangulated(Torus(around, across)), "loop torus");
}

Cage TriangleFan(int valence) {
    Cage cage;
    cage.name = "loop fan" + std::to_string(valence);
    cage.mesh.scheme = Scheme::Loop;
    cage.points.push_back({0, 0, 0.5f});
    for (int ring = 1; ring <= 2; ++ring) {
        for (int i = 0; i < valence; ++i) {
            const float angle = kTwoPi * (i + 0.5f * ring) / valence;
            cage.points.push_back({ring * std::cos(angle), ring * std::sin(angle),
                                   0.1f * std::sin(3.1f * i) - 0.2f * ring});
        }
    }
    for (int i = 0; i < valence; ++i) {
        const int next = (i + 1) % valence;
        AddFace(&cage, {0, 1 + i, 1 + next});
        AddFace(&cage, {1 + i, 1 + valence + i, 1 + next});
        AddFace(&cage, {1 + next, 1 + valence + i, 1 + valence + next});
    }
    return cage;
}

Cage OpenTriangleFan(int faceCount) {
    Cage cage;
    cage.name = "loop open fan" + std::to_string(faceCount);
    cage.mesh.scheme = Scheme::Loop;
    cage.points.push_back({0, 0, 0.3f});
    for (int i = 0; i <= faceCount; ++i) {
        const float angle = 0.4f * kTwoPi * i / faceCount;
        cage.points.push_back({std::cos(angle), std::sin(angle), 0.2f * std::sin(2.3f * i)});
    }
    for (int i = 0; i < faceCount; ++i) {
        AddFace(&cage, {0, 1 + i, 2 + i});
    }
    return cage;
}

Cage LoopOctahedron() {
    Cage cage = FromFaces(
        "loop octahedron",
        {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}});
    cage.mesh.scheme = Scheme::Loop;
    cage.points = {{1.2f, 0, 0}, {-1, 0, 0}, {0, 1, 0.1f}, {0, -1, 0}, {0, 0.2f, 1}, {0, 0, -1}};
    return cage;
}

Cage LoopIcosahedron() {
    Cage cage;
    cage.name = "loop icosahedron";
    cage.mesh.scheme = Scheme::Loop;
    cage.points = {{0, 0, 1.1f}, {0, 0, -1}};
    for (int i = 0; i < 10; ++i) {
        const float angle = kTwoPi * i / 10;
        cage.points.push_back(
            {0.9f * std::cos(angle), 0.9f * std::sin(angle), i % 2 ? -0.45f : 0.45f});
    }
    for (int i = 0; i < 10; ++i) {
        const int a = 2 + i, b = 2 + (i + 1) % 10, c = 2 + (i + 2) % 10;
        if (i % 2 == 0) {
            AddFace(&cage, {0, a, c});
            AddFace(&cage, {a, b, c});
        } else {
            AddFace(&cage, {1, c, a});
            AddFace(&cage, {b, a, c});
        }
    }
    return cage;
}

std::vector<Cage> LoopShapeCages() {
    Cage tetrahedron = Named(Tetrahedron(), "loop tetrahedron");
    tetrahedron.mesh.scheme = Scheme::Loop;
    std::vector<Cage> cages{tetrahedron,
                            LoopOctahedron(),
                            LoopIcosahedron(),
                            TriangleTorus(8, 6),
                            TriangleTorus(3, 3),
                            TriangleSheet(1),
                            TriangleSheet(4),
                            Named(Triangulated(Cube()), "loop cube"),
                            Named(Triangulated(Drum(9)), "loop drum"),
                            OpenTriangleFan(1),
                            OpenTriangleFan(2),
                            OpenTriangleFan(3),
                            OpenTriangleFan(4),
                            OpenTriangleFan(7)};
    for (int valence : {3, 4, 5, 6, 7, 9, 12, 40}) {
        cages.push_back(TriangleFan(valence));
    }
    for (const Cage& cage :
         {TriangleFan(4), TriangleFan(7), OpenTriangleFan(2), OpenTriangleFan(5)}) {
        cages.push_back(Rough(cage));
    }
    Cage left = Named(LoopIcosahedron(), "loop icosahedron, left-handed");
    left.mesh.leftHanded = true;
    cages.push_back(left);
    Cage pillow = FromFaces("loop pillow of valence 2 and 4",
                            {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}, {1, 0, 2}, {3, 2, 0}});
    pillow.mesh.scheme = Scheme::Loop;
    cages.push_back(pillow);
    return cages;
}

}  // namespace cc::test
