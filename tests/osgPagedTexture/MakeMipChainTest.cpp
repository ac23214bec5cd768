// SPDX-License-Identifier: MIT
#include "BlockSamples.h"

#include <osgPagedTexture/MakeMipChain.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

using namespace osgPagedTexture;
using namespace blockSamples;

namespace
{

double toLight(double code)
{
    return code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
}

double toCode(double light)
{
    return light <= 0.0031308 ? light * 12.92 : 1.055 * std::pow(light, 1.0 / 2.4) - 0.055;
}

double overlap(double from, double to, int texel)
{
    return std::max(0.0, std::min(to, texel + 1.0) - std::max(from, double(texel)));
}

/// The mean light over the area of a texel of a level, from level 0, in double. RGB.
double meanLight(const Pixels& pixels, int width, int height, int x, int y, int c)
{
    const double sx = double(pixels.width) / width, sy = double(pixels.height) / height;
    double sum = 0.0, area = 0.0;
    for (int v = int(y * sy); v < pixels.height && v < (y + 1) * sy; ++v)
        for (int u = int(x * sx); u < pixels.width && u < (x + 1) * sx; ++u)
        {
            const double share =
                overlap(x * sx, (x + 1) * sx, u) * overlap(y * sy, (y + 1) * sy, v);
            sum += share * toLight(pixels.row(v)[u * pixels.channels + c] / 255.0);
            area += share;
        }
    return 255.0 * toCode(sum / area);
}

} // namespace

TEST(MakeMipChainTest, LevelsAreMeansOfLightAtEachSize)
{
    for (const auto& [width, height] : {std::pair{64, 64}, {37, 53}, {1, 100}, {129, 2}})
    {
        Pixels finer = photograph(width, height);
        for (int i = 1; i < levelCount(width, height); ++i)
        {
            const Pixels level = halve(finer, TexelUse::Color);
            ASSERT_EQ(level.width, levelSide(width, i));
            ASSERT_EQ(level.height, levelSide(height, i));
            for (int y = 0; y < level.height; ++y)
                for (int x = 0; x < level.width; ++x)
                    for (int c = 0; c < 3; ++c)
                        ASSERT_NEAR(level.row(y)[3 * x + c],
                                    meanLight(finer, level.width, level.height, x, y, c), 0.55)
                            << width << "x" << height << " level " << i; // rounded to a whole code
            finer = level;
        }
    }
}

TEST(MakeMipChainTest, ACheckerboardIsAsBrightAsItIs)
{
    const Pixels board = make(8, 8, 3, [](int x, int y, int) { return (x + y) & 1 ? 255 : 0; });
    EXPECT_EQ(halve(board, TexelUse::Color).bytes[0], 188);
    EXPECT_EQ(halve(board, TexelUse::Data).bytes[0], 128);
}

TEST(MakeMipChainTest, TransparentTexelsDoNotDarken)
{
    const Pixels pixels =
        make(2, 2, 4, [](int x, int, int c) { return x == 0 ? (c == 3 ? 255 : 200) : 0; });
    const Pixels half = halve(pixels, TexelUse::Color);
    EXPECT_NEAR(half.bytes[0], 200, 1);
    EXPECT_EQ(half.bytes[3], 128);
}

TEST(MakeMipChainTest, NormalsKeepTheirLength)
{
    // Tilted left and right by 45 degrees in turn: up, not a shorter up.
    const Pixels ridges = make(4, 4, 3,
                               [](int x, int, int c) {
                                   return c == 0 ? (x & 1 ? 218 : 37) : c == 1 ? 128 : 218;
                               });
    const Pixels half = halve(ridges, TexelUse::NormalMap);
    EXPECT_NEAR(half.bytes[0], 128, 1);
    EXPECT_NEAR(half.bytes[2], 255, 1);
    const Pixels opposite =
        make(2, 2, 3, [](int x, int, int c) { return c == 2 ? (x ? 255 : 0) : 127 + x; });
    EXPECT_EQ(halve(opposite, TexelUse::NormalMap).bytes[2], 255);
}

TEST(MakeMipChainTest, FormatsHoldNoMoreThanThereIs)
{
    const Pixels photo = photograph(8, 8);
    EXPECT_EQ(chooseFormat(photo, TexelUse::Color, false), BlockFormat::BC1);
    EXPECT_EQ(chooseFormat(photo, TexelUse::Color, true), BlockFormat::BC7);
    EXPECT_EQ(chooseFormat(photo, TexelUse::NormalMap, false), BlockFormat::BC5);
    const auto rgba = [](int alpha)
    { return make(8, 8, 4, [alpha](int x, int, int c) { return c == 3 ? alpha : 20 * x + c; }); };
    EXPECT_EQ(chooseFormat(rgba(255), TexelUse::Color, false), BlockFormat::BC1);
    EXPECT_EQ(chooseFormat(rgba(254), TexelUse::Color, false), BlockFormat::BC3);
    const Pixels grey = make(8, 8, 3, [](int x, int, int) { return 9 * x; });
    EXPECT_EQ(chooseFormat(grey, TexelUse::Color, false), BlockFormat::BC4);
}

TEST(MakeMipChainTest, AChainGoesDownToOneTexel)
{
    const MipChain chain =
        makeMipChain(photograph(50, 12), 1, 100, 25, TexelUse::Color, BlockFormat::BC1);
    ASSERT_EQ(chain.levels.size(), 6u); // 50, 25, 12, 6, 3, 1
    std::uint64_t bytes = 0;
    for (const auto& level : chain.levels)
        bytes += level.size();
    EXPECT_EQ(bytes, chain.bytes());
    EXPECT_EQ(chain.levels.back().size(), 8u);
}

TEST(MakeMipChainTest, PixelsOfAnotherLevelAreRefused)
{
    EXPECT_THROW(makeMipChain(photograph(8, 8), 0, 16, 16, TexelUse::Color, BlockFormat::BC1),
                 std::invalid_argument);
    EXPECT_THROW(makeMipChain(Pixels(), 0, 0, 0, TexelUse::Color, BlockFormat::BC1),
                 std::invalid_argument);
}
