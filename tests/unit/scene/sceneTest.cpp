#include "core/scene/scene.h"

#include <algorithm>
#include <optional>

#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include "tests/unit/render/renderTestKit.h"

namespace cc::test {
namespace {

std::vector<std::string> ShownNames(const Scene& scene) {
    std::vector<std::string> names;
    for (uint32_t i = 0; i < scene.Instances().Instances().size(); ++i) {
        names.push_back(scene.InstanceShape(i).Name());
    }
    return names;
}

using Names = std::vector<std::string>;

TEST(Scene, OrdersMeshesByNameWhateverThreadAddedThem) {
    Scene scene;
    tbb::parallel_for(0, 50,
                      [&](int i) { AddCage(&scene, "/mesh" + std::to_string(99 - i), Square()); });
    EXPECT_TRUE(scene.Build({"geometry"}).empty());
    const Names names = ShownNames(scene);
    EXPECT_EQ(names.size(), 50u);
    EXPECT_TRUE(std::is_sorted(names.begin(), names.end()));
}

TEST(Scene, OrdersLightsByWhatTheyAre) {
    Scene a, b;
    for (int i = 0; i < 4; ++i) {
        a.AddLight()->power = {float(i), 0, 0};
        b.AddLight()->power = {float(3 - i), 0, 0};
    }
    a.Build({});
    b.Build({});
    for (int i = 0; i < 4; ++i) {
        EXPECT_EQ(a.Lights()[i]->power, b.Lights()[i]->power);
    }
}

TEST(Scene, WarningsComeInTheOrderOfNames) {
    Scene scene;
    for (const char* name : {"/d", "/a", "/c", "/b"}) {
        AddCage(&scene, name, Square())->SetPoints({});
    }
    const Names lines = scene.Build({"geometry"});
    ASSERT_EQ(lines.size(), 4u);
    EXPECT_TRUE(std::is_sorted(lines.begin(), lines.end()));
    EXPECT_TRUE(scene.Build({"geometry"}).empty());
}

TEST(Scene, DoesOnlyWhatChangesAskFor) {
    Scene scene;
    Mesh* a = AddCage(&scene, "/a", Cube());
    AddCage(&scene, "/b", Cube());
    const auto expectWork = [&](size_t built, size_t moved, size_t topLevels) {
        EXPECT_TRUE(scene.Build({"geometry"}).empty());
        const Scene::Statistics work = scene.GetStatistics();
        EXPECT_EQ(work.surfacesBuilt, built);
        EXPECT_EQ(work.surfacesMoved, moved);
        EXPECT_EQ(work.topLevelsBuilt, topLevels);
    };
    expectWork(2, 0, 1);
    expectWork(2, 0, 1);
    a->SetPoints(Cube().points);
    expectWork(2, 0, 1);
    std::vector<Vec3f> moved = Cube().points;
    moved[0].x += 1;
    a->SetPoints(moved);
    expectWork(2, 1, 2);
    a->SetTransform(Placed(1, 5, 0, 0));
    expectWork(2, 1, 3);
    a->SetTransform(Placed(1, 5, 0, 0));
    expectWork(2, 1, 3);
    a->SetPrimvar("displayColor", ConstantColor({1, 0, 0}));
    a->SetPrimId(4);
    a->SetCulled(CulledSide::Back);
    expectWork(2, 1, 3);
    a->SetVisible(false);
    expectWork(2, 1, 4);
    a->SetVisible(true);
    expectWork(2, 1, 5);
    a->SetTopology(Cube().mesh);
    expectWork(3, 1, 6);
    scene.RemoveShape(a);
    expectWork(3, 1, 7);
    EXPECT_EQ(ShownNames(scene), Names{"/b"});
}

TEST(Scene, TessellatesWhatIsShownIfAsked) {
    Scene scene;
    Mesh* a = AddCage(&scene, "/a", Cube());
    Mesh* b = AddCage(&scene, "/b", Square());
    b->SetVisible(false);
    const auto bytesAt = [&](std::optional<int> level) {
        EXPECT_TRUE(scene.Build({"geometry"}, level).empty());
        return scene.GetStatistics().tessellationBytes;
    };
    EXPECT_EQ(bytesAt(std::nullopt), 0u);
    const size_t direct = scene.GetStatistics().bytes;
    const size_t atThree = bytesAt(3);
    // A point takes 12 bytes, and there is one for each quad and more.
    EXPECT_GT(atThree, 12u * 6 * 64);
    EXPECT_EQ(scene.GetStatistics().bytes, direct + atThree);
    EXPECT_EQ(atThree, a->BuiltSurface()->TessellationBytes());

    const Tessellation* made = &a->BuiltSurface()->TessellationAt(3);
    EXPECT_EQ(bytesAt(3), atThree);
    EXPECT_EQ(&a->BuiltSurface()->TessellationAt(3), made) << "nothing has changed";
    EXPECT_GT(bytesAt(5), 12 * atThree);

    b->SetVisible(true);
    const size_t both = bytesAt(3);
    EXPECT_EQ(both, atThree + b->BuiltSurface()->TessellationBytes());
    EXPECT_GT(both, atThree);
    a->SetVisible(false);
    EXPECT_EQ(bytesAt(3), both - atThree);
    EXPECT_EQ(a->BuiltSurface()->TessellationBytes(), 0u) << "hidden meshes give theirs back";
    EXPECT_EQ(bytesAt(std::nullopt), 0u);
    EXPECT_EQ(b->BuiltSurface()->TessellationBytes(), 0u);
}

TEST(Scene, TransformsReachTheTopLevel) {
    Scene scene;
    Mesh* mesh = AddCage(&scene, "/a", Square());
    scene.Build({"geometry"});
    mesh->SetTransform(Placed(2, 10, 0, 0));
    scene.Build({"geometry"});
    EXPECT_NEAR(scene.Instances().Bounds().lower.x, 8, 1e-3f);
    EXPECT_NEAR(scene.Instances().Bounds().upper.x, 12, 1e-3f);
    const Instance& instance = scene.Instances().Instances()[0];
    EXPECT_NEAR(instance.worldToObject.Point({12, 0, 0}).x, 1, 1e-6f);
}

TEST(Scene, ShowsTheRenderTagsThatAreAskedFor) {
    Scene scene;
    AddCage(&scene, "/default", Square());
    AddCage(&scene, "/guide", Square())->SetRenderTag("guide");
    AddCage(&scene, "/proxy", Square())->SetRenderTag("proxy");
    scene.Build({"geometry", "proxy"});
    EXPECT_EQ(ShownNames(scene), (Names{"/default", "/proxy"}));
    scene.Build({"guide"});
    EXPECT_EQ(ShownNames(scene), Names{"/guide"});
    scene.Build({});
    EXPECT_EQ(ShownNames(scene), (Names{"/default", "/guide", "/proxy"}));
}

TEST(Scene, HiddenMeshesAreBuiltWhenTheyShow) {
    Scene scene;
    Mesh* mesh = AddCage(&scene, "/a", Square());
    mesh->SetVisible(false);
    scene.Build({"geometry"});
    EXPECT_EQ(scene.GetStatistics().surfacesBuilt, 0u);
    mesh->SetVisible(true);
    scene.Build({"geometry"});
    EXPECT_EQ(ShownNames(scene), Names{"/a"});
}

TEST(Scene, CountsWhatIsBuilt) {
    Scene scene;
    AddCage(&scene, "/a", Cube());
    AddCage(&scene, "/b", Square());
    scene.Build({"geometry"});
    const Scene::Statistics statistics = scene.GetStatistics();
    EXPECT_EQ(statistics.faces, 7u);
    EXPECT_GE(statistics.patches, 7u);
    EXPECT_GT(statistics.bytes, 0u);
    EXPECT_GT(statistics.buildSeconds, 0);
}

TEST(Scene, RemovesOnlyWhatIsNamed) {
    Scene scene;
    Light* a = scene.AddLight();
    Light* b = scene.AddLight();
    scene.RemoveLight(a);
    ASSERT_EQ(scene.Lights().size(), 1u);
    EXPECT_EQ(scene.Lights()[0].get(), b);
    scene.RemoveLight(nullptr);
    scene.RemoveShape(nullptr);
    EXPECT_EQ(scene.Lights().size(), 1u);
}

}  // namespace
}  // namespace cc::test
