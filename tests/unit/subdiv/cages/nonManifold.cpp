#include "tests/unit/subdiv/cageKit.h"

namespace cc::test {

namespace {

/// Three wings of two quads each along one edge of two segments.
Cage ThreeWings() {
    return FromFaces(
        "three wings",
        {{0, 1, 4, 3}, {1, 2, 5, 4}, {1, 0, 6, 7}, {2, 1, 7, 8}, {0, 1, 10, 9}, {1, 2, 11, 10}},
        {{-1, 0, 0},
         {0, 0, 0.3f},
         {1, 0, 0},
         {-1, 1.2f, -0.3f},
         {0, 1.3f, 0.1f},
         {1, 1.1f, -0.2f},
         {-1, -1.2f, -0.3f},
         {0, -1, 0.2f},
         {1, -1.2f, -0.2f},
         {-1.1f, 0.1f, 1.2f},
         {0, 0.2f, 1.5f},
         {1, 0.1f, 1.2f}});
}

Cage BowTie() {
    return FromFaces("bow tie", {{0, 1, 2, 3}, {0, 4, 5, 6}},
                     {{0, 0, 0.3f},
                      {0.9f, -0.8f, 0},
                      {1.9f, 0, 0.4f},
                      {1, 0.7f, 0.1f},
                      {-1, 0.8f, 0},
                      {-1.8f, 0.1f, 0.5f},
                      {-0.9f, -0.7f, 0.1f}});
}

/// Two fans of two quads that share only a vertex.
Cage WideBowTie() {
    return FromFaces("wide bow tie", {{0, 1, 2, 3}, {0, 3, 4, 5}, {0, 6, 7, 8}, {0, 8, 9, 10}},
                     {{0, 0, 0.4f},
                      {0.4f, -1.2f, 0},
                      {1.5f, -1.1f, 0.3f},
                      {1.3f, 0, -0.2f},
                      {1.4f, 1.2f, 0.2f},
                      {0.5f, 1.1f, 0},
                      {-0.4f, 1.2f, 0.1f},
                      {-1.5f, 1.2f, 0.3f},
                      {-1.2f, 0.1f, -0.2f},
                      {-1.4f, -1.2f, 0.2f},
                      {-0.5f, -1.1f, 0}});
}

Cage BowTieOfTriangles() {
    return FromFaces("bow tie of triangles", {{0, 1, 2}, {0, 2, 3}, {0, 4, 5}});
}

/// A closed cube and a quad that stands on one of its edges.
Cage CubeWithFin() {
    Cage cage = Named(Cube(), "cube with a fin");
    cage.points.push_back({-1, -2, -2});
    cage.points.push_back({1, -2, -2});
    AddFace(&cage, {0, 1, 9, 8});
    return cage;
}

/// Two cubes that share one vertex.
Cage TouchingCubes() {
    Cage cage = Named(Cube(), "cubes that touch in a vertex");
    const Cage other = Cube();
    for (int i = 1; i < 8; ++i) {
        cage.points.push_back(other.points[i] + Vec3f{-2, -2, -2});
    }
    // Vertex 7 of the second is vertex 0 of the first.
    for (int i = 0; i < 24; ++i) {
        const int v = other.mesh.faceVertexIndices[i];
        cage.mesh.faceVertexIndices.push_back(v == 7 ? 0 : v == 0 ? 14 : 7 + v);
    }
    cage.points[14] = other.points[0] + Vec3f{-2, -2, -2};
    cage.mesh.faceVertexCounts.insert(cage.mesh.faceVertexCounts.end(), 6, 4);
    return cage;
}

Cage Flipped() {
    return FromFaces("neighbours that disagree", {{0, 1, 2, 3}, {0, 1, 5, 4}, {1, 6, 7, 2}},
                     {{0, 0, 0.3f},
                      {1, 0, 0.5f},
                      {1.1f, 1, 0},
                      {0, 1.1f, 0.1f},
                      {0.1f, -1, -0.2f},
                      {1, -1.1f, 0},
                      {2, 0.1f, 0.1f},
                      {2.1f, 1, -0.3f}});
}

Cage Duplicate() {
    Cage cage = Named(Sheet(2), "the same face twice");
    AddFace(&cage, {0, 1, 4, 3});
    return cage;
}

Cage DuplicateInside() {
    Cage cage = Named(Sheet(3), "the middle face twice");
    AddFace(&cage, {5, 6, 10, 9});
    return cage;
}

/// Two triangles back to back that hang from an inner edge of a sheet: around that edge's ends, the
/// sheet's own faces begin and end with it.
Cage SheetWithFlap() {
    Cage cage = Named(Sheet(4), "sheet with a flap");
    cage.points.push_back({1.3f, 1.5f, -0.5f});
    AddFace(&cage, {5, 6, 25});
    AddFace(&cage, {5, 25, 6});
    return cage;
}

/// A triangle runs along an edge in the same direction as a quad, and is refined.
Cage FlippedTriangle() {
    return FromFaces("triangle that disagrees", {{0, 1, 2, 3}, {0, 1, 4}, {1, 5, 6, 2}});
}

}  // namespace

std::vector<Cage> NonManifoldCages() {
    const std::vector<Cage> plain{ThreeWings(),        BowTie(),          WideBowTie(),
                                  BowTieOfTriangles(), CubeWithFin(),     Flipped(),
                                  Duplicate(),         DuplicateInside(), TouchingCubes(),
                                  SheetWithFlap(),     FlippedTriangle()};
    std::vector<Cage> cages = plain;
    for (const Cage& cage : plain) {
        cages.push_back(WithBoundary(cage, BoundaryRule::EdgeOnly, cage.name + " edgeOnly"));
    }
    cages.push_back(WithBoundary(TouchingCubes(), BoundaryRule::None, "touching cubes none"));
    cages.push_back(WithCrease(ThreeWings(), {0, 1, 2}, 1.5f, "three wings, crease on the joint"));
    cages.push_back(WithCrease(ThreeWings(), {1, 4}, 2.7f, "three wings, crease into the joint"));
    cages.push_back(WithCorner(WideBowTie(), 0, 1.5f, "wide bow tie, corner 1.5"));
    cages.push_back(WithCrease(WideBowTie(), {0, 3}, 10, "wide bow tie, sharp crease"));
    cages.push_back(WithCrease(CubeWithFin(), {0, 2, 3}, 1.3f, "cube with a fin and a crease"));
    return cages;
}

}  // namespace cc::test
