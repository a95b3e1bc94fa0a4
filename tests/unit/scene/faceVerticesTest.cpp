#include "core/scene/faceVertices.h"

#include <gtest/gtest.h>

namespace cc {
namespace {

TEST(FaceVertices, FindsTheVerticesOfMixedFaces) {
    const FaceVertices faces({3, 0, 5, 4}, {0, 1, 2, 9, 8, 7, 6, 5, 2, 1, 4, 3});
    EXPECT_EQ(faces.FaceCount(), 4u);
    EXPECT_EQ(faces.Count(), 12u);
    EXPECT_EQ(faces.FirstOfFace(0), 0u);
    EXPECT_EQ(faces.FirstOfFace(2), 3u);
    EXPECT_EQ(faces.CountOfFace(0), 3);
    EXPECT_EQ(faces.CountOfFace(1), 0);
    EXPECT_EQ(faces.CountOfFace(3), 4);
    EXPECT_EQ(faces.Point(faces.FirstOfFace(2)), 9u);
}

TEST(FaceVertices, QuadsNeedNoOffsets) {
    const FaceVertices quads({4, 4}, {0, 1, 2, 3, 3, 2, 5, 4});
    EXPECT_EQ(quads.FirstOfFace(1), 4u);
    EXPECT_EQ(quads.CountOfFace(1), 4);
    EXPECT_EQ(quads.Point(6), 5u);
    EXPECT_EQ(quads.Bytes(), 8 * sizeof(int));
}

}  // namespace
}  // namespace cc
