#include "core/render/film.h"

#include <gtest/gtest.h>

namespace cc {
namespace {

constexpr Aov::Kind kAllAovs[] = {Aov::Color,      Aov::Depth,     Aov::CameraDepth, Aov::PrimId,
                                  Aov::InstanceId, Aov::ElementId, Aov::Normal,      Aov::Neye};

TEST(Film, NamesGoBothWays) {
    for (const Aov aov : kAllAovs) {
        Aov found;
        ASSERT_TRUE(AovFromName(NameOf(aov), &found)) << NameOf(aov);
        EXPECT_EQ(found, aov);
    }
    Aov untouched = Aov::Depth;
    EXPECT_FALSE(AovFromName("colour", &untouched));
    EXPECT_FALSE(AovFromName("", &untouched));
    EXPECT_FALSE(AovFromName("primvars:", &untouched));
    EXPECT_EQ(untouched, Aov(Aov::Depth));
}

TEST(Film, PrimvarsAreAovsByName) {
    Aov st;
    ASSERT_TRUE(AovFromName("primvars:st", &st));
    EXPECT_EQ(st.kind, Aov::Primvar);
    EXPECT_EQ(st.primvar, "st");
    EXPECT_EQ(NameOf(st), "primvars:st");
    const Aov scalar(Aov::Primvar, "heat", 1);
    EXPECT_NE(st, scalar);
    Film film(2, 1, {st, scalar});
    EXPECT_EQ(film.Layout(st).components, 3);
    EXPECT_EQ(film.Layout(Aov(Aov::Primvar, "heat", 4)).components, 1);
    EXPECT_EQ(film.Floats(scalar)[1], 0);
    EXPECT_EQ(film.Coverage(scalar)[1], 0);
    EXPECT_FALSE(film.Has(Aov(Aov::Primvar, "color", 3)));
    EXPECT_EQ(film.Coverage(Aov::Color), nullptr);
}

TEST(Film, HasTheNamesOfHydra) {
    EXPECT_EQ(NameOf(Aov::Color), "color");
    EXPECT_EQ(NameOf(Aov::CameraDepth), "cameraDepth");
    EXPECT_EQ(NameOf(Aov::PrimId), "primId");
    EXPECT_EQ(NameOf(Aov::Neye), "Neye");
}

TEST(Film, StartsAsBackground) {
    Film film(3, 2, {std::begin(kAllAovs), std::end(kAllAovs)});
    for (int i = 0; i < 6; ++i) {
        EXPECT_EQ(film.Floats(Aov::Color)[4 * i + 3], 0);
        EXPECT_EQ(film.Floats(Aov::Depth)[i], 1);
        EXPECT_EQ(film.Floats(Aov::CameraDepth)[i], 0);
        EXPECT_EQ(film.Floats(Aov::Normal)[3 * i + 2], 0);
        EXPECT_EQ(film.Ints(Aov::PrimId)[i], -1);
        EXPECT_EQ(film.Ints(Aov::InstanceId)[i], -1);
        EXPECT_EQ(film.Ints(Aov::ElementId)[i], -1);
    }
}

TEST(Film, ClearBringsTheBackgroundBack) {
    Film film(2, 1, {Aov::PrimId, Aov::Depth});
    film.Ints(Aov::PrimId)[1] = 7;
    film.Floats(Aov::Depth)[1] = 0.5f;
    film.Clear();
    EXPECT_EQ(film.Ints(Aov::PrimId)[1], -1);
    EXPECT_EQ(film.Floats(Aov::Depth)[1], 1);
}

TEST(Film, HasNoPlaneThatWasNotAskedFor) {
    Film film(2, 2, {Aov::PrimId, Aov::Depth});
    EXPECT_TRUE(film.Has(Aov::PrimId));
    EXPECT_FALSE(film.Has(Aov::Color));
    EXPECT_EQ(film.Floats(Aov::Color), nullptr);
    // Nor one of the other type.
    EXPECT_EQ(film.Floats(Aov::PrimId), nullptr);
    EXPECT_EQ(film.Ints(Aov::Depth), nullptr);
}

}  // namespace
}  // namespace cc
