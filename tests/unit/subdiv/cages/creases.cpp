#include "tests/unit/subdiv/cageKit.h"

namespace cc::test {

namespace {

std::string Text(float sharpness) {
    std::string text = std::to_string(sharpness);
    return text.substr(0, text.find('.') + 2);
}

/// Sharpness one an edge instead of one a crease.
Cage WithSharpnesses(Cage cage, const std::vector<int>& vertices,
                     const std::vector<float>& sharpnesses, const std::string& name) {
    cage.mesh.creaseIndices = vertices;
    cage.mesh.creaseLengths = {static_cast<int>(vertices.size())};
    cage.mesh.creaseSharpnesses = sharpnesses;
    return Named(std::move(cage), name);
}

Cage Chaikin(Cage cage, const std::string& name) {
    cage.mesh.creaseRule = CreaseRule::Chaikin;
    return Named(std::move(cage), name);
}

std::vector<Cage> ChaikinCages() {
    Cage cube = Cube();
    AddCrease(&cube, {0, 1, 5}, 3);
    AddCrease(&cube, {5, 4, 0}, 1);
    Cage mixed = Torus(8, 6);
    AddCrease(&mixed, {0, 1, 2}, 10);
    AddCrease(&mixed, {2, 3}, 1.4f);
    AddCrease(&mixed, {3, 4}, 0.3f);
    AddCrease(&mixed, {4, 5, 0}, 2.9f);
    return {Chaikin(cube, "cube, Chaikin creases"), Chaikin(mixed, "torus, Chaikin with infinite"),
            Chaikin(WithCrease(Sheet(4), {5, 6, 7, 8, 9}, 2.7f, ""), "sheet, Chaikin to boundary")};
}

}  // namespace

std::vector<Cage> CreaseCages() {
    std::vector<Cage> cages;
    for (float sharpness : {0.3f, 0.5f, 1.0f, 1.5f, 2.7f, 4.0f, 9.9f, 10.0f}) {
        cages.push_back(WithCrease(Torus(6, 5), {0, 1, 2, 3, 4, 0}, sharpness,
                                   "torus, crease " + Text(sharpness)));
        cages.push_back(
            WithCrease(Cube(), {0, 1, 5, 4, 0}, sharpness, "cube, crease " + Text(sharpness)));
        cages.push_back(WithCrease(Fan(5), {11, 1, 0, 5, 15}, sharpness,
                                   "crease through valence 5, " + Text(sharpness)));
    }
    cages.push_back(WithCrease(Sheet(4), {5, 6, 7, 8, 9}, 100, "sheet, sharp crease across"));
    cages.push_back(WithCrease(Sheet(4), {5, 6, 7, 8, 9}, 1.5f, "sheet, crease 1.5 across"));
    cages.push_back(WithCrease(Sheet(3), {0, 1, 2, 3}, 2.7f, "sheet, crease along the boundary"));
    cages.push_back(WithCrease(Sheet(3), {0, 1, 2, 3}, 10, "sheet, sharp along the boundary"));
    cages.push_back(WithCrease(Sheet(3), {4, 5, 9, 13}, 2.2f, "sheet, crease with a bend"));
    cages.push_back(WithCrease(Sheet(4), {6, 7, 12, 11, 6}, 10, "sheet, sharp loop"));
    cages.push_back(WithCrease(Drum(6), {1, 3, 5, 7, 9, 11, 1}, 1.5f, "drum, crease about a lid"));
    cages.push_back(WithCrease(Drum(6), {1, 3, 5, 7, 9, 11, 1}, 10, "drum, sharp lid"));
    cages.push_back(WithCrease(Tetrahedron(), {0, 1, 2}, 0.5f, "tetrahedron, crease 0.5"));
    cages.push_back(WithSharpnesses(Torus(6, 5), {0, 1, 2, 3, 4, 0}, {0.3f, 1.5f, 10, 4, 0},
                                    "torus, sharpness by edge"));
    cages.push_back(
        WithSharpnesses(Cube(), {0, 1, 5, 4}, {2.7f, 0.5f, 1}, "cube, sharpness by edge"));
    for (const Cage& cage : ChaikinCages()) {
        cages.push_back(cage);
    }
    return cages;
}

}  // namespace cc::test
