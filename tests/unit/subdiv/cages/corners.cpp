#include "tests/unit/subdiv/cageKit.h"

namespace cc::test {

std::vector<Cage> CornerCages() {
    std::vector<Cage> cages;
    cages.push_back(WithCorner(Roof(), 12, 2.2f, "sheet, corner 2.2"));
    cages.push_back(WithCorner(Roof(), 12, 0.5f, "sheet, corner 0.5"));
    cages.push_back(WithCorner(Roof(), 12, 10, "sheet, sharp corner"));
    cages.push_back(WithCorner(Cube(), 3, 1.5f, "cube, corner 1.5"));
    cages.push_back(WithCorner(Cube(), 3, 10, "cube, sharp corner"));
    cages.push_back(WithCorner(Fan(6), 0, 2.7f, "valence 6, corner 2.7"));
    cages.push_back(WithCorner(Fan(6), 0, 10, "valence 6, sharp corner"));
    cages.push_back(WithCorner(Sheet(3), 1, 10, "sharp corner on the boundary"));
    cages.push_back(WithCorner(Sheet(3), 1, 1.5f, "corner 1.5 on the boundary"));
    cages.push_back(WithCorner(WithBoundary(Sheet(3), BoundaryRule::EdgeOnly, ""), 0, 2.5f,
                               "edgeOnly, corner 2.5 where the sheet ends"));
    cages.push_back(WithCorner(Tetrahedron(), 0, 4, "tetrahedron, corner 4"));
    cages.push_back(WithCorner(Drum(5), 0, 0.3f, "drum, corner 0.3"));
    for (float crease : {1.5f, 10.0f}) {
        for (float corner : {0.5f, 2.7f, 10.0f}) {
            const std::string text = std::to_string(static_cast<int>(10 * corner)) + " tenths on " +
                                     (crease < 10 ? "a crease" : "a sharp crease");
            cages.push_back(WithCorner(WithCrease(Roof(), {10, 11, 12, 13, 14}, crease, ""), 12,
                                       corner, "corner of " + text));
        }
    }
    cages.push_back(WithCorner(WithCrease(Roof(), {10, 11, 12}, 2.7f, ""), 12, 1.2f,
                               "corner at the end of a crease"));
    return cages;
}

}  // namespace cc::test
