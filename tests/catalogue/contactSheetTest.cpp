#include "tests/catalogue/contactSheet.h"

#include <fstream>
#include <iterator>
#include <set>

#include <gtest/gtest.h>

#include "tests/catalogue/labelFont.h"
#include "tests/catalogue/sheetCages.h"
#include "tests/catalogue/usdText.h"

namespace cc::test {
namespace {

constexpr size_t kFewestCages = 60;
constexpr size_t kMostBytes = 1'000'000;

std::vector<Cage> SheetCages() {
    std::string error;
    std::vector<Cage> cages;
    for (const SheetTheme& theme : SheetThemes(&error)) {
        cages.insert(cages.end(), theme.cages.begin(), theme.cages.end());
    }
    EXPECT_EQ(error, "") << "is not in the catalogue";
    return cages;
}

TEST(ContactSheet, SceneIsWhatTheCommandMakes) {
    std::ifstream file(CC_CONTACT_SHEET, std::ios::binary);
    ASSERT_TRUE(file) << CC_CONTACT_SHEET;
    const std::string kept{std::istreambuf_iterator<char>(file), {}};
    std::string error;
    const std::string made = ContactSheet(&error);
    ASSERT_EQ(error, "");
    EXPECT_LT(made.size(), kMostBytes);
    EXPECT_TRUE(made == kept) << "make it anew: cc_catalogue " << CC_CONTACT_SHEET;
}

TEST(ContactSheet, ShowsCagesUnderNamesOfTheirOwn) {
    const std::vector<Cage> cages = SheetCages();
    EXPECT_GE(cages.size(), kFewestCages);
    std::set<std::string> prims;
    for (const Cage& cage : cages) {
        EXPECT_TRUE(prims.insert(PrimName(cage.name)).second) << cage.name;
        EXPECT_EQ(cage.mesh.creaseRule, CreaseRule::Uniform) << cage.name << ": USD cannot say it";
        for (const char letter : cage.name) {
            EXPECT_TRUE(HasLetter(letter)) << cage.name << ": no letter " << letter;
        }
    }
}

TEST(ContactSheet, ShowsEveryTag) {
    std::set<Scheme> schemes;
    std::set<BoundaryRule> boundaryRules;
    std::set<TriangleRule> triangleRules;
    bool hasHoles = false, hasCreases = false, hasCorners = false, isLeftHanded = false;
    for (const Cage& cage : SheetCages()) {
        schemes.insert(cage.mesh.scheme);
        boundaryRules.insert(cage.mesh.boundaryRule);
        triangleRules.insert(cage.mesh.triangleRule);
        hasHoles = hasHoles || !cage.mesh.holeIndices.empty();
        hasCreases = hasCreases || !cage.mesh.creaseIndices.empty();
        hasCorners = hasCorners || !cage.mesh.cornerIndices.empty();
        isLeftHanded = isLeftHanded || cage.mesh.leftHanded;
    }
    EXPECT_EQ(schemes.size(), 4u);
    EXPECT_EQ(boundaryRules.size(), 3u);
    EXPECT_EQ(triangleRules.size(), 2u);
    EXPECT_TRUE(hasHoles && hasCreases && hasCorners && isLeftHanded);
}

TEST(UsdText, WritesTagsAsTheyAre) {
    std::string error;
    for (const SheetTheme& theme : SheetThemes(&error)) {
        for (const Cage& cage : theme.cages) {
            if (cage.name != "drum with everything") {
                continue;
            }
            const std::string text = MeshPrim(cage, "Drum", {}, {1, 1, 1}, "");
            for (const char* attribute :
                 {"token subdivisionScheme = \"catmullClark\"",
                  "token interpolateBoundary = \"edgeAndCorner\"",
                  "token faceVaryingLinearInterpolation = \"cornersPlus1\"",
                  "token orientation = \"leftHanded\"", "int[] holeIndices = [1]",
                  "int[] creaseIndices = [1, 3, 5, 5, 7, 0, 2]", "int[] creaseLengths = [3, 2, 2]",
                  "float[] creaseSharpnesses = [1.5, 10, 0.3]", "int[] cornerIndices = [9, 4]",
                  "float[] cornerSharpnesses = [2.7, 10]"}) {
                EXPECT_NE(text.find(attribute), std::string::npos) << attribute;
            }
            return;
        }
    }
    FAIL() << "the drum is not on the sheet";
}

TEST(UsdText, BringsFloatsBack) {
    for (const float value : {0.0f, 1.0f, -0.1f, 1.0f / 3, 1e-20f, 123456.789f, 16777215.0f}) {
        EXPECT_EQ(std::stof(ToText(value)), value);
    }
}

TEST(LabelFont, StrokesDoNotOverlapAndStayInTheLetter) {
    for (const char letter : std::string("ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789,.-")) {
        std::set<std::pair<int, int>> dots;
        for (const LetterStroke& stroke : StrokesOf(letter)) {
            for (int i = 0; i < stroke.columns * stroke.rows; ++i) {
                const int column = stroke.column + i % stroke.columns;
                const int row = stroke.row + i / stroke.columns;
                EXPECT_TRUE(dots.insert({column, row}).second) << letter;
                EXPECT_LT(column, kLetterColumns - 1) << letter;
                EXPECT_LT(row, kLineRows) << letter;
            }
        }
        EXPECT_FALSE(dots.empty()) << letter;
    }
    EXPECT_TRUE(StrokesOf(' ').empty());
    EXPECT_FALSE(HasLetter('#'));
}

TEST(LabelFont, BreaksLinesBetweenWords) {
    EXPECT_EQ(BreakLines("a bc def", 4), (std::vector<std::string>{"a bc", "def"}));
    EXPECT_EQ(BreakLines("a bc def", 5), (std::vector<std::string>{"a bc", "def"}));
    EXPECT_EQ(BreakLines("abcdef g", 3), (std::vector<std::string>{"abcdef", "g"}));
}

}  // namespace
}  // namespace cc::test
