#include "core/render/lensSampler.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "core/render/pixelSampler.h"

namespace cc {
namespace {

constexpr double kPi = 3.14159265358979323846;

TEST(LensSampler, StaysOnTheLens) {
    for (int index = 0; index < 100000; ++index) {
        const Vec2f p = LensSampler(index % 13, index % 7, 1).Sample(index);
        ASSERT_LE(std::hypot(p.x, p.y), 1 + 1e-6) << index;
    }
}

TEST(LensSampler, SpreadsEvenlyOverTheDisk) {
    // Rings of equal areas, cut into equal sectors.
    constexpr int kRings = 4, kSectors = 8, kSamples = 1024;
    for (int pixel = 0; pixel < 10; ++pixel) {
        const LensSampler sampler(pixel, 3, 0);
        int counts[kRings][kSectors] = {};
        for (int i = 0; i < kSamples; ++i) {
            const Vec2f p = sampler.Sample(i);
            const double radius = std::hypot(p.x, p.y);
            const double turn = std::atan2(p.y, p.x) / (2 * kPi);
            const int ring = std::min(int(radius * radius * kRings), kRings - 1);
            ++counts[ring][int((turn + 1) * kSectors) % kSectors];
        }
        for (const auto& ring : counts) {
            for (const int count : ring) {
                // Random points would stray by 6 as a rule, and by 17 at worst.
                EXPECT_NEAR(count, 32, 8) << pixel;
            }
        }
    }
}

TEST(LensSampler, FewSamplesBalance) {
    // The mean of 16 random points is off the centre by 0.16 as a rule.
    double sum = 0;
    for (int pixel = 0; pixel < 200; ++pixel) {
        Vec2f mean{0, 0};
        for (int i = 0; i < 16; ++i) {
            const Vec2f p = LensSampler(pixel, 9, 0).Sample(i);
            mean.x += p.x / 16;
            mean.y += p.y / 16;
        }
        sum += std::hypot(mean.x, mean.y) / 200;
    }
    EXPECT_LT(sum, 0.12);
}

TEST(LensSampler, IsIndependentOfThePlaceInThePixel) {
    for (const int samples : {16, 64, 256}) {
        double products[4] = {};
        for (int pixel = 0; pixel < 400; ++pixel) {
            const PixelSampler inPixel(pixel, 2, 5, samples);
            const LensSampler onLens(pixel, 2, 5);
            for (int i = 0; i < samples; ++i) {
                const Vec2f a = inPixel.Sample(i), b = onLens.Sample(i);
                products[0] += (a.x - 0.5) * b.x;
                products[1] += (a.x - 0.5) * b.y;
                products[2] += (a.y - 0.5) * b.x;
                products[3] += (a.y - 0.5) * b.y;
            }
        }
        for (const double product : products) {
            // Wholly dependent numbers would come to 0.14.
            EXPECT_LT(std::fabs(product) / (400 * samples), 0.01) << samples;
        }
    }
}

TEST(LensSampler, DependsOnPixelAndSeed) {
    std::set<float> ofPixels, ofSeeds;
    for (int i = 0; i < 64; ++i) {
        ofPixels.insert(LensSampler(i, 5, 0).Sample(0).x);
        ofSeeds.insert(LensSampler(5, 5, i).Sample(0).x);
    }
    EXPECT_GT(ofPixels.size(), 60u);
    EXPECT_GT(ofSeeds.size(), 60u);
}

}  // namespace
}  // namespace cc
