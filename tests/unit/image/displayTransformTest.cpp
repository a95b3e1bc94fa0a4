#include "core/image/displayTransform.h"

#include <cmath>
#include <cstdlib>
#include <vector>

#include <gtest/gtest.h>

namespace cc {
namespace {

/// Grey pixels of these values, with an alpha of 0.5.
std::vector<float> Greys(const std::vector<float>& values) {
    std::vector<float> rgba;
    for (const float v : values) {
        rgba.insert(rgba.end(), {v, v, v, 0.5f});
    }
    return rgba;
}

/// Keeps $OCIO out of a test, or sets it.
class Environment {
  public:
    explicit Environment(const char* config) {
        if (const char* old = std::getenv("OCIO")) {
            _old = old;
        }
        config ? setenv("OCIO", config, 1) : unsetenv("OCIO");
    }
    ~Environment() { _old.empty() ? unsetenv("OCIO") : setenv("OCIO", _old.c_str(), 1); }

  private:
    std::string _old;
};

TEST(DisplayTransform, DisabledChangesNothing) {
    std::vector<float> rgba = Greys({-1, 0.5f, 7});
    const std::vector<float> before = rgba;
    EXPECT_EQ(ApplyDisplayTransform(ColorCorrection::Disabled, {}, rgba.data(), 3, 1), "");
    EXPECT_EQ(rgba, before);
}

TEST(DisplayTransform, SrgbIsTheExactCurve) {
    std::vector<float> rgba = Greys({0, 0.001f, 0.0031308f, 0.18f, 0.5f, 1, 4, -2, NAN});
    ASSERT_EQ(ApplyDisplayTransform(ColorCorrection::SRGB, {}, rgba.data(), 3, 3), "");
    const float expected[] = {0, 0.01292f, 0.0404499f, 0.4613561f, 0.7353570f, 1, 1, 0, 0};
    for (int i = 0; i < 9; ++i) {
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(rgba[4 * i + c], expected[i], 1e-6f) << i;
        }
        EXPECT_EQ(rgba[4 * i + 3], 0.5f);
    }
}

TEST(DisplayTransform, OpenColorIOHasADefaultView) {
    const Environment none(nullptr);
    std::vector<float> rgba = Greys({0, 0.18f, 1, 100});
    ASSERT_EQ(ApplyDisplayTransform(ColorCorrection::OpenColorIO, {}, rgba.data(), 2, 2), "");
    for (int i = 0; i < 4; ++i) {
        EXPECT_TRUE(rgba[4 * i] > -0.05f && rgba[4 * i] < 1.05f) << rgba[4 * i];
        EXPECT_FLOAT_EQ(rgba[4 * i + 3], 0.5f);
        if (i > 0) {
            EXPECT_GT(rgba[4 * i], rgba[4 * i - 4]);
        }
    }
}

TEST(DisplayTransform, AnUntonemappedViewIsTheSrgbCurve) {
    const Environment none(nullptr);
    OpenColorIOOptions options;
    options.display = "sRGB - Display";
    options.view = "Un-tone-mapped";
    std::vector<float> rgba = {0.18f, 0.5f, 0.9f, 1};
    ASSERT_EQ(ApplyDisplayTransform(ColorCorrection::OpenColorIO, options, rgba.data(), 1, 1), "");
    // Holds only if the picture is taken for linear Rec.709, not for the configuration's ACEScg.
    std::vector<float> expected = {0.18f, 0.5f, 0.9f, 1};
    ApplyDisplayTransform(ColorCorrection::SRGB, {}, expected.data(), 1, 1);
    for (int c = 0; c < 4; ++c) {
        EXPECT_NEAR(rgba[c], expected[c], 1e-3f);
    }
}

TEST(DisplayTransform, ColorSpaceNamesTheSource) {
    const Environment none(nullptr);
    OpenColorIOOptions options;
    options.display = "sRGB - Display";
    options.view = "Un-tone-mapped";
    options.colorSpace = "ACEScg";
    std::vector<float> rgba = {0.1f, 0.5f, 0.1f, 1}, fromRec709 = rgba;
    ASSERT_EQ(ApplyDisplayTransform(ColorCorrection::OpenColorIO, options, rgba.data(), 1, 1), "");
    options.colorSpace = "";
    ApplyDisplayTransform(ColorCorrection::OpenColorIO, options, fromRec709.data(), 1, 1);
    EXPECT_GT(std::fabs(rgba[0] - fromRec709[0]), 0.05f);
}

TEST(DisplayTransform, SaysWhatIsWrongInOneLine) {
    const Environment none(nullptr);
    float rgba[4] = {};
    for (const OpenColorIOOptions& options : {OpenColorIOOptions{"no such display", "", "", ""},
                                              {"", "no such view", "", ""},
                                              {"", "", "no such space", ""},
                                              {"", "", "", "no such look"}}) {
        const std::string error =
            ApplyDisplayTransform(ColorCorrection::OpenColorIO, options, rgba, 1, 1);
        EXPECT_NE(error.find("no such"), std::string::npos) << error;
        EXPECT_EQ(error.find('\n'), std::string::npos);
    }
}

TEST(DisplayTransform, TakesTheConfigurationFromTheEnvironment) {
    float rgba[4] = {};
    {
        const Environment builtin("ocio://default");
        EXPECT_EQ(ApplyDisplayTransform(ColorCorrection::OpenColorIO, {}, rgba, 1, 1), "");
    }
    const Environment missing("/no/such/config.ocio");
    const std::string error = ApplyDisplayTransform(ColorCorrection::OpenColorIO, {}, rgba, 1, 1);
    EXPECT_NE(error.find("/no/such/config.ocio"), std::string::npos) << error;
}

}  // namespace
}  // namespace cc
