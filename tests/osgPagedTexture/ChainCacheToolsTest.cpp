// SPDX-License-Identifier: MIT
// An entry is a DDS file that other programs open: OpenImageIO and OSG's own plugin.
#include "ChainSamples.h"

#include <osgPagedTexture/ChainCache.h>

#include <support/TemporaryFolder.h>

#include <osg/Image>
#include <osgDB/ReadFile>

#include <OpenImageIO/imageio.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

using namespace osgPagedTexture;

namespace
{

constexpr BlockFormat AllFormats[] = {BlockFormat::R8,    BlockFormat::RG8, BlockFormat::RGB8,
                                      BlockFormat::RGBA8, BlockFormat::BC1, BlockFormat::BC3,
                                      BlockFormat::BC4,   BlockFormat::BC5, BlockFormat::BC7};

/// Blocks of one colour each, of which every decoder makes the same texels: 565 colour and a first
/// end value of each alpha or channel, all indices 0.
void makeSolid(MipChain& chain)
{
    const auto solidColour = [](std::uint8_t* block)
    {
        block[1] |= 0x80; // the first colour is the larger one
        block[2] = block[3] = 0;
        std::fill(block + 4, block + 8, 0);
    };
    const auto solidChannel = [](std::uint8_t* block) { std::fill(block + 2, block + 8, 0); };
    for (std::vector<std::uint8_t>& level : chain.levels)
    {
        for (std::size_t at = 0; at < level.size(); at += unitBytes(chain.format))
        {
            std::uint8_t* block = level.data() + at;
            const bool channelFirst = chain.format != BlockFormat::BC1;
            channelFirst ? solidChannel(block) : solidColour(block);
            if (chain.format == BlockFormat::BC3)
            {
                solidColour(block + 8);
            }
            else if (chain.format == BlockFormat::BC5)
            {
                solidChannel(block + 8);
            }
        }
    }
}

/// The texel of a chain of plain texels or solid blocks; as many channels as it has.
std::vector<int> texelOf(const MipChain& chain, int level, int x, int y)
{
    const std::vector<std::uint8_t>& bytes = chain.levels[level];
    const int width = levelSide(chain.width, level);
    const int unit = unitBytes(chain.format);
    if (!isBlocked(chain.format))
    {
        const std::uint8_t* texel = bytes.data() + (std::size_t(y) * width + x) * unit;
        return std::vector<int>(texel, texel + unit);
    }
    const std::uint8_t* block =
        bytes.data() + (std::size_t(y / 4) * ((width + 3) / 4) + x / 4) * unit;
    if (chain.format == BlockFormat::BC4)
    {
        return {block[0]};
    }
    if (chain.format == BlockFormat::BC5)
    {
        return {block[0], block[8]};
    }
    const std::uint8_t* colour = chain.format == BlockFormat::BC3 ? block + 8 : block;
    const int packed = colour[0] | colour[1] << 8;
    const int red = packed >> 11, green = packed >> 5 & 63, blue = packed & 31;
    std::vector<int> texel = {red << 3 | red >> 2, green << 2 | green >> 4, blue << 3 | blue >> 2};
    if (chain.format == BlockFormat::BC3)
    {
        texel.push_back(block[0]);
    }
    return texel;
}

} // namespace

class ChainCacheToolsTest : public testing::TestWithParam<BlockFormat>
{
protected:
    void SetUp() override
    {
        chain = sampleChain(GetParam(), 44, 28);
        if (isBlocked(GetParam()) && GetParam() != BlockFormat::BC7)
        {
            makeSolid(chain);
        }
        ChainCache cache(folder.file("cache"), 1 << 30);
        ASSERT_TRUE(cache.write(key, chain));
        path = cache.getPath(key);
    }

    support::TemporaryFolder folder;
    const ContentHash key = chainKey(hashText("a"), "b");
    std::string path;
    MipChain chain;
};

TEST_P(ChainCacheToolsTest, OpenImageIOReadsTheTexelsOfEachLevel)
{
    const auto input = OIIO::ImageInput::open(path);
    ASSERT_TRUE(input) << OIIO::geterror();
    EXPECT_EQ(input->format_name(), std::string("dds"));
    for (int level = 0; level < levelCount(44, 28); ++level)
    {
        ASSERT_TRUE(input->seek_subimage(0, level)) << level;
        const OIIO::ImageSpec& spec = input->spec();
        ASSERT_EQ(spec.width, levelSide(44, level));
        ASSERT_EQ(spec.height, levelSide(28, level));
        std::vector<std::uint8_t> texels(std::size_t(spec.width) * spec.height * spec.nchannels);
        ASSERT_TRUE(input->read_image(0, level, 0, spec.nchannels, OIIO::TypeUInt8, texels.data()))
            << input->geterror();
        for (int i = 0; GetParam() != BlockFormat::BC7 && i < spec.width * spec.height; ++i)
        {
            const std::vector<int> expected = texelOf(chain, level, i % spec.width, i / spec.width);
            const std::size_t channels = std::min<std::size_t>(expected.size(), spec.nchannels);
            for (std::size_t c = 0; c < channels; ++c)
            {
                // 1: decoders round the 5 and 6 bits of a colour each in their way.
                ASSERT_NEAR(texels[i * spec.nchannels + c], expected[c],
                            isBlocked(GetParam()) ? 1 : 0)
                    << "level " << level << " texel " << i << " channel " << c;
            }
        }
    }
}

TEST_P(ChainCacheToolsTest, OsgsOwnPluginReadsTheSameBytes)
{
    const osg::ref_ptr<osg::Image> image = osgDB::readRefImageFile(path);
    if (GetParam() == BlockFormat::BC7)
    {
        EXPECT_FALSE(image) << "OSG 3.6.5 knows no BC7: if it does now, compare it too";
        return;
    }
    ASSERT_TRUE(image);
    EXPECT_EQ(image->s(), 44);
    EXPECT_EQ(image->t(), 28);
    ASSERT_EQ(image->getNumMipmapLevels(), 6u);
    for (int level = 0; level < 6; ++level)
    {
        const std::vector<std::uint8_t>& expected = chain.levels[level];
        EXPECT_EQ(std::memcmp(image->getMipmapData(level), expected.data(), expected.size()), 0)
            << level;
    }
}

INSTANTIATE_TEST_SUITE_P(Formats, ChainCacheToolsTest, testing::ValuesIn(AllFormats),
                         [](const auto& one) { return formatName(one.param); });
