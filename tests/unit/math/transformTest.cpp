#include "core/math/transform.h"

#include <gtest/gtest.h>

namespace cc::test {
namespace {

const AffineTransform kPlace({{{0, -2, 0, 5}, {1, 0, 0, 6}, {0, 0, 3, 7}}});

TEST(AffineTransform, InverseUndoesIt) {
    AffineTransform inverse;
    ASSERT_TRUE(kPlace.Invert(&inverse));
    const Vec3f p = inverse.Point(kPlace.Point({1, 2, 3}));
    EXPECT_NEAR(Length(p - Vec3f{1, 2, 3}), 0, 1e-6f);
    EXPECT_EQ(kPlace * AffineTransform(), kPlace);
    EXPECT_EQ((kPlace * inverse).Point({4, 5, 6}), (Vec3f{4, 5, 6}));
}

TEST(AffineTransform, RefusesToInvertWhatHasNoInverse) {
    AffineTransform inverse = kPlace;
    EXPECT_FALSE(AffineTransform({{{1, 0, 0, 0}, {2, 0, 0, 0}, {0, 0, 1, 0}}}).Invert(&inverse));
    EXPECT_FALSE(AffineTransform({{{1, 0, 0, 0}, {0, 1, 0, NAN}, {0, 0, 1, 0}}}).Invert(&inverse));
    EXPECT_EQ(inverse, kPlace);
}

TEST(AffineTransform, NormalsStayPerpendicular) {
    AffineTransform inverse;
    ASSERT_TRUE(kPlace.Invert(&inverse));
    const Vec3f normal = inverse.NormalByInverse({1, 1, 1});
    EXPECT_NEAR(Dot(normal, kPlace.Direction({1, -1, 0})), 0, 1e-6f);
    EXPECT_NEAR(Dot(normal, kPlace.Direction({0, 1, -1})), 0, 1e-6f);
}

TEST(AffineTransform, BoxHoldsTheMovedBox) {
    Box3f box;
    box.Extend(Vec3f{0, 0, 0});
    box.Extend(Vec3f{1, 1, 1});
    const Box3f moved = kPlace.Box(box);
    EXPECT_NEAR(moved.lower.x, 3, 1e-5f);
    EXPECT_NEAR(moved.upper.z, 10, 1e-5f);
    EXPECT_TRUE(kPlace.Box(Box3f()).IsEmpty());
}

}  // namespace
}  // namespace cc::test
