#include "core/render/renderer.h"

#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

#include "tests/unit/render/renderTestKit.h"

namespace cc::test {
namespace {

RenderOptions Options(int samples = 1, int threads = 1, int seed = 0) {
    RenderOptions options;
    options.samples = samples;
    options.threads = threads;
    options.seed = seed;
    return options;
}

Film Render(Scene* scene, const Camera& camera, const RenderOptions& options = Options(),
            int width = 24, int height = 20) {
    scene->Build({"geometry"});
    Film film(width, height, kAllAovs);
    RenderStatistics statistics;
    EXPECT_TRUE(RenderFrame(scene, camera, options, &film, &statistics, nullptr, nullptr));
    return film;
}

/// Camera, a square before it and its blur.
Camera CameraOutOfFocus() {
    Camera camera = CameraAt(4);
    camera.lensRadius = 0.3f;
    camera.focusDistance = 2;
    return camera;
}

TEST(RenderFrame, ALensBlursColorAndNothingElse) {
    Scene scene;
    AddCage(&scene, "/square", Square());
    AddHeadlight(&scene);
    const Film sharp = Render(&scene, CameraAt(4), Options(16));
    const Film blurred = Render(&scene, CameraOutOfFocus(), Options(16));
    const size_t pixels = size_t(sharp.Width()) * sharp.Height();
    for (const Aov& aov : kAllAovs) {
        const size_t bytes = 4 * pixels * LayoutOf(aov).components;
        const bool isSame = LayoutOf(aov).isInteger
                                ? std::memcmp(sharp.Ints(aov), blurred.Ints(aov), bytes) == 0
                                : std::memcmp(sharp.Floats(aov), blurred.Floats(aov), bytes) == 0;
        EXPECT_EQ(isSame, aov.kind != Aov::Color) << int(aov.kind);
    }
}

TEST(RenderFrame, ColorThroughALensDoesNotDependOnOtherAovs) {
    Scene scene;
    AddCage(&scene, "/square", Square());
    AddHeadlight(&scene);
    const Film all = Render(&scene, CameraOutOfFocus(), Options(16));
    Film alone(24, 20, {Aov::Color});
    RenderStatistics statistics;
    RenderFrame(&scene, CameraOutOfFocus(), Options(16), &alone, &statistics, nullptr, nullptr);
    EXPECT_EQ(std::memcmp(all.Floats(Aov::Color), alone.Floats(Aov::Color), 16 * 24 * 20), 0);
}

TEST(RenderFrame, ALensGivesTheSameBitsForAnyThreads) {
    Scene scene;
    AddCage(&scene, "/square", Square());
    AddHeadlight(&scene);
    const std::string one = Bits(Render(&scene, CameraOutOfFocus(), Options(8, 1), 50, 40));
    EXPECT_EQ(one, Bits(Render(&scene, CameraOutOfFocus(), Options(8, 5), 50, 40)));
}

TEST(RenderFrame, ExposureScalesColorAndLeavesCoverage) {
    Scene scene;
    AddCage(&scene, "/square", Square());
    AddHeadlight(&scene);
    Camera camera = CameraAt(4);
    const Film plain = Render(&scene, camera, Options(4));
    camera.exposure = 0.25f;
    const Film darker = Render(&scene, camera, Options(4));
    for (int i = 0; i < 4 * 24 * 20; ++i) {
        const float before = plain.Floats(Aov::Color)[i];
        ASSERT_EQ(darker.Floats(Aov::Color)[i], i % 4 < 3 ? before / 4 : before);
    }
}

TEST(RenderFrame, RaysThatPassCulledFacesEndAtClipPlanes) {
    Scene scene;
    AddCage(&scene, "/turned", Reversed(Square()))->SetCulled(CulledSide::Back);
    Cage behind = Square();
    for (Vec3f& p : behind.points) {
        p = p * 10 - Vec3f{0, 0, 1};
    }
    AddCage(&scene, "/behind", behind);
    Camera camera = CameraAt(4);
    const int middle = 10 * 24 + 12;
    EXPECT_EQ(Render(&scene, camera).Floats(Aov::CameraDepth)[middle], 5);
    camera.clipPlanes = {{{0, 0, 1}, 4.5f}};
    EXPECT_EQ(Render(&scene, camera).Ints(Aov::PrimId)[middle], -1);
}

TEST(RenderFrame, PrimvarsAreThoseOfTheMeshThatIsSeen) {
    Scene scene;
    Mesh* mesh = AddCage(&scene, "/square", Square());
    mesh->SetPrimvar("st", {Interpolation::Vertex, 2, {0, 0, 1, 0, 1, 1, 0, 1}, {}});
    Cage behind = Square();
    for (Vec3f& p : behind.points) {
        p = p * 10 - Vec3f{0, 0, 1};
    }
    AddCage(&scene, "/behind", behind)->SetPrimvar("heat", {Interpolation::Constant, 1, {7}, {}});
    scene.Build({"geometry"});
    EXPECT_EQ(scene.PrimvarArity("st"), 2);
    EXPECT_EQ(scene.PrimvarArity("heat"), 1);
    EXPECT_EQ(scene.PrimvarArity("color"), 0);

    const Aov st(Aov::Primvar, "st", 2), heat(Aov::Primvar, "heat", 1);
    Film film(20, 20, {heat, st});
    RenderStatistics statistics;
    RenderFrame(&scene, CameraAt(4), Options(), &film, &statistics, nullptr, nullptr);
    for (int y = 0; y < 20; ++y) {
        for (int x = 0; x < 20; ++x) {
            const int i = y * 20 + x;
            const bool inside = x >= 5 && x < 15 && y >= 5 && y < 15;
            ASSERT_EQ(film.Coverage(st)[i], inside);
            ASSERT_EQ(film.Coverage(heat)[i], !inside);
            EXPECT_EQ(film.Floats(heat)[i], inside ? 0 : 7);
            const auto ramp = [](int at) { return (static_cast<float>(at) - 4.5f) / 10; };
            EXPECT_NEAR(film.Floats(st)[2 * i], inside ? ramp(x) : 0, 1e-5f);
            EXPECT_NEAR(film.Floats(st)[2 * i + 1], inside ? ramp(y) : 0, 1e-5f);
        }
    }
}

TEST(RenderFrame, ShowsASquareWhereItIs) {
    Scene scene;
    Mesh* mesh = AddCage(&scene, "/square", Square());
    mesh->SetPrimId(42);
    mesh->SetPrimvar("displayColor", ConstantColor({0.25f, 0.5f, 1}));
    AddHeadlight(&scene);
    // At distance 4 the window is 4 wide: the square of width 2 covers the middle quarter.
    const Film film = Render(&scene, CameraAt(4), Options(), 20, 20);
    const float depth = (1 / 0.1f - 1 / 4.0f) / (1 / 0.1f - 1 / 100.0f);
    for (int y = 0; y < 20; ++y) {
        for (int x = 0; x < 20; ++x) {
            const int i = y * 20 + x;
            const bool inside = x >= 5 && x < 15 && y >= 5 && y < 15;
            ASSERT_EQ(film.Ints(Aov::PrimId)[i], inside ? 42 : -1) << x << " " << y;
            EXPECT_EQ(film.Ints(Aov::InstanceId)[i], inside ? 0 : -1);
            EXPECT_EQ(film.Ints(Aov::ElementId)[i], inside ? 0 : -1);
            EXPECT_NEAR(film.Floats(Aov::Depth)[i], inside ? depth : 1, 1e-5f);
            EXPECT_NEAR(film.Floats(Aov::CameraDepth)[i], inside ? 4 : 0, 1e-5f);
            EXPECT_NEAR(film.Floats(Aov::Normal)[3 * i + 2], inside ? 1 : 0, 1e-5f);
            EXPECT_NEAR(film.Floats(Aov::Neye)[3 * i + 2], inside ? 1 : 0, 1e-5f);
            EXPECT_NEAR(film.Floats(Aov::Color)[4 * i], inside ? 0.25f : 0, 1e-5f);
            EXPECT_NEAR(film.Floats(Aov::Color)[4 * i + 2], inside ? 1 : 0, 1e-5f);
            EXPECT_EQ(film.Floats(Aov::Color)[4 * i + 3], inside ? 1 : 0);
        }
    }
}

TEST(RenderFrame, RowsGoUp) {
    Scene scene;
    AddCage(&scene, "/square", Square())->SetTransform(Placed(1, 1, 1, 0));
    const Film film = Render(&scene, CameraAt(4), Options(), 16, 16);
    EXPECT_EQ(film.Ints(Aov::PrimId)[0], -1);
    EXPECT_EQ(film.Ints(Aov::PrimId)[15], -1);
    EXPECT_EQ(film.Ints(Aov::PrimId)[16 * 10 + 10], 0);
}

TEST(RenderFrame, ElementsAreAuthoredFaces) {
    Scene scene;
    AddCage(&scene, "/drum", Drum(7));
    const Film film = Render(&scene, CameraAt(6), Options(), 32, 32);
    const int32_t faces = static_cast<int32_t>(Drum(7).mesh.faceVertexCounts.size());
    int seen = 0;
    for (int i = 0; i < 32 * 32; ++i) {
        const int32_t element = film.Ints(Aov::ElementId)[i];
        EXPECT_TRUE(element >= -1 && element < faces);
        EXPECT_EQ(element >= 0, film.Ints(Aov::PrimId)[i] >= 0);
        seen += element >= 0;
    }
    EXPECT_GT(seen, 20);
}

TEST(RenderFrame, IsTheSameForAnyNumberOfThreads) {
    Scene scene;
    AddCage(&scene, "/cube", Cube());
    AddCage(&scene, "/torus", Torus(9, 6))->SetTransform(Placed(0.3, 0.4, 0.2, 1));
    AddHeadlight(&scene);
    scene.AddLight()->kind = Light::Kind::Sphere;
    const std::string one = Bits(Render(&scene, CameraAt(5), Options(5, 1), 61, 43));
    EXPECT_EQ(one, Bits(Render(&scene, CameraAt(5), Options(5, 2), 61, 43)));
    EXPECT_EQ(one, Bits(Render(&scene, CameraAt(5), Options(5, 7), 61, 43)));
    EXPECT_EQ(one, Bits(Render(&scene, CameraAt(5), Options(5, 0), 61, 43)));
    EXPECT_NE(one, Bits(Render(&scene, CameraAt(5), Options(5, 1, 1), 61, 43)));
}

TEST(RenderFrame, TracersAgree) {
    Scene scene;
    AddCage(&scene, "/cube", Cube());
    const Film a = Render(&scene, CameraAt(5));
    for (const TracerKind kind :
         {TracerKind::Single, TracerKind::Algorithm1, TracerKind::Tessellated}) {
        RenderOptions options = Options();
        options.tracer = kind;
        const Film b = Render(&scene, CameraAt(5), options);
        for (int i = 0; i < a.Width() * a.Height(); ++i) {
            EXPECT_EQ(a.Ints(Aov::ElementId)[i], b.Ints(Aov::ElementId)[i]);
        }
    }
}

TEST(RenderFrame, IdsComeFromTheCenterAndColorFromAllSamples) {
    Scene scene;
    AddCage(&scene, "/square", Square());
    AddHeadlight(&scene);
    // The square's edge cuts the middle pixels; a quarter of the film lies behind it.
    const Film one = Render(&scene, CameraAt(4), Options(1), 21, 21);
    const Film many = Render(&scene, CameraAt(4), Options(256), 21, 21);
    double area = 0;
    for (int i = 0; i < 21 * 21; ++i) {
        EXPECT_EQ(one.Ints(Aov::PrimId)[i], many.Ints(Aov::PrimId)[i]);
        EXPECT_EQ(one.Floats(Aov::Depth)[i], many.Floats(Aov::Depth)[i]);
        area += many.Floats(Aov::Color)[4 * i + 3];
    }
    EXPECT_NEAR(area / (21 * 21), 0.25, 1e-3);
    EXPECT_NEAR(many.Floats(Aov::Color)[4 * (10 * 21 + 5) + 3], 0.75f, 0.01f);
}

TEST(RenderFrame, WithoutLightItIsBlackAndCovered) {
    Scene scene;
    AddCage(&scene, "/square", Square());
    const Film film = Render(&scene, CameraAt(2), Options(), 8, 8);
    for (int i = 0; i < 64; ++i) {
        EXPECT_EQ(film.Floats(Aov::Color)[4 * i], 0);
        EXPECT_EQ(film.Floats(Aov::Color)[4 * i + 3], 1);
    }
}

TEST(RenderFrame, ClipsAlongTheViewAxis) {
    Scene scene;
    AddCage(&scene, "/near", Square())->SetTransform(Placed(9, 0, 0, 3));
    AddCage(&scene, "/far", Square())->SetTransform(Placed(9, 0, 0, 0));
    Camera camera = CameraAt(4);
    const auto corner = [&] { return Render(&scene, camera).Floats(Aov::CameraDepth)[0]; };
    EXPECT_NEAR(corner(), 1, 1e-5f);
    camera.clipNear = 1.1f;
    EXPECT_NEAR(corner(), 4, 1e-5f);
    // Along the ray to the corner it is farther than 4.5: clipping goes along the axis.
    camera.clipFar = 4.5f;
    EXPECT_NEAR(corner(), 4, 1e-5f);
    camera.clipFar = 3.9f;
    EXPECT_EQ(corner(), 0);
}

TEST(RenderFrame, CullsTheSideThatItIsAskedTo) {
    for (const bool orthographic : {false, true}) {
        Scene scene;
        Mesh* front = AddCage(&scene, "/front", Reversed(Square()));
        front->SetPrimId(1);
        front->SetCulled(CulledSide::Front);
        AddCage(&scene, "/behind", Square())->SetTransform(Placed(9, 0, 0, -1));
        Camera camera = CameraAt(2);
        camera.orthographic = orthographic;
        EXPECT_EQ(Render(&scene, camera, Options(), 8, 8).Ints(Aov::PrimId)[36], 1);
        front->SetCulled(CulledSide::Back);
        const Film culled = Render(&scene, camera, Options(), 8, 8);
        EXPECT_EQ(culled.Ints(Aov::PrimId)[36], 0);
        EXPECT_NEAR(culled.Floats(Aov::CameraDepth)[36], 3, 1e-5f);
        front->SetTopology(Square().mesh);
        EXPECT_EQ(Render(&scene, camera, Options(), 8, 8).Ints(Aov::PrimId)[36], 1);
        front->SetCulled(CulledSide::Front);
        EXPECT_EQ(Render(&scene, camera, Options(), 8, 8).Ints(Aov::PrimId)[36], 0);
    }
}

TEST(RenderFrame, CulledRaysPassThroughManySurfaces) {
    Scene scene;
    for (int i = 0; i < 20; ++i) {
        Mesh* mesh = AddCage(&scene, "/layer" + std::to_string(i), Reversed(Square()));
        mesh->SetTransform(Placed(9, 0, 0, -0.1 * i));
        mesh->SetCulled(CulledSide::Back);
    }
    Camera camera = CameraAt(2);
    EXPECT_EQ(Render(&scene, camera, Options(), 8, 8).Ints(Aov::PrimId)[36], -1);
    Mesh* last = AddCage(&scene, "/last", Square());
    last->SetTransform(Placed(9, 0, 0, -3));
    last->SetPrimId(9);
    EXPECT_EQ(Render(&scene, camera, Options(), 8, 8).Ints(Aov::PrimId)[36], 9);
}

TEST(RenderFrame, RendersAovsWithoutColor) {
    Scene scene;
    AddCage(&scene, "/square", Square());
    scene.Build({"geometry"});
    Film film(8, 8, {Aov::ElementId});
    RenderStatistics statistics;
    ASSERT_TRUE(
        RenderFrame(&scene, CameraAt(2), Options(16), &film, &statistics, nullptr, nullptr));
    EXPECT_EQ(film.Ints(Aov::ElementId)[0], 0);
    EXPECT_EQ(statistics.primaryRays, 64u);
}

TEST(RenderFrame, CountsRaysAndProgress) {
    Scene scene;
    AddCage(&scene, "/square", Square());
    AddHeadlight(&scene);
    scene.Build({"geometry"});
    Film film(19, 13, kAllAovs);
    RenderStatistics statistics;
    std::atomic<int64_t> progress{5};
    ASSERT_TRUE(
        RenderFrame(&scene, CameraAt(2), Options(3), &film, &statistics, &progress, nullptr));
    EXPECT_EQ(progress, 5 + 3 * 19 * 13);
    EXPECT_EQ(statistics.primaryRays, 3u * 19 * 13);
    EXPECT_EQ(statistics.shadowRays, 3u * 19 * 13);
    EXPECT_EQ(statistics.trace.rays, 6u * 19 * 13);
    EXPECT_GT(statistics.primarySeconds, 0);
    EXPECT_GT(statistics.shadowSeconds, 0);
    EXPECT_GT(statistics.seconds, 0);
}

TEST(RenderFrame, CountsThreadsThatHadAPart) {
    Scene scene;
    AddCage(&scene, "/square", Square());
    scene.Build({"geometry"});
    Film film(8, 8, {Aov::PrimId});  // a single tile
    RenderStatistics statistics;
    RenderFrame(&scene, CameraAt(2), Options(1, 4), &film, &statistics, nullptr, nullptr);
    EXPECT_EQ(statistics.threads, 1);
}

TEST(RenderFrame, StopsWhenAsked) {
    Scene scene;
    AddCage(&scene, "/square", Square());
    scene.Build({"geometry"});
    Film film(64, 64, kAllAovs);
    RenderStatistics statistics;
    std::atomic<int64_t> progress{0};
    const std::atomic<bool> stop{true};
    EXPECT_FALSE(RenderFrame(&scene, CameraAt(2), Options(), &film, &statistics, &progress, &stop));
    EXPECT_EQ(progress, 0);
}

TEST(RenderFrame, AnEmptySceneOrCameraIsBackground) {
    Scene scene;
    Film film = Render(&scene, CameraAt(2), Options(), 8, 8);
    EXPECT_EQ(film.Ints(Aov::PrimId)[0], -1);
    EXPECT_EQ(film.Floats(Aov::Depth)[0], 1);

    AddCage(&scene, "/square", Square());
    scene.Build({"geometry"});
    Camera flat = CameraAt(2);
    flat.cameraToWorld = Placed(0, 0, 0, 0);
    film.Ints(Aov::PrimId)[0] = 3;
    RenderStatistics statistics;
    std::atomic<int64_t> progress{0};
    EXPECT_TRUE(RenderFrame(&scene, flat, Options(), &film, &statistics, &progress, nullptr));
    EXPECT_EQ(film.Ints(Aov::PrimId)[0], -1);
    EXPECT_EQ(progress, 64);

    Film nothing(0, 0, kAllAovs);
    EXPECT_TRUE(
        RenderFrame(&scene, CameraAt(2), Options(), &nothing, &statistics, nullptr, nullptr));
}

}  // namespace
}  // namespace cc::test
