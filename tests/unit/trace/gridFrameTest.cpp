#include <random>

#include <gtest/gtest.h>
#include <hwy/highway.h>

#include "core/trace/gridFrame-inl.h"

namespace cc::test {
namespace {

namespace simd = HWY_NAMESPACE;

constexpr int kSplits = 4, kSide = 1 << kSplits;

/// A patch in the plane that is bent and stretched at random, far from the origin.
BezierRows RandomPatch(float bend, const Vec3f& middle, std::mt19937* random) {
    std::uniform_real_distribution<float> unit(-1, 1);
    BezierPatch patch;
    for (int row = 0; row < 4; ++row) {
        for (int column = 0; column < 4; ++column) {
            const Vec3f noise{unit(*random), unit(*random), unit(*random)};
            patch.points[row][column] =
                middle + Vec3f{static_cast<float>(column), static_cast<float>(row), 0} +
                bend * noise;
        }
    }
    return BezierRows(patch);
}

LimitGrid EvaluateAll(const BezierRows& patch) {
    LimitGrid grid;
    grid.side = kSide;
    for (int row = 0; row <= kSide; ++row) {
        simd::EvaluateRow(patch, kSplits, row, &grid);
    }
    return grid;
}

GridFrame FrameOf(const LimitGrid& grid) {
    const Vec3f corners[4] = {grid.At(0, 0), grid.At(0, kSide), grid.At(kSide, kSide),
                              grid.At(kSide, 0)};
    return GridFrame(corners, kSide);
}

/// Sixteen rays that each hit a quad, from anywhere.
struct AimedRays {
    ObjectRays rays;
    int rows[16], columns[16];

    AimedRays(const LimitGrid& grid, std::mt19937* random) {
        std::uniform_real_distribution<float> unit(0, 1);
        std::uniform_int_distribution<int> quad(0, kSide - 1);
        rays.count = 16;
        for (int i = 0; i < 16; ++i) {
            const int row = rows[i] = quad(*random), column = columns[i] = quad(*random);
            // A point of the triangle (0, 1, 2).
            const float a = unit(*random), b = unit(*random) * (1 - a);
            const Vec3f target = grid.At(row, column) +
                                 (a + b) * (grid.At(row, column + 1) - grid.At(row, column)) +
                                 b * (grid.At(row + 1, column + 1) - grid.At(row, column + 1));
            const Vec3f way{unit(*random) - 0.5f, unit(*random) - 0.5f, unit(*random) - 0.5f};
            rays.originX[i] = target.x - 3 * way.x;
            rays.originY[i] = target.y - 3 * way.y;
            rays.originZ[i] = target.z - 3 * way.z;
            rays.directionX[i] = way.x;
            rays.directionY[i] = way.y;
            rays.directionZ[i] = way.z;
            rays.tMin[i] = 0;
            rays.tMax[i] = 1e30f;
        }
    }
};

/// Counts the quads that 16 aimed rays are told to meet.
int CountQuads(const GridFrame& frame, const AimedRays& aimed, float* count) {
    simd::QuadRanges ranges;
    const hwy::HWY_NAMESPACE::CappedTag<float, 4> d;
    const uint64_t meeting = simd::FindQuads(d, frame, aimed.rays, 0xffff, &ranges);
    int missed = 0;
    for (int i = 0; i < 16; ++i) {
        const bool isFound = (meeting >> i & 1) != 0 && ranges.firstRow[i] <= aimed.rows[i] &&
                             aimed.rows[i] <= ranges.lastRow[i] &&
                             ranges.firstColumn[i] <= aimed.columns[i] &&
                             aimed.columns[i] <= ranges.lastColumn[i];
        missed += static_cast<int>(!isFound);
        *count += static_cast<float>((ranges.lastRow[i] - ranges.firstRow[i] + 1) *
                                     (ranges.lastColumn[i] - ranges.firstColumn[i] + 1));
    }
    return missed;
}

TEST(GridFrame, RaysFindTheQuadsTheyHit) {
    std::mt19937 random(3);
    for (const float bend : {0.0f, 0.03f, 0.3f, 2.0f}) {
        float byControlPoints = 0, byPoints = 0;  // how many quads they find
        for (int n = 0; n < 200; ++n) {
            const BezierRows patch = RandomPatch(bend, {100.0f * (n % 3), -7, 3}, &random);
            const LimitGrid grid = EvaluateAll(patch);
            const AimedRays aimed(grid, &random);
            GridFrame frame = FrameOf(grid);
            simd::MeasureDeviation(patch, &frame);
            EXPECT_EQ(CountQuads(frame, aimed, &byControlPoints), 0) << bend;
            frame = FrameOf(grid);
            simd::MeasureDeviation(grid, &frame);
            EXPECT_EQ(CountQuads(frame, aimed, &byPoints), 0) << bend;
        }
        // A frame that finds everything everywhere is of no use.
        EXPECT_LE(byPoints, byControlPoints);
        if (bend < 0.1f) {
            EXPECT_LT(byControlPoints / (16 * 200), 16) << bend;
        }
    }
}

/// A patch that is an arch across its rows: heights are a parabola, and columns are stretched in
/// the middle by a cubic.
BezierRows Arch(float height, float stretch) {
    BezierPatch patch;
    for (int row = 0; row < 4; ++row) {
        for (int column = 0; column < 4; ++column) {
            const float inner = column % 3 == 0 ? 0.0f : 1.0f;
            const float off = column == 1 ? stretch : column == 2 ? -stretch : 0;
            patch.points[row][column] = {static_cast<float>(column) + off, static_cast<float>(row),
                                         height * inner};
        }
    }
    return BezierRows(patch);
}

TEST(GridFrame, RaysKnowBends) {
    std::mt19937 random(6);
    // A ray through an arch meets it twice at most, in few quads.
    for (const BezierRows& patch : {Arch(2, 0), Arch(-2, 0), Arch(1.5f, 0.3f), Arch(0, 0.4f)}) {
        float count = 0;
        for (int n = 0; n < 200; ++n) {
            const LimitGrid grid = EvaluateAll(patch);
            GridFrame frame = FrameOf(grid);
            simd::MeasureDeviation(patch, &frame);
            EXPECT_EQ(CountQuads(frame, AimedRays(grid, &random), &count), 0);
        }
        EXPECT_LT(count / (16 * 200), 40);
    }
}

TEST(GridFrame, RaysBesideTheGridMeetNothing) {
    std::mt19937 random(4);
    const LimitGrid grid = EvaluateAll(RandomPatch(0.1f, {}, &random));
    GridFrame frame = FrameOf(grid);
    simd::MeasureDeviation(grid, &frame);
    AimedRays aimed(grid, &random);
    for (int i = 0; i < 16; ++i) {
        aimed.rays.originX[i] += 100 * aimed.rays.directionY[i] + 100 * aimed.rays.directionZ[i];
        aimed.rays.originY[i] -= 100 * aimed.rays.directionX[i];
        aimed.rays.originZ[i] -= 100 * aimed.rays.directionX[i];
    }
    simd::QuadRanges ranges;
    const hwy::HWY_NAMESPACE::CappedTag<float, 4> d;
    EXPECT_EQ(simd::FindQuads(d, frame, aimed.rays, 0xffff, &ranges), 0u);
}

TEST(GridFrame, WhatHasNoPlaneIsMetEverywhere) {
    std::mt19937 random(5);
    BezierPatch line;
    for (auto& row : line.points) {
        for (int column = 0; column < 4; ++column) {
            row[column] = {static_cast<float>(column), 0, 0};
        }
    }
    const LimitGrid grid = EvaluateAll(BezierRows(line));
    GridFrame frame = FrameOf(grid);
    simd::MeasureDeviation(grid, &frame);
    frame.Widen(1e-3f);
    float count = 0;
    EXPECT_EQ(CountQuads(frame, AimedRays(grid, &random), &count), 0);
    EXPECT_EQ(count, 16 * kSide * kSide);
}

}  // namespace
}  // namespace cc::test
