#include "tests/unit/subdiv/testCages.h"

#include <cctype>
#include <cmath>

#include "tests/unit/subdiv/cageKit.h"

namespace cc::test {
namespace {

constexpr float kTwoPi = 6.28318530718f;

}  // namespace

Cage Cube() {
    Cage cage;
    cage.name = "cube";
    for (int i = 0; i < 8; ++i) {
        cage.points.push_back({i & 1 ? 1.0f : -1.0f, i & 2 ? 1.0f : -1.0f, i & 4 ? 1.0f : -1.0f});
    }
    AddFace(&cage, {0, 2, 3, 1});
    AddFace(&cage, {4, 5, 7, 6});
    AddFace(&cage, {0, 1, 5, 4});
    AddFace(&cage, {2, 6, 7, 3});
    AddFace(&cage, {0, 4, 6, 2});
    AddFace(&cage, {1, 3, 7, 5});
    return cage;
}

Cage Sheet(int n) {
    Cage cage;
    cage.name = "sheet";
    for (int y = 0; y <= n; ++y) {
        for (int x = 0; x <= n; ++x) {
            cage.points.push_back({static_cast<float>(x), static_cast<float>(y),
                                   0.4f * std::sin(1.7f * x) * std::cos(2.3f * y)});
        }
    }
    for (int y = 0; y < n; ++y) {
        for (int x = 0; x < n; ++x) {
            const int a = y * (n + 1) + x;
            AddFace(&cage, {a, a + 1, a + n + 2, a + n + 1});
        }
    }
    return cage;
}

Cage Torus(int around, int across) {
    Cage cage;
    cage.name = "torus";
    for (int i = 0; i < around; ++i) {
        for (int j = 0; j < across; ++j) {
            const float a = kTwoPi * i / around, b = kTwoPi * j / across;
            const float radius = 2 + 0.7f * std::cos(b);
            cage.points.push_back({radius * std::cos(a), radius * std::sin(a), 0.7f * std::sin(b)});
        }
    }
    for (int i = 0; i < around; ++i) {
        for (int j = 0; j < across; ++j) {
            const int i1 = (i + 1) % around, j1 = (j + 1) % across;
            AddFace(&cage, {i * across + j, i1 * across + j, i1 * across + j1, i * across + j1});
        }
    }
    return cage;
}

Cage Tetrahedron() {
    Cage cage;
    cage.name = "tetrahedron";
    cage.points = {{1, 1, 1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}};
    AddFace(&cage, {0, 1, 3});
    AddFace(&cage, {0, 2, 1});
    AddFace(&cage, {0, 3, 2});
    AddFace(&cage, {1, 2, 3});
    return cage;
}

Cage Fan(int valence) {
    Cage cage;
    cage.name = "fan" + std::to_string(valence);
    // Rings of 2 * valence points at radii 1 and 2; quads of the inner fan meet in the centre.
    const int ring = 2 * valence;
    cage.points.push_back({0, 0, 0.5f});
    for (int r = 1; r <= 2; ++r) {
        for (int i = 0; i < ring; ++i) {
            const float angle = kTwoPi * i / ring;
            cage.points.push_back(
                {r * std::cos(angle), r * std::sin(angle), 0.1f * std::sin(3.1f * i) - 0.2f * r});
        }
    }
    for (int i = 0; i < valence; ++i) {
        AddFace(&cage, {0, 1 + 2 * i, 2 + 2 * i, 1 + (2 * i + 2) % ring});
    }
    for (int i = 0; i < ring; ++i) {
        const int next = (i + 1) % ring;
        AddFace(&cage, {1 + i, 1 + ring + i, 1 + ring + next, 1 + next});
    }
    return cage;
}

Cage Drum(int sides) {
    Cage cage;
    cage.name = "drum" + std::to_string(sides);
    std::vector<int> bottom, top;
    for (int i = 0; i < sides; ++i) {
        const float angle = kTwoPi * i / sides;
        for (int z = 0; z < 2; ++z) {
            cage.points.push_back(
                {std::cos(angle), std::sin(angle), z + 0.1f * std::sin(2.7f * i)});
        }
        bottom.insert(bottom.begin(), 2 * i);
        top.push_back(2 * i + 1);
    }
    for (int i = 0; i < sides; ++i) {
        const int next = (i + 1) % sides;
        AddFace(&cage, {2 * i, 2 * next, 2 * next + 1, 2 * i + 1});
    }
    AddFace(&cage, bottom);
    AddFace(&cage, top);
    return cage;
}

void PrintTo(const Cage& cage, std::ostream* out) { *out << cage.name; }

std::string TestName(const testing::TestParamInfo<Cage>& info) {
    std::string name;
    for (char c : info.param.name) {
        if (isalnum(static_cast<unsigned char>(c))) {
            name += c;
        }
    }
    return name + std::to_string(info.index);
}

std::vector<Cage> Catalogue() {
    std::vector<Cage> cages;
    for (const auto& theme :
         {ShapeCages(), BoundaryCages(), CreaseCages(), CreaseMeetingCages(), CornerCages(),
          NonManifoldCages(), CombinedCages(), LoopShapeCages(), LoopTagCages()}) {
        cages.insert(cages.end(), theme.begin(), theme.end());
    }
    return cages;
}

std::vector<Cage> AllCages() {
    std::vector<Cage> cages = Catalogue();
    for (const Cage& cage : KnownDifferences()) {
        cages.push_back(cage);
    }
    return cages;
}

}  // namespace cc::test
