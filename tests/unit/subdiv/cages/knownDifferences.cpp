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

/// Bfr does not see on the faces beside the fin's edge that it sharpens the vertices at its ends.
Cage TetrahedronWithFin() {
    Cage cage = Named(Tetrahedron(), "tetrahedron with a fin");
    cage.points.push_back({0.9f, 0.5f, 0.4f});
    AddFace(&cage, {1, 0, 4});
    return cage;
}

}  // namespace

std::vector<Cage> KnownDifferences() { return {ThreeChaikinCreases(), TetrahedronWithFin()}; }

}  // namespace cc::test
