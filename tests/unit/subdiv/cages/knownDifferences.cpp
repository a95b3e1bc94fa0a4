#include "tests/unit/subdiv/cageKit.h"

namespace cc::test {
namespace {

/// Bfr gives the vertex that the creases share one position on two of its faces, and another, 0.006
/// diagonals off, on the third. Ours is that of the first two and of Far.
Cage ThreeChaikinCreases() {
    Cage cage = Named(Cube(), "three Chaikin creases of a vertex");
    AddCrease(&cage, {0, 1}, 0.5f);
    AddCrease(&cage, {0, 2}, 4.0f);
    AddCrease(&cage, {0, 4}, 1.7f);
    cage.mesh.creaseRule = CreaseRule::Chaikin;
    return cage;
}

/// Under Chaikin's rule weak edges stay sharp where they meet strong ones, and strong ones soften
/// where they meet weak ones. Ours are Far's surfaces; Bfr has others beside such edges.
Cage UnevenChaikinCrease() {
    Cage cage = Named(Cube(), "uneven Chaikin crease");
    cage.mesh.creaseIndices = {0, 2, 3, 1, 5};
    cage.mesh.creaseLengths = {5};
    cage.mesh.creaseSharpnesses = {0.5f, 2.7f, 1.1f, 0.1f};
    cage.mesh.creaseRule = CreaseRule::Chaikin;
    return cage;
}

Cage ChaikinCreaseBySteps() {
    Cage cage = Named(Sheet(2), "Chaikin crease by steps");
    cage.mesh.creaseIndices = {0, 1, 4, 3};
    cage.mesh.creaseLengths = {4};
    cage.mesh.creaseSharpnesses = {10, 5, 3.3f};
    cage.mesh.creaseRule = CreaseRule::Chaikin;
    return cage;
}

/// Two creases that look alike up to their third vertices: only what follows on the fourth tells
/// whether they stay sharp there.
Cage ChaikinCreasesThatDifferAhead() {
    Cage cage = Named(Torus(6, 7), "Chaikin creases that differ ahead");
    AddCrease(&cage, {0, 1, 2, 3}, 1.1f);
    AddCrease(&cage, {3, 4, 5, 6, 0}, 0.4f);
    AddCrease(&cage, {21, 22, 23, 24}, 1.1f);
    AddCrease(&cage, {24, 25, 26, 27, 21}, 2.8f);
    cage.mesh.creaseRule = CreaseRule::Chaikin;
    return cage;
}

Cage ChaikinCreaseThroughValence5() {
    Cage cage = Named(Fan(5), "fan, Chaikin crease by edge");
    cage.mesh.creaseIndices = {11, 1, 0, 5, 15};
    cage.mesh.creaseLengths = {5};
    cage.mesh.creaseSharpnesses = {0.6f, 3.2f, 1.1f, 2.4f};
    cage.mesh.creaseRule = CreaseRule::Chaikin;
    return cage;
}

/// Bfr does not see on the faces beside the fin's edge that it sharpens the vertices at its ends.
Cage TetrahedronWithFin() {
    Cage cage = Named(Tetrahedron(), "tetrahedron with a fin");
    cage.points.push_back({0.9f, 0.5f, 0.4f});
    AddFace(&cage, {1, 0, 4});
    return cage;
}

/// Around vertex 0 there is a crease of two edges with three faces each. Of both edges hangs a
/// closed fan that has one of them only, and Bfr looks for the other within it.
Cage CreaseWithTubes() {
    return FromFaces("tubes on a crease", {{0, 1, 3, 2},
                                           {0, 2, 4, 5},
                                           {0, 6, 7, 1},
                                           {8, 9, 11, 10},
                                           {0, 1, 9, 8},
                                           {6, 10, 11, 7},
                                           {0, 8, 10, 6},
                                           {1, 7, 11, 9},
                                           {5, 12, 13, 0},
                                           {14, 15, 17, 16},
                                           {5, 0, 15, 14},
                                           {12, 16, 17, 13},
                                           {5, 14, 16, 12},
                                           {0, 13, 17, 15}});
}

/// As above, but the closed fan only touches the crease in a vertex, and Bfr does not see the
/// crease from it.
Cage CreaseWithTouchingFan() {
    return FromFaces("crease that a fan touches", {{4, 5, 7, 6},
                                                   {0, 1, 5, 4},
                                                   {2, 6, 7, 4},
                                                   {0, 4, 6, 2},
                                                   {1, 4, 7, 5},
                                                   {0, 2, 8},
                                                   {2, 4, 8},
                                                   {4, 1, 8},
                                                   {1, 0, 8},
                                                   {4, 5, 7, 6}});
}

}  // namespace

std::vector<Cage> KnownDifferences() {
    return {ThreeChaikinCreases(),
            UnevenChaikinCrease(),
            ChaikinCreaseBySteps(),
            ChaikinCreasesThatDifferAhead(),
            ChaikinCreaseThroughValence5(),
            TetrahedronWithFin(),
            CreaseWithTubes(),
            WithCrease(CreaseWithTubes(), {0, 6}, 0.7f, "tubes with a crease of 0.7"),
            CreaseWithTouchingFan(),
            WithCorner(CreaseWithTouchingFan(), 4, 1.5f, "touched crease, corner of 1.5")};
}

}  // namespace cc::test
