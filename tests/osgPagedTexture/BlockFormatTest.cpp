// SPDX-License-Identifier: MIT
#include <osgPagedTexture/BlockFormat.h>

#include <gtest/gtest.h>

#include <limits>

using namespace osgPagedTexture;

TEST(BlockFormatTest, SidesHalveRoundedDownToOne)
{
    EXPECT_EQ(levelSide(5, 0), 5);
    EXPECT_EQ(levelSide(5, 1), 2);
    EXPECT_EQ(levelSide(5, 2), 1);
    EXPECT_EQ(levelSide(5, 3), 1);
    EXPECT_EQ(levelSide(16384, 40), 1);
}

TEST(BlockFormatTest, TheLongerSideSaysHowManyLevels)
{
    EXPECT_EQ(levelCount(1, 1), 1);
    EXPECT_EQ(levelCount(1, 16384), 15);
    EXPECT_EQ(levelCount(1023, 4), 10);
    EXPECT_EQ(levelCount(1024, 4), 11);
}

TEST(BlockFormatTest, BlocksAreWholeAtEverySize)
{
    EXPECT_EQ(levelBytes(BlockFormat::BC1, 1, 1), 8u);
    EXPECT_EQ(levelBytes(BlockFormat::BC1, 4, 4), 8u);
    EXPECT_EQ(levelBytes(BlockFormat::BC7, 5, 4), 32u);
    EXPECT_EQ(levelBytes(BlockFormat::RGB8, 5, 4), 60u);
    EXPECT_EQ(levelBytes(BlockFormat::RGBA8, 65536, 65536), std::uint64_t(1) << 34);
}

TEST(BlockFormatTest, AChainIsTheSumOfItsLevels)
{
    EXPECT_EQ(chainBytes(BlockFormat::BC1, 4, 4, 0), 24u);
    EXPECT_EQ(chainBytes(BlockFormat::BC1, 4, 4, 1), 16u);
    EXPECT_EQ(chainBytes(BlockFormat::R8, 4, 2, 0), 8u + 2u + 1u);
    EXPECT_EQ(chainBytes(BlockFormat::R8, 4, 2, 3), 0u);
}
