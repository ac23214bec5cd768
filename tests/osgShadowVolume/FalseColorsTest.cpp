// SPDX-License-Identifier: MIT
#include <osgShadowVolume/FalseColors.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace osgShadowVolume;

namespace
{

/// CIELAB lightness of an sRGB colour.
double lightnessOf(const glm::vec3& color)
{
    glm::dvec3 linear;
    for (int i = 0; i < 3; ++i)
        linear[i] =
            color[i] <= 0.04045f ? color[i] / 12.92 : std::pow((color[i] + 0.055) / 1.055, 2.4);
    const double y = glm::dot(glm::dvec3(0.2126, 0.7152, 0.0722), linear);
    return y > 216.0 / 24389.0 ? 116.0 * std::cbrt(y) - 16.0 : y * 24389.0 / 27.0;
}

} // namespace

TEST(FalseColorsTest, lightnessRisesEvenly)
{
    // Interpolation between 33 entries, in sRGB, bends it by less than 0.3. A colour outside of
    // sRGB would be cut and be off by more.
    for (int i = 0; i <= 1000; ++i)
        EXPECT_NEAR(lightnessOf(falseColor(i / 1000.0)), 14.0 + 78.0 * i / 1000.0, 0.3) << i;
}

TEST(FalseColorsTest, neighboursShowNoContour)
{
    // 3 of 255 in a channel over 1/256 of the range.
    for (int i = 0; i < 256; ++i)
    {
        const glm::vec3 step = falseColor((i + 1) / 256.0) - falseColor(i / 256.0);
        for (int channel = 0; channel < 3; ++channel)
            EXPECT_LT(std::abs(step[channel]), 3.0 / 255.0) << i;
    }
}

TEST(FalseColorsTest, whatLiesOutsideHasTheColourOfTheNearerEnd)
{
    EXPECT_EQ(falseColor(-1.0), falseColor(0.0));
    EXPECT_EQ(falseColor(7.0), falseColor(1.0));
    EXPECT_EQ(falseColor(std::numeric_limits<double>::infinity()), falseColor(1.0));
    EXPECT_EQ(falseColor(std::nan("")), falseColor(0.0));
}

TEST(FalseColorsTest, roundValuesAreOneTwoFive)
{
    EXPECT_DOUBLE_EQ(roundUp(0.011), 0.02);
    EXPECT_DOUBLE_EQ(roundUp(1.0), 1.0);
    EXPECT_DOUBLE_EQ(roundUp(1.01), 2.0);
    EXPECT_DOUBLE_EQ(roundUp(300.0), 500.0);
    EXPECT_DOUBLE_EQ(roundUp(501.0), 1000.0);
    EXPECT_DOUBLE_EQ(roundUp(1e5), 1e5);
    EXPECT_EQ(roundUp(0.0), 1.0);
    EXPECT_EQ(roundUp(-3.0), 1.0);
    EXPECT_EQ(roundUp(std::nan("")), 1.0);
    EXPECT_EQ(roundUp(std::numeric_limits<double>::infinity()), 1.0);
}
