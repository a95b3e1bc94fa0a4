#include "core/render/pixelSampler.h"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

namespace cc {
namespace {

TEST(PixelSampler, BeginsAtTheCenter) {
    for (int pixel = 0; pixel < 100; ++pixel) {
        const Vec2f sample = PixelSampler(pixel, 3 * pixel, 7, 1 + pixel).Sample(0);
        EXPECT_EQ(sample.x, 0.5f);
        EXPECT_EQ(sample.y, 0.5f);
    }
}

TEST(PixelSampler, StaysInThePixel) {
    for (int index = 0; index < 100000; ++index) {
        const Vec2f sample = PixelSampler(index % 13, index % 7, 1, 100000).Sample(index);
        ASSERT_TRUE(sample.x >= 0 && sample.x < 1) << index;
        ASSERT_TRUE(sample.y >= 0 && sample.y < 1) << index;
    }
}

/// How far the share of samples in boxes at the origin is from the boxes' areas, at worst.
double StarDiscrepancy(const PixelSampler& sampler, int samples) {
    double worst = 0;
    for (int i = 1; i <= 16; ++i) {
        for (int j = 1; j <= 16; ++j) {
            int inside = 0;
            for (int s = 0; s < samples; ++s) {
                const Vec2f p = sampler.Sample(s);
                inside += p.x < i / 16.0 && p.y < j / 16.0;
            }
            worst = std::max(worst, std::fabs(inside / double(samples) - i * j / 256.0));
        }
    }
    return worst;
}

TEST(PixelSampler, SpreadsEvenly) {
    for (int pixel = 0; pixel < 20; ++pixel) {
        // Random points come to about 0.25 and 0.06.
        EXPECT_LT(StarDiscrepancy(PixelSampler(pixel, 1, 0, 16), 16), 0.13) << pixel;
        EXPECT_LT(StarDiscrepancy(PixelSampler(pixel, 1, 0, 256), 256), 0.015) << pixel;
    }
}

TEST(PixelSampler, DependsOnPixelAndSeed) {
    std::set<std::pair<float, float>> ofPixels, ofSeeds;
    for (int i = 0; i < 64; ++i) {
        const Vec2f p = PixelSampler(i, 5, 0, 4).Sample(1);
        const Vec2f q = PixelSampler(5, 5, i, 4).Sample(1);
        ofPixels.insert({p.x, p.y});
        ofSeeds.insert({q.x, q.y});
    }
    EXPECT_EQ(ofPixels.size(), 8u);
    EXPECT_EQ(ofSeeds.size(), 8u);
}

}  // namespace
}  // namespace cc
