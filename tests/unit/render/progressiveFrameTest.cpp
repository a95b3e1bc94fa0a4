#include "core/render/progressiveFrame.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <thread>

#include <gtest/gtest.h>

#include "tests/repeats.h"
#include "tests/unit/render/renderTestKit.h"

namespace cc::test {
namespace {

/// A small cube before a large square, in light that casts shadows.
class ProgressiveFrameTest : public testing::Test {
  protected:
    void SetUp() override {
        Mesh* cube = AddCage(&scene, "/cube", Cube());
        cube->SetPrimvar("heat", {Interpolation::Constant, 1, {7}, {}});
        Mesh* square = AddCage(&scene, "/square", Square());
        square->SetTransform(Placed(9, 0, 0, -3));
        square->SetPrimId(1);
        AddHeadlight(&scene);
        scene.Build({"geometry"});
        aovs.push_back(Aov::Level);
        aovs.push_back(Aov::Cost);
        aovs.push_back(Aov(Aov::Primvar, "heat", 1));
    }

    RenderOptions Options(int samples, int threads) const {
        RenderOptions options;
        options.samples = samples;
        options.threads = threads;
        return options;
    }

    std::unique_ptr<ProgressiveFrame> Frame(const RenderOptions& options) {
        return std::make_unique<ProgressiveFrame>(&scene, CameraAt(6), options, kWidth, kHeight,
                                                  aovs);
    }

    std::string BitsInOneGo(int samples) {
        Film film(kWidth, kHeight, aovs);
        RenderStatistics statistics;
        EXPECT_TRUE(RenderFrame(&scene, CameraAt(6), Options(samples, 1), &film, &statistics,
                                nullptr, nullptr));
        return Bits(film);
    }

    static constexpr int kWidth = 45, kHeight = 27;
    Scene scene;
    std::vector<Aov> aovs = kAllAovs;
};

/// Renders passes that make pictures of blocks.
void RenderFirstBlocks(ProgressiveFrame* frame, int passes) {
    for (int i = 0; i < passes; ++i) {
        EXPECT_TRUE(frame->RenderPass(nullptr, nullptr));
        EXPECT_EQ(frame->SamplesDone(), 0);
    }
}

TEST_F(ProgressiveFrameTest, EndsWithThePictureMadeInOneGo) {
    for (const int samples : {1, 2, 3, 16, 150}) {
        const std::string expected = BitsInOneGo(samples);
        for (const int threads : {1, 3}) {
            const auto frame = Frame(Options(samples, threads));
            RenderFirstBlocks(frame.get(), 3);
            std::atomic<int64_t> progress{0};
            int before = 0;
            while (!frame->IsDone()) {
                EXPECT_TRUE(frame->RenderPass(&progress, nullptr));
                EXPECT_GT(frame->SamplesDone(), before);
                before = frame->SamplesDone();
                EXPECT_EQ(progress, int64_t(kWidth) * kHeight * before);
            }
            EXPECT_EQ(frame->SamplesDone(), samples);
            EXPECT_EQ(frame->Statistics().primaryRays, uint64_t(kWidth) * kHeight * samples);
            EXPECT_LE(frame->Statistics().threads, threads);
            EXPECT_TRUE(Bits(frame->TakePicture()) == expected) << samples << ' ' << threads;
        }
    }
}

TEST_F(ProgressiveFrameTest, PicturesMayBeTakenOnTheWay) {
    const auto frame = Frame(Options(8, 2));
    std::vector<std::string> pictures;
    while (!frame->IsDone()) {
        EXPECT_TRUE(frame->RenderPass(nullptr, nullptr));
        pictures.push_back(Bits(frame->TakePicture()));
    }
    EXPECT_TRUE(pictures.back() == BitsInOneGo(8));
    std::sort(pictures.begin(), pictures.end());
    EXPECT_EQ(std::unique(pictures.begin(), pictures.end()), pictures.end());
    EXPECT_EQ(pictures.size(), 3u + 4);
}

TEST_F(ProgressiveFrameTest, TakesOneSampleWithoutColor) {
    aovs = {Aov::PrimId};
    const std::string expected = BitsInOneGo(16);
    const auto frame = Frame(Options(16, 2));
    RenderFirstBlocks(frame.get(), 3);
    EXPECT_TRUE(frame->RenderPass(nullptr, nullptr));
    EXPECT_TRUE(frame->IsDone());
    EXPECT_EQ(frame->SamplesDone(), 1);
    EXPECT_EQ(Bits(frame->TakePicture()), expected);
}

TEST_F(ProgressiveFrameTest, DoesNothingWhileStopped) {
    const auto frame = Frame(Options(4, 2));
    const std::atomic<bool> stop{true};
    std::atomic<int64_t> progress{0};
    for (int passes = 0; passes <= 3; ++passes) {
        EXPECT_FALSE(frame->RenderPass(&progress, &stop));
        EXPECT_FALSE(frame->RenderPass(&progress, &stop));
        EXPECT_EQ(progress, 0);
        EXPECT_EQ(frame->SamplesDone(), 0);
        EXPECT_FALSE(frame->IsDone());
        frame->RenderPass(nullptr, nullptr);
    }
    EXPECT_EQ(frame->SamplesDone(), 1);
}

TEST_F(ProgressiveFrameTest, GoesOnWhereItWasStopped) {
    const std::string expected = BitsInOneGo(8);
    std::atomic<bool> stop{false}, isOver{false};
    std::thread stopper([&] {
        while (!isOver) {
            stop = !stop;
            std::this_thread::yield();
        }
    });
    int stops = 0;
    const int frames = Repeats(60);
    for (int i = 0; i < frames; ++i) {
        const auto frame = Frame(Options(8, 2));
        std::atomic<int64_t> progress{0};
        while (!frame->IsDone()) {
            stops += !frame->RenderPass(&progress, &stop);
        }
        EXPECT_EQ(progress, int64_t(kWidth) * kHeight * 8);
        EXPECT_TRUE(Bits(frame->TakePicture()) == expected) << "after " << stops << " stops";
    }
    isOver = true;
    stopper.join();
    EXPECT_GT(stops, frames);
}

TEST_F(ProgressiveFrameTest, BlocksLieWhereTheirPixelsDo) {
    // Leans away, so that depth tells where a ray went.
    Mesh* leaning = AddCage(&scene, "/leaning", Square());
    leaning->SetTransform(AffineTransform({{{9, 0, 0, 0}, {0, 9, 0, 0}, {0.3, 0.9, 1, 3}}}));
    leaning->SetPrimId(2);
    scene.Build({"geometry"});
    Film film(kWidth, kHeight, aovs);
    RenderStatistics statistics;
    RenderFrame(&scene, CameraAt(6), Options(1, 2), &film, &statistics, nullptr, nullptr);
    const float* fine = film.Floats(Aov::CameraDepth);
    const auto frame = Frame(Options(4, 2));
    for (const int size : {16, 8, 4}) {
        EXPECT_TRUE(frame->RenderPass(nullptr, nullptr));
        const Film blocks = frame->TakePicture();
        EXPECT_EQ(blocks.Aovs(), aovs);
        const float* coarse = blocks.Floats(Aov::CameraDepth);
        for (int pixel = 0; pixel < kWidth * kHeight; ++pixel) {
            const int x = pixel % kWidth / size * size, y = pixel / kWidth / size * size;
            EXPECT_EQ(coarse[pixel], coarse[y * kWidth + x]);
            EXPECT_EQ(blocks.Ints(Aov::PrimId)[pixel], 2);
            if (x + size <= kWidth && y + size <= kHeight) {
                const float ends[] = {fine[y * kWidth + x],
                                      fine[(y + size - 1) * kWidth + x + size - 1]};
                EXPECT_GT(coarse[pixel], std::min(ends[0], ends[1]));
                EXPECT_LT(coarse[pixel], std::max(ends[0], ends[1]));
                EXPECT_NEAR(coarse[pixel], (ends[0] + ends[1]) / 2,
                            0.1f * std::abs(ends[1] - ends[0]));
            }
        }
    }
}

TEST_F(ProgressiveFrameTest, ACameraThatShowsNothingLeavesBackground) {
    Camera flat = CameraAt(6);
    flat.cameraToWorld = Placed(0, 0, 0, 0);
    ProgressiveFrame frame(&scene, flat, Options(2, 2), 8, 8, aovs);
    while (!frame.IsDone()) {
        EXPECT_TRUE(frame.RenderPass(nullptr, nullptr));
        EXPECT_EQ(frame.TakePicture().Ints(Aov::PrimId)[0], -1);
    }
}

TEST_F(ProgressiveFrameTest, NoPixelsAreNoWork) {
    ProgressiveFrame frame(&scene, CameraAt(6), Options(2, 2), 0, 5, aovs);
    while (!frame.IsDone()) {
        EXPECT_TRUE(frame.RenderPass(nullptr, nullptr));
    }
    EXPECT_EQ(frame.Statistics().primaryRays, 0u);
}

}  // namespace
}  // namespace cc::test
