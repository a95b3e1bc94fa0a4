#include "tests/catalogue/sheetCages.h"

#include <map>

#include "tests/unit/subdiv/cageKit.h"

namespace cc::test {
namespace {

using Names = std::vector<std::string>;

/// Finds cages of the catalogue by name.
class CageFinder {
  public:
    explicit CageFinder(std::string* error) : _error(error) {
        for (const std::vector<Cage>& cages : {Catalogue(), KnownDifferences()}) {
            for (const Cage& cage : cages) {
                _cages.emplace(cage.name, cage);
            }
        }
    }

    Cage Find(const std::string& name) const {
        const auto found = _cages.find(name);
        if (found == _cages.end()) {
            *_error = name;
            return {};
        }
        return found->second;
    }

    std::vector<Cage> Find(const Names& names) const {
        std::vector<Cage> cages;
        for (const std::string& name : names) {
            cages.push_back(Find(name));
        }
        return cages;
    }

  private:
    std::string* _error;
    std::map<std::string, Cage> _cages;
};

const Names kShapes{"cube",
                    "torus",
                    "sheet",
                    "tetrahedron",
                    "fan3",
                    "fan5",
                    "fan9",
                    "fan17",
                    "drum5",
                    "drum30",
                    "triangle star5",
                    "fan of 3 4 5 and 6 corners",
                    "valence 2",
                    "two quads back to back",
                    "sheet with a collapsed edge",
                    "points that no face uses",
                    "left-handed drum",
                    "tetrahedron, smooth triangles"};

const Names kBoundaries{"one quad",
                        "one quad edgeOnly",
                        "one hexagon",
                        "one hexagon edgeOnly",
                        "frame",
                        "frame edgeOnly",
                        "open fan of 7",
                        "open fan of 7 edgeOnly",
                        "open fan of 3 with a corner",
                        "sheet edgeOnly",
                        "sheet none",
                        "fan5 none"};

const Names kCreases{"torus, crease 0.5",
                     "torus, crease 1.5",
                     "torus, crease 10.0",
                     "crease through valence 5, 2.7",
                     "sheet, sharp crease across",
                     "sheet, crease along the boundary",
                     "sheet, crease with a bend",
                     "sheet, sharp loop",
                     "drum, sharp lid",
                     "torus, sharpness by edge",
                     "cube, sharpness by edge"};

const Names kMeetings{"both ends dart sharp",
                      "dart at valence 5 2.7",
                      "cross 2.7",
                      "cross sharp",
                      "three at valence 3 sharp",
                      "tee 0.5",
                      "tee sharp",
                      "three at valence 6 2.7",
                      "cube, all edges sharp",
                      "sharp crease that ends on an n-gon"};

const Names kCorners{"sheet, corner 2.2",
                     "sheet, sharp corner",
                     "cube, sharp corner",
                     "sharp corner on the boundary",
                     "corner of 27 tenths on a crease",
                     "corner at the end of a crease"};

const Names kNonManifold{"three wings",
                         "three wings edgeOnly",
                         "three wings, crease on the joint",
                         "bow tie",
                         "wide bow tie, sharp crease",
                         "cube with a fin",
                         "cubes that touch in a vertex",
                         "neighbours that disagree",
                         "the middle face twice",
                         "sheet with a flap",
                         "tetrahedron with a fin",
                         "tubes on a crease"};

const Names kCombined{"cube with a hole",
                      "torus with holes",
                      "hole at an extraordinary vertex",
                      "hole in place of an n-gon",
                      "holes next to a crease",
                      "hole next to a sharp crease",
                      "drum with everything",
                      "crease and corner at valence 7"};

const Names kLoop{"loop tetrahedron",
                  "loop torus",
                  "loop sheet, 1.5 across",
                  "loop cube",
                  "loop fan9",
                  "loop open fan7",
                  "loop pillow of valence 2 and 4",
                  "loop sheet, none",
                  "loop sheet, holes",
                  "loop icosahedron, crease 2.7",
                  "loop octahedron, corner 10.0",
                  "loop creases that cross",
                  "loop, crossing sheets",
                  "loop octahedron with a wall inside",
                  "loop, all tags at once"};

std::vector<Cage> UnsmoothedCages(const CageFinder& finder) {
    const Cage drum = finder.Find("hole in place of an n-gon");
    const Cage fan = finder.Find("fan of 3 4 5 and 6 corners");
    return {WithScheme(drum, Scheme::Bilinear, "bilinear drum with a hole"),
            WithScheme(fan, Scheme::Bilinear, "bilinear fan of 3 to 6 corners"),
            WithScheme(drum, Scheme::None, "polygons, drum with a hole"),
            WithScheme(fan, Scheme::None, "polygons, fan of 3 to 6 corners")};
}

}  // namespace

bool IsSeenFromBelow(const Cage& cage) {
    return cage.name == "sheet with a flap" || cage.name == "cube, sharp corner";
}

std::vector<SheetTheme> SheetThemes(std::string* error) {
    const CageFinder finder(error);
    return {{"shapes", {0.80f, 0.50f, 0.30f}, finder.Find(kShapes)},
            {"boundaries", {0.35f, 0.60f, 0.75f}, finder.Find(kBoundaries)},
            {"creases", {0.60f, 0.70f, 0.35f}, finder.Find(kCreases)},
            {"crease meetings", {0.40f, 0.70f, 0.55f}, finder.Find(kMeetings)},
            {"corners", {0.80f, 0.70f, 0.35f}, finder.Find(kCorners)},
            {"non-manifold", {0.80f, 0.42f, 0.42f}, finder.Find(kNonManifold)},
            {"holes and several tags", {0.70f, 0.45f, 0.70f}, finder.Find(kCombined)},
            {"loop", {0.45f, 0.52f, 0.85f}, finder.Find(kLoop)},
            {"bilinear and polygons", {0.65f, 0.65f, 0.65f}, UnsmoothedCages(finder)}};
}

}  // namespace cc::test
