// SPDX-License-Identifier: MIT
#include "BlockSamples.h"

#include <osgPagedTexture/BlockEncoder.h>

#include <gtest/gtest.h>

#include <stdexcept>

using namespace osgPagedTexture;
using namespace blockSamples;

namespace
{

const EncodeQuality allQualities[] = {EncodeQuality::Fast, EncodeQuality::Normal,
                                      EncodeQuality::Fine, EncodeQuality::Best};

Pixels roundTrip(const Pixels& pixels, BlockFormat format,
                 EncodeQuality quality = EncodeQuality::Normal)
{
    return decodeBlocks(encodeBlocks(pixels, format, quality), format, pixels.width, pixels.height);
}

double quality(const Pixels& pixels, BlockFormat format,
               EncodeQuality encodeQuality = EncodeQuality::Normal)
{
    return psnr(pixels, roundTrip(pixels, format, encodeQuality));
}

Pixels withAlpha(const Pixels& color, const Texel& alpha)
{
    return make(color.width, color.height, 4,
                [&](int x, int y, int c)
                { return c == 3 ? alpha(x, y, 3) : color.row(y)[x * color.channels + c]; });
}

} // namespace

// The floors are what stb_dxt has on these pictures (50.7, 43.3, 41.7, exact, 46.2, 44.2, 13.5 dB),
// less at most half a decibel.

TEST(BlockEncoderTest, BlocksOfOneColorAreAsGoodAsTheFormat)
{
    EXPECT_GT(quality(solidBlocks(), BlockFormat::BC1), 50.0);
}

TEST(BlockEncoderTest, FaintDetailStays)
{
    EXPECT_GT(quality(lowContrast(), BlockFormat::BC1), 43.0);
}

TEST(BlockEncoderTest, TwoColorsInABlockStayTwo)
{
    EXPECT_GT(quality(twoColors(), BlockFormat::BC1), 41.0);
}

TEST(BlockEncoderTest, BlackOnWhiteIsExact)
{
    EXPECT_EQ(roundTrip(blackAndWhite(), BlockFormat::BC1).bytes, blackAndWhite().bytes);
}

TEST(BlockEncoderTest, GradientsDoNotBand)
{
    EXPECT_GT(quality(gradient(), BlockFormat::BC1), 46.0);
}

TEST(BlockEncoderTest, DarkPicturesStay)
{
    EXPECT_GT(quality(veryDark(), BlockFormat::BC1), 44.2);
}

TEST(BlockEncoderTest, NoiseIsNoWorseThanItMustBe)
{
    EXPECT_GT(quality(noise(), BlockFormat::BC1), 13.5);
}

TEST(BlockEncoderTest, BetterQualityIsBetter)
{
    const Pixels pixels = photograph(256, 256);
    double last = 0.0;
    for (EncodeQuality encodeQuality : allQualities)
    {
        const double found = quality(pixels, BlockFormat::BC1, encodeQuality);
        EXPECT_GT(found, last) << int(encodeQuality);
        last = found;
    }
    // BC7 takes twice the room for this.
    const Pixels opaque = withAlpha(pixels, [](int, int, int) { return 255; });
    EXPECT_GT(quality(opaque, BlockFormat::BC7, EncodeQuality::Fast), last);
    EXPECT_GT(quality(opaque, BlockFormat::BC7, EncodeQuality::Best),
              quality(opaque, BlockFormat::BC7, EncodeQuality::Fast));
}

TEST(BlockEncoderTest, AllInstructionsGiveTheSameBytes)
{
    const Pixels pixels =
        withAlpha(photograph(257, 130), [](int x, int y, int) { return x * y & 255; });
    for (BlockFormat format :
         {BlockFormat::BC1, BlockFormat::BC3, BlockFormat::BC4, BlockFormat::BC5, BlockFormat::BC7})
        for (EncodeQuality encodeQuality : allQualities)
        {
            const auto baseline =
                encodeBlocks(pixels, format, encodeQuality, Instructions::Baseline);
            ASSERT_EQ(baseline.size(), levelBytes(format, 257, 130));
            for (Instructions wider : {Instructions::Avx2, Instructions::Avx512})
                EXPECT_TRUE(encodeBlocks(pixels, format, encodeQuality, wider) == baseline)
                    << formatName(format) << " " << int(encodeQuality) << " " << int(wider);
        }
}

TEST(BlockEncoderTest, EachSizeHasItsTexels)
{
    for (int width = 1; width <= 9; ++width)
        for (int height = 1; height <= 9; ++height)
        {
            const Pixels pixels =
                make(width, height, 3, [](int x, int y, int c) { return 20 * x + 10 * y + 5 * c; });
            for (BlockFormat format : {BlockFormat::BC1, BlockFormat::BC7})
            {
                const Pixels shown = roundTrip(pixels, format, EncodeQuality::Best);
                ASSERT_EQ(shown.width, width);
                ASSERT_EQ(shown.height, height);
                // BC1 has four colours for sixteen on a plane through RGB: a third of the way from
                // one of them to the next, 25 at most, and rounding to 5 bits.
                for (int y = 0; y < height; ++y)
                    for (int x = 0; x < width; ++x)
                        for (int c = 0; c < 3; ++c)
                            ASSERT_NEAR(shown.row(y)[x * shown.channels + c],
                                        20 * x + 10 * y + 5 * c,
                                        format == BlockFormat::BC1 ? 20 : 5)
                                << width << "x" << height << " " << formatName(format);
            }
        }
}

TEST(BlockEncoderTest, RowsAndColumnsKeepTheirPlaces)
{
    // Each block has a corner of its own colour: a turned or mirrored block is seen at once.
    const Pixels pixels = make(16, 16, 3,
                               [](int x, int y, int c)
                               {
                                   const bool corner = x % 4 == 3 && y % 4 == 0;
                                   return corner ? 248 : c == 0 ? 16 * (x / 4) : 16 * (y / 4);
                               });
    for (BlockFormat format : {BlockFormat::BC1, BlockFormat::BC7})
    {
        const Pixels shown = roundTrip(pixels, format);
        for (int y = 0; y < 16; ++y)
            for (int x = 0; x < 16; ++x)
                EXPECT_EQ(shown.row(y)[x * shown.channels] > 150, x % 4 == 3 && y % 4 == 0)
                    << formatName(format) << " " << x << "," << y;
    }
}

TEST(BlockEncoderTest, OpaqueFormatsHaveNoHoles)
{
    // In BC1 the order of its ends says whether an index is transparent.
    const Pixels pixels = withAlpha(noise(), [](int x, int, int) { return x & 1 ? 0 : 255; });
    const std::vector<std::uint8_t> blocks = encodeBlocks(pixels, BlockFormat::BC1);
    ASSERT_FALSE(blocks.empty());
    for (std::size_t at = 0; at < blocks.size(); at += 8)
    {
        const int first = blocks[at] | blocks[at + 1] << 8,
                  second = blocks[at + 2] | blocks[at + 3] << 8;
        const bool allFirst = !(blocks[at + 4] | blocks[at + 5] | blocks[at + 6] | blocks[at + 7]);
        ASSERT_TRUE(first > second || (first == second && allFirst)) << "block " << at / 8;
    }
    const Pixels shown = roundTrip(noise(), BlockFormat::BC7);
    for (std::size_t i = 3; i < shown.bytes.size(); i += 4)
        ASSERT_EQ(shown.bytes[i], 255);
}

TEST(BlockEncoderTest, HolesDoNotStainWhatIsAroundThem)
{
    const Pixels leaf =
        make(64, 64, 4,
             [](int x, int y, int c)
             {
                 const bool seen = (x / 3 + y / 5) % 2 == 0;
                 return c == 3 ? 255 * seen : seen ? (c == 1 ? 180 : 40) : (c == 1 ? 0 : 255);
             });
    for (BlockFormat format : {BlockFormat::BC3, BlockFormat::BC7})
    {
        const Pixels shown = roundTrip(leaf, format);
        for (std::size_t i = 0; i < leaf.bytes.size(); i += 4)
        {
            ASSERT_EQ(shown.bytes[i + 3], leaf.bytes[i + 3]) << formatName(format);
            for (int c = 0; leaf.bytes[i + 3] && c < 3; ++c)
                ASSERT_NEAR(shown.bytes[i + c], leaf.bytes[i + c], 4) // rounding to 5 bits
                    << formatName(format);
        }
    }
}

TEST(BlockEncoderTest, OneChannelIsFiner)
{
    const Pixels grey =
        make(256, 256, 1, [](int x, int y, int) { return (x * 3 + y * 5) / 8 & 255; });
    EXPECT_GT(quality(grey, BlockFormat::BC4), 46.0);
    const Pixels edge = make(
        64, 64, 1, [](int x, int y, int) { return std::min(255, std::max(0, 30 * (x - y + 4))); });
    // Flanked by 0 and 255, which the mode of six values has exactly: a fifth of 240 / 5 at most.
    EXPECT_GT(quality(edge, BlockFormat::BC4), 40.0);
    const Pixels ones = make(8, 8, 1, [](int x, int, int) { return x % 3 ? 255 : 0; });
    EXPECT_EQ(roundTrip(ones, BlockFormat::BC4).bytes, ones.bytes);
}

TEST(BlockEncoderTest, TwoChannelsAreTheFirstTwo)
{
    const Pixels normals =
        make(8, 8, 3, [](int, int, int c) { return c == 0   ? 100
                                                   : c == 1 ? 150
                                                            : 250; });
    const Pixels shown = roundTrip(normals, BlockFormat::BC5);
    ASSERT_EQ(shown.channels, 2);
    EXPECT_EQ(shown.bytes[0], 100);
    EXPECT_EQ(shown.bytes[1], 150);
    const Pixels greyAlpha = make(4, 4, 2, [](int, int, int c) { return c ? 77 : 33; });
    EXPECT_EQ(roundTrip(greyAlpha, BlockFormat::BC5).bytes[1], 77);
    EXPECT_EQ(roundTrip(greyAlpha, BlockFormat::RG8).bytes, greyAlpha.bytes);
}

TEST(BlockEncoderTest, WrongSizesAreRefused)
{
    EXPECT_TRUE(encodeBlocks(Pixels(), BlockFormat::BC1).empty());
    EXPECT_THROW(decodeBlocks({1, 2, 3}, BlockFormat::BC1, 4, 4), std::invalid_argument);
    EXPECT_THROW(decodeBlocks({}, BlockFormat::BC1, -1, 4), std::invalid_argument);
}
