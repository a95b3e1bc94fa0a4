#include "core/scene/faceMaterials.h"

#include <gtest/gtest.h>

#include "core/scene/scene.h"
#include "tests/unit/render/renderTestKit.h"

namespace cc::test {
namespace {

using Names = std::vector<std::string>;

TEST(FaceMaterials, AreThoseOfTheShapeUnlessASubsetHasOne) {
    std::string warning;
    const FaceMaterials none("", {}, 3, &warning), whole("/A", {}, 3, &warning);
    EXPECT_EQ(none.Names()[none.Of(2)], "");
    EXPECT_EQ(whole.Names()[whole.Of(2)], "/A");
    const FaceMaterials some("/A", {{"/B", {1, 1}}, {"/C", {0}}}, 3, &warning);
    EXPECT_EQ(warning, "");
    const char* const expected[] = {"/C", "/B", "/A"};
    for (uint32_t face = 0; face < 3; ++face) {
        EXPECT_EQ(some.Names()[some.Of(face)], expected[face]);
    }
}

TEST(FaceMaterials, SayWhichFacesAreNotTaken) {
    std::string warning;
    const FaceMaterials materials("", {{"/B", {0, -1, 7}}, {"/C", {0, 1}}}, 2, &warning);
    EXPECT_EQ(warning,
              "its subsets have 2 indices of faces that there are not, 1 faces that an earlier "
              "subset has; they are ignored");
    EXPECT_EQ(materials.Names()[materials.Of(0)], "/B");
    EXPECT_EQ(materials.Names()[materials.Of(1)], "/C");
}

TEST(FaceMaterials, AreNumberedOverTheScene) {
    Scene scene;
    Mesh* const a = AddCage(&scene, "/a", Cube());
    Mesh* const b = AddCage(&scene, "/b", Cube());
    a->SetMaterial("/Z");
    a->SetSubsets({{"/A", {2}}});
    b->SetSubsets({{"/Z", {1}}});
    EXPECT_TRUE(scene.Build({"geometry"}).empty());
    EXPECT_EQ(scene.MaterialNames(), (Names{"/A", "/Z"}));
    const auto of = [&](const Mesh* mesh, uint32_t face) {
        return scene.MaterialOf(&scene.InstanceShape(0) == mesh ? 0 : 1, face);
    };
    EXPECT_EQ(of(a, 0), 1);
    EXPECT_EQ(of(a, 2), 0);
    EXPECT_EQ(of(b, 0), -1);
    EXPECT_EQ(of(b, 1), 1);
}

TEST(FaceMaterials, EditsTouchNoSurface) {
    Scene scene;
    Mesh* const mesh = AddCage(&scene, "/mesh", Cube());
    scene.Build({"geometry"});
    const Scene::Statistics before = scene.GetStatistics();
    mesh->SetSubsets({{"/A", {2, 9}}});
    const Names lines = scene.Build({"geometry"});
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_EQ(lines[0].find("</mesh>: its subsets have 1 indices"), 0u);
    EXPECT_TRUE(scene.Build({"geometry"}).empty());
    const Scene::Statistics after = scene.GetStatistics();
    EXPECT_EQ(after.surfacesBuilt, before.surfacesBuilt);
    EXPECT_EQ(after.topLevelsBuilt, before.topLevelsBuilt);
    EXPECT_EQ(scene.MaterialOf(0, 2), 0);
    mesh->SetSubsets({});
    scene.Build({"geometry"});
    EXPECT_TRUE(scene.MaterialNames().empty());
    EXPECT_EQ(scene.MaterialOf(0, 2), -1);
}

}  // namespace
}  // namespace cc::test
