#include "tests/unit/subdiv/cageKit.h"

namespace cc::test {

namespace {

Cage HoleByCrease() {
    return WithHoles(WithCrease(Torus(6, 5), {0, 1, 2, 3, 4, 0}, 2.7f, ""), {0, 6, 7},
                     "holes next to a crease");
}

Cage HoleBySharpCrease() {
    return WithHoles(WithCrease(Sheet(4), {5, 6, 7, 8, 9}, 10, ""), {5},
                     "hole next to a sharp crease");
}

/// Creases, corners and a hole on an n-gon mesh.
Cage Everything() {
    Cage cage = WithHoles(Drum(5), {1}, "drum with everything");
    AddCrease(&cage, {1, 3, 5}, 1.5f);
    AddCrease(&cage, {5, 7}, 10);
    AddCrease(&cage, {0, 2}, 0.3f);
    AddCorner(&cage, 9, 2.7f);
    AddCorner(&cage, 4, 10);
    cage.mesh.leftHanded = true;
    return cage;
}

Cage SheetWithEverything(BoundaryRule rule, const std::string& name) {
    Cage cage = WithBoundary(Sheet(4), rule, name);
    AddCrease(&cage, {5, 6, 7, 12}, 1.5f);
    AddCrease(&cage, {12, 17, 22}, 10);
    AddCrease(&cage, {12, 13}, 0.4f);
    AddCorner(&cage, 18, 3.3f);
    AddCorner(&cage, 2, 1.1f);
    cage.mesh.holeIndices = {3, 10};
    cage.mesh.creaseRule = CreaseRule::Chaikin;
    return cage;
}

}  // namespace

std::vector<Cage> CombinedCages() {
    Cage smooth = WithCrease(Tetrahedron(), {0, 1, 2}, 1.5f, "smooth triangles with a crease");
    smooth.mesh.triangleRule = TriangleRule::Smooth;
    return {WithHoles(Cube(), {1}, "cube with a hole"),
            WithHoles(Torus(8, 6), {3, 9, 10}, "torus with holes"),
            WithHoles(Fan(5), {0, 7}, "hole at an extraordinary vertex"),
            WithHoles(Drum(6), {7}, "hole in place of an n-gon"),
            WithHoles(Sheet(3), {0, 4}, "holes at the boundary"),
            HoleByCrease(),
            HoleBySharpCrease(),
            Everything(),
            SheetWithEverything(BoundaryRule::EdgeAndCorner, "sheet with everything"),
            SheetWithEverything(BoundaryRule::EdgeOnly, "sheet with everything edgeOnly"),
            SheetWithEverything(BoundaryRule::None, "sheet with everything none"),
            smooth,
            WithCorner(WithCrease(Fan(7), {1, 0, 5}, 3.4f, ""), 0, 1.2f,
                       "crease and corner at valence 7"),
            WithCrease(WithBoundary(Fan(4), BoundaryRule::EdgeOnly, ""), {0, 1, 9}, 1.5f,
                       "crease from the centre to an edgeOnly boundary")};
}

}  // namespace cc::test
