#include <atomic>
#include <cmath>
#include <cstring>
#include <limits>
#include <set>

#include <gtest/gtest.h>

#include "core/render/progressiveFrame.h"
#include "core/render/renderer.h"
#include "core/render/shutterTimes.h"
#include "tests/unit/render/renderTestKit.h"
#include "tests/unit/subdiv/cageKit.h"

namespace cc::test {
namespace {

constexpr int kSize = 40;

RenderOptions Options(int samples, int threads = 2) {
    RenderOptions options;
    options.samples = samples;
    options.threads = threads;
    options.level = 3;
    return options;
}

/// Sees -2..2 of the plane z = 0.
Camera OpenCamera(float open, float close) {
    Camera camera = CameraAt(4);
    camera.shutterOpen = open;
    camera.shutterClose = close;
    return camera;
}

/// Of the plane, at the centre of a column or row of pixels.
float At(int pixel) { return (static_cast<float>(pixel) + 0.5f) * 4 / kSize - 2; }

Film Render(Scene* scene, const Camera& camera, const RenderOptions& options,
            const std::vector<Aov>& aovs = kAllAovs) {
    EXPECT_TRUE(scene->Build({"geometry"}).empty());
    Film film(kSize, kSize, aovs);
    RenderStatistics statistics;
    EXPECT_TRUE(RenderFrame(scene, camera, options, &film, &statistics, nullptr, nullptr));
    return film;
}

float Coverage(const Film& film, int x, int y) {
    return film.Floats(Aov::Color)[4 * (y * kSize + x) + 3];
}

/// A square from -1 to 1 that goes to the right by its own width within a frame.
void AddMovingSquare(Scene* scene) {
    AddCage(scene, "/square", Square())
        ->SetMovingTransform({{0, 1}, {Placed(1, -1, 0, 0), Placed(1, 1, 0, 0)}});
    AddHeadlight(scene);
}

TEST(ShutterTimes, OfAllPixelsAreEvenlySpread) {
    for (const int count : {1, 2, 7, 16, 64}) {
        std::set<float> sorted;
        for (int part = 0; part < 3; ++part) {
            const std::vector<float> times = ShutterTimes(-0.25f, 0.5f, count, part, 3);
            sorted.insert(times.begin(), times.end());
        }
        ASSERT_EQ(sorted.size(), size_t(3) * count);
        int i = 0;
        for (const float time : sorted) {
            EXPECT_NEAR(time, -0.25 + 0.75 * (i++ + 0.5) / (3 * count), 1e-6);
        }
    }
}

TEST(ShutterTimes, AreSpreadFromTheFirstOnes) {
    const std::vector<float> times = ShutterTimes(0, 1, 64, 0, 1);
    for (int count : {4, 8, 16}) {
        std::set<int> parts;
        for (int i = 0; i < count; ++i) {
            parts.insert(static_cast<int>(times[i] * static_cast<float>(count) / 2));
        }
        EXPECT_EQ(int(parts.size()), count / 2) << count;
    }
}

TEST(MotionBlur, CoversPixelsForTheTimeThatSomethingIsThere) {
    constexpr int kSamples = 64;
    Scene scene;
    AddMovingSquare(&scene);
    for (const float close : {0.5f, 1.0f}) {
        const Film film = Render(&scene, OpenCamera(0, close), Options(kSamples));
        for (int x = 0; x < kSize; ++x) {
            // There from when the right side arrives until the left one does.
            const float right = (At(x) - 0) / 2, left = (At(x) + 2) / 2;
            const float from = std::min(std::max(right, 0.0f), close);
            const float to = std::min(std::max(left, 0.0f), close);
            EXPECT_NEAR(Coverage(film, x, kSize / 2), (to - from) / close, 0.05f) << x;
        }
    }
}

TEST(MotionBlur, OfPointsIsThatOfATransform) {
    Scene ofPoints, ofTransform;
    AddMovingSquare(&ofTransform);
    std::vector<std::vector<Vec3f>> poses(2, Square().points);
    for (int i = 0; i < 4; ++i) {
        poses[0][i].x -= 1;
        poses[1][i].x += 1;
    }
    AddCage(&ofPoints, "/square", Square())->SetMovingPoints({{0, 1}, poses});
    AddHeadlight(&ofPoints);
    const Film a = Render(&ofPoints, OpenCamera(0, 1), Options(16));
    const Film b = Render(&ofTransform, OpenCamera(0, 1), Options(16));
    for (int i = 0; i < 4 * kSize * kSize; ++i) {
        ASSERT_NEAR(a.Floats(Aov::Color)[i], b.Floats(Aov::Color)[i], 1e-4f) << i;
    }
}

TEST(MotionBlur, OfTheCameraIsThatOfTheSceneTheOtherWay) {
    Scene moving, still;
    AddMovingSquare(&moving);
    AddCage(&still, "/square", Square());
    AddHeadlight(&still);
    Camera camera = OpenCamera(0, 1);
    camera.motion = {{0, 1}, {Placed(1, 1, 0, 4), Placed(1, -1, 0, 4)}};
    camera.cameraToWorld = camera.motion.Poses()[0];
    const Film a = Render(&still, camera, Options(16));
    const Film b = Render(&moving, OpenCamera(0, 1), Options(16));
    EXPECT_LT(Coverage(a, kSize - 2, kSize / 2), 0.2f);
    EXPECT_GT(Coverage(a, kSize - 2, kSize / 2), 0.0f);
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
            ASSERT_NEAR(Coverage(a, x, y), Coverage(b, x, y), 1e-4f);
        }
    }
}

TEST(MotionBlur, LeavesAllButColorAtTimeZero) {
    Scene moving, still;
    AddMovingSquare(&moving);
    AddCage(&still, "/square", Square())->SetTransform(Placed(1, -1, 0, 0));
    AddHeadlight(&still);
    const std::vector<Aov> others(kAllAovs.begin() + 1, kAllAovs.end());
    const Film a = Render(&moving, OpenCamera(-0.5f, 1), Options(4));
    const Film b = Render(&still, CameraAt(4), Options(4), others);
    for (const Aov& aov : others) {
        Film one(kSize, kSize, {aov}), two(kSize, kSize, {aov});
        const size_t bytes = 4 * size_t(kSize) * kSize * LayoutOf(aov).components;
        const auto plane = [&](const Film& film) {
            return LayoutOf(aov).isInteger ? static_cast<const void*>(film.Ints(aov))
                                           : static_cast<const void*>(film.Floats(aov));
        };
        EXPECT_EQ(std::memcmp(plane(a), plane(b), bytes), 0) << int(aov.kind);
    }
}

TEST(MotionBlur, OfAClosedShutterIsNone) {
    Scene moving, still;
    AddMovingSquare(&moving);
    AddCage(&still, "/square", Square())->SetTransform(Placed(1, -1, 0, 0));
    AddHeadlight(&still);
    EXPECT_EQ(Bits(Render(&moving, OpenCamera(0, 0), Options(4))),
              Bits(Render(&still, CameraAt(4), Options(4))));
}

TEST(MotionBlur, OfWhatRestsChangesNothing) {
    Scene still;
    AddCage(&still, "/cube", Cube());
    AddHeadlight(&still);
    EXPECT_EQ(Bits(Render(&still, OpenCamera(0, 1), Options(4))),
              Bits(Render(&still, CameraAt(4), Options(4))));
}

TEST(MotionBlur, HasTheSameBitsHoweverItIsRendered) {
    Scene scene;
    AddMovingSquare(&scene);
    AddCage(&scene, "/cube", WithCrease(Cube(), {0, 1}, 2, "creased"))
        ->SetMovingPoints({{0, 1}, {Cube().points, Rough(Cube()).points}});
    const Camera camera = OpenCamera(0, 1);
    const std::string bits = Bits(Render(&scene, camera, Options(9, 1)));
    EXPECT_EQ(Bits(Render(&scene, camera, Options(9, 3))), bits);

    ProgressiveFrame frame(&scene, camera, Options(9, 2), kSize, kSize, kAllAovs);
    Film last;
    // Stopped in the middle of passes, too, as the count of samples tells.
    std::atomic<bool> stop{false};
    std::atomic<int64_t> progress{0};
    while (!frame.IsDone()) {
        if (frame.RenderPass(&progress, &stop)) {
            last = frame.TakePicture();
        }
    }
    EXPECT_EQ(Bits(last), bits);
    EXPECT_EQ(progress, int64_t(kSize) * kSize * 9);
}

TEST(MotionBlur, BeginsAtOnceHoweverManySamplesThereAre) {
    Scene scene;
    AddMovingSquare(&scene);
    scene.Build({"geometry"});
    ProgressiveFrame frame(&scene, OpenCamera(0, 1), Options(std::numeric_limits<int>::max()), 8, 8,
                           kAllAovs);
    while (frame.SamplesDone() < 4) {
        ASSERT_TRUE(frame.RenderPass(nullptr, nullptr));
    }
    EXPECT_FALSE(frame.IsDone());
}

TEST(MotionBlur, IsTakenUpAgainWhereItWasStopped) {
    Scene scene;
    AddMovingSquare(&scene);
    const Camera camera = OpenCamera(0, 1);
    const std::string bits = Bits(Render(&scene, camera, Options(5)));
    Film film(kSize, kSize, kAllAovs);
    FrameSampler sampler(&scene, camera, Options(5), &film);
    SampleSums sums(sampler.TileCount());
    RenderStatistics statistics;
    std::atomic<bool> stop{true};
    EXPECT_FALSE(sampler.Render(3, &sums, &statistics, nullptr, &stop));
    EXPECT_TRUE(sampler.Render(3, &sums, &statistics, nullptr, nullptr));
    EXPECT_FALSE(sampler.Render(5, &sums, &statistics, nullptr, &stop));
    EXPECT_TRUE(sampler.Render(5, &sums, &statistics, nullptr, nullptr));
    EXPECT_EQ(Bits(film), bits);
}

}  // namespace
}  // namespace cc::test
