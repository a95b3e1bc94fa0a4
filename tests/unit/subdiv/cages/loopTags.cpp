#include "tests/unit/subdiv/cageKit.h"

namespace cc::test {
namespace {

std::string Text(float sharpness) {
    std::string text = std::to_string(sharpness);
    return text.substr(0, text.find('.') + 2);
}

Cage Loop(Cage cage) {
    cage.mesh.scheme = Scheme::Loop;
    return cage;
}

Cage Chaikin(Cage cage, const std::string& name) {
    cage.mesh.creaseRule = CreaseRule::Chaikin;
    return Named(std::move(cage), name);
}

std::vector<Cage> BoundaryLoopCages() {
    std::vector<Cage> cages;
    const std::pair<BoundaryRule, std::string> rules[] = {{BoundaryRule::None, "none"},
                                                          {BoundaryRule::EdgeOnly, "edgeOnly"}};
    for (const auto& [rule, name] : rules) {
        cages.push_back(WithBoundary(TriangleSheet(4), rule, "loop sheet, " + name));
        cages.push_back(WithBoundary(TriangleFan(7), rule, "loop fan, " + name));
    }
    for (int faceCount : {1, 2, 3, 4, 7}) {
        cages.push_back(WithBoundary(OpenTriangleFan(faceCount), BoundaryRule::EdgeOnly,
                                     "loop open fan, edgeOnly " + std::to_string(faceCount)));
    }
    cages.push_back(WithHoles(TriangleSheet(4), {9, 12, 13, 12}, "loop sheet, holes"));
    cages.push_back(WithHoles(LoopIcosahedron(), {0, 3}, "loop icosahedron, holes"));
    return cages;
}

std::vector<Cage> CreaseLoopCages() {
    std::vector<Cage> cages;
    for (float sharpness : {0.3f, 1.0f, 1.5f, 2.7f, 9.9f, 10.0f}) {
        const std::string text = Text(sharpness);
        cages.push_back(WithCrease(TriangleTorus(6, 5), {0, 1, 2, 3, 4, 0}, sharpness,
                                   "loop torus, crease " + text));
        cages.push_back(WithCrease(LoopIcosahedron(), {2, 4, 6, 8, 10, 2}, sharpness,
                                   "loop icosahedron, crease " + text));
        cages.push_back(
            WithCrease(TriangleSheet(4), {6, 7, 8}, sharpness, "loop sheet, darts " + text));
        cages.push_back(
            WithCorner(LoopOctahedron(), 4, sharpness, "loop octahedron, corner " + text));
    }
    cages.push_back(WithCrease(TriangleSheet(4), {5, 6, 7, 8, 9}, 10, "loop sheet, sharp across"));
    cages.push_back(WithCrease(TriangleSheet(4), {5, 6, 7, 8, 9}, 1.5f, "loop sheet, 1.5 across"));
    cages.push_back(WithCrease(TriangleSheet(3), {0, 1, 2, 3}, 2.7f, "loop sheet, along boundary"));
    cages.push_back(WithCrease(TriangleSheet(4), {6, 7, 12, 11, 6}, 10, "loop sheet, sharp loop"));
    cages.push_back(WithCrease(TriangleFan(9), {10, 1, 0, 5, 14}, 10, "loop fan 9, sharp across"));
    cages.push_back(WithCrease(TriangleFan(5), {0, 2}, 10, "loop fan 5, sharp dart"));
    cages.push_back(WithCrease(TriangleFan(8), {0, 3}, 2.2f, "loop fan 8, dart 2.2"));
    return cages;
}

std::vector<Cage> MeetingLoopCages() {
    Cage cross =
        WithCrease(TriangleSheet(4), {10, 11, 12, 13, 14}, 1.6f, "loop creases that cross");
    AddCrease(&cross, {2, 7, 12, 17, 22}, 2.3f);
    Cage sharpCross = WithCrease(TriangleSheet(4), {10, 11, 12, 13, 14}, 10, "loop sharp cross");
    AddCrease(&sharpCross, {2, 7, 12, 17, 22}, 10);
    Cage mixed = WithCrease(TriangleSheet(4), {10, 11, 12, 13, 14}, 10, "loop sharp and 1.4 cross");
    AddCrease(&mixed, {2, 7, 12, 17, 22}, 1.4f);
    Cage three =
        WithCrease(LoopIcosahedron(), {0, 2}, 10, "loop icosahedron, three sharp creases meet");
    AddCrease(&three, {0, 6}, 10);
    AddCrease(&three, {0, 8}, 10);
    Cage bend = WithCrease(LoopOctahedron(), {0, 4, 2}, 10, "loop octahedron, sharp bend and 0.7");
    AddCrease(&bend, {1, 5}, 0.7f);
    Cage steps = Named(TriangleTorus(8, 6), "loop torus, sharpness by edge");
    steps.mesh.creaseIndices = {0, 1, 2, 3, 4, 5, 0};
    steps.mesh.creaseLengths = {7};
    steps.mesh.creaseSharpnesses = {0.3f, 1.5f, 10, 4, 0, 2};
    return {cross,
            sharpCross,
            mixed,
            three,
            bend,
            steps,
            Chaikin(steps, "loop torus, Chaikin by edge"),
            Chaikin(cross, "loop Chaikin creases that cross"),
            Chaikin(WithCrease(LoopIcosahedron(), {2, 4, 6, 8}, 2.7f, ""),
                    "loop icosahedron, Chaikin")};
}

std::vector<Cage> NonManifoldLoopCages() {
    const Cage fin = Loop(FromFaces("loop, three wings", {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}));
    const Cage bowTie = Loop(FromFaces("loop bow tie", {{0, 1, 2}, {0, 2, 3}, {0, 4, 5}}));
    const Cage flipped =
        Loop(FromFaces("loop neighbours that disagree", {{0, 1, 2}, {0, 1, 3}, {2, 1, 4}}));
    Cage twice = Named(TriangleSheet(3), "loop, the same face twice");
    AddFace(&twice, {0, 1, 5});
    Cage book = Named(LoopOctahedron(), "loop octahedron with a wall inside");
    AddFace(&book, {0, 2, 1});
    Cage joint = Loop(
        FromFaces("loop, crossing sheets",
                  {{0, 1, 3}, {1, 4, 3}, {1, 2, 4}, {1, 0, 5}, {2, 1, 5}, {0, 1, 6}, {1, 2, 6}},
                  {{-1, 0, 0},
                   {0, 0, 0.2f},
                   {1, 0, 0},
                   {-0.6f, 1.1f, -0.2f},
                   {0.6f, 1.1f, -0.2f},
                   {0, -1.2f, -0.2f},
                   {0, 0.1f, 1.2f}}));
    return {fin,
            bowTie,
            flipped,
            twice,
            book,
            joint,
            WithBoundary(fin, BoundaryRule::EdgeOnly, "loop, three wings, edgeOnly"),
            WithBoundary(joint, BoundaryRule::EdgeOnly, "loop, crossing sheets, edgeOnly"),
            WithCrease(joint, {1, 4}, 1.7f, "loop, crossing sheets, crease into the joint")};
}

std::vector<Cage> CombinedLoopCages() {
    Cage all = WithBoundary(TriangleSheet(5), BoundaryRule::EdgeOnly, "loop, all tags at once");
    AddCrease(&all, {6, 7, 8, 9}, 3.3f);
    AddCrease(&all, {9, 15, 21, 27}, 10);
    AddCorner(&all, 14, 1.8f);
    AddCorner(&all, 0, 10);
    all.mesh.holeIndices = {24};
    all.mesh.leftHanded = true;
    Cage fan = WithCrease(TriangleFan(7), {8, 1, 0}, 1.2f, "loop fan 7, crease, corner and hole");
    AddCorner(&fan, 0, 0.6f);
    fan.mesh.holeIndices = {1};
    return {all, fan,
            WithCorner(WithCrease(TriangleFan(9), {10, 1, 0, 5, 14}, 2.5f, ""), 0, 1.5f,
                       "loop fan 9, crease and corner"),
            WithCorner(OpenTriangleFan(4), 0, 1.3f, "loop open fan, corner 1.3 of many faces"),
            WithCorner(OpenTriangleFan(4), 0, 10, "loop open fan, sharp corner of many faces")};
}

}  // namespace

std::vector<Cage> LoopTagCages() {
    std::vector<Cage> cages;
    for (const auto& theme : {BoundaryLoopCages(), CreaseLoopCages(), MeetingLoopCages(),
                              NonManifoldLoopCages(), CombinedLoopCages()}) {
        cages.insert(cages.end(), theme.begin(), theme.end());
    }
    return cages;
}

}  // namespace cc::test
