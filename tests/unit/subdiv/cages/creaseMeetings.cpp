#include "tests/unit/subdiv/cageKit.h"

namespace cc::test {

std::vector<Cage> CreaseMeetingCages() {
    std::vector<Cage> cages;
    for (float sharpness : {0.5f, 2.7f, 10.0f}) {
        const std::string text = sharpness < 1 ? " 0.5" : sharpness < 10 ? " 2.7" : " sharp";
        cages.push_back(WithCrease(Roof(), {11, 12}, sharpness, "both ends dart" + text));
        cages.push_back(WithCrease(Roof(), {10, 11, 12}, sharpness, "dart" + text));
        cages.push_back(WithCrease(Fan(5), {11, 1, 0}, sharpness, "dart at valence 5" + text));
        cages.push_back(WithCrease(Fan(3), {0, 1}, sharpness, "dart at valence 3" + text));
        Cage cross = WithCrease(Roof(), {10, 11, 12, 13, 14}, sharpness, "cross" + text);
        AddCrease(&cross, {2, 7, 12, 17, 22}, 1.5f);
        cages.push_back(cross);
        Cage three = WithCrease(Cube(), {1, 0, 2}, sharpness, "three at valence 3" + text);
        AddCrease(&three, {0, 4}, sharpness);
        cages.push_back(three);
        Cage tee = WithCrease(Roof(), {10, 11, 12, 13, 14}, 10, "tee" + text);
        AddCrease(&tee, {12, 17, 22}, sharpness);
        cages.push_back(tee);
        Cage star = WithCrease(Fan(6), {1, 0, 5}, sharpness, "three at valence 6" + text);
        AddCrease(&star, {0, 9}, 10);
        cages.push_back(star);
    }
    Cage all = Named(Cube(), "cube, all edges sharp");
    for (const std::vector<int>& edge : std::vector<std::vector<int>>{
             {0, 1, 3, 2, 0}, {4, 5, 7, 6, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}) {
        AddCrease(&all, edge, 10);
    }
    cages.push_back(all);
    cages.push_back(WithCrease(Drum(5), {1, 3, 5}, 10, "sharp crease that ends on an n-gon"));
    cages.push_back(WithCrease(Tetrahedron(), {0, 1}, 10, "tetrahedron, sharp edge"));
    cages.push_back(WithCrease(Sheet(3), {5, 4}, 2.7f, "crease into the boundary 2.7"));
    cages.push_back(WithCrease(Sheet(3), {5, 4}, 10, "crease into the boundary sharp"));
    return cages;
}

}  // namespace cc::test
