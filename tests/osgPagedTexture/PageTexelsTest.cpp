// SPDX-License-Identifier: MIT
#include "PictureFiles.h"

#include <osgPagedTexture/PageTexels.h>

#include <gtest/gtest.h>

#include <algorithm>

using namespace osgPagedTexture;

namespace
{

PageFormat plain(int side)
{
    return {BlockFormat::RGBA8, side, EncodeQuality::Normal, {1, 2, 3, 4}};
}

/// A picture whose top left pixel is 40, 60 and whose colours grow to the right and downwards.
Pixels slope(int width, int height)
{
    Pixels pixels(width, height, 3);
    for (int y = 0; y < height; ++y)
    {
        for (int x = 0; x < width; ++x)
        {
            std::uint8_t* pixel = pixels.row(height - 1 - y) + std::size_t(x) * 3;
            pixel[0] = std::uint8_t(40 + x);
            pixel[1] = std::uint8_t(60 + y);
            pixel[2] = 100;
        }
    }
    return pixels;
}

const std::uint8_t* texel(const PageTexels& page, int side, int x, int y)
{
    return page.data() + (std::size_t(y) * side + x) * 4;
}

void expectSlope(const PageTexels& page, int side, int x, int y, int fromX, int fromY)
{
    // JPEG at its best quality: some code values.
    EXPECT_NEAR(texel(page, side, x, y)[0], 40 + fromX, 3) << x << ", " << y;
    EXPECT_NEAR(texel(page, side, x, y)[1], 60 + fromY, 3) << x << ", " << y;
    EXPECT_EQ(texel(page, side, x, y)[3], 255);
}

} // namespace

TEST(PageTexelsTest, theFirstRowOfAPageIsTheTopOfItsTile)
{
    const TileGrid grid(200, 200, 32, 2);
    const TileData tile = TileData::encoded(encodeJpeg(slope(32, 32), {100}));
    const PageTexels page = makePage(tile, grid, {0, 1, 1}, plain(32), "tile");
    ASSERT_EQ(page.size(), 32u * 32 * 4);
    for (const int x : {0, 10, 31})
    {
        for (const int y : {0, 20, 31})
        {
            expectSlope(page, 32, x, y, x, y);
        }
    }
}

TEST(PageTexelsTest, aTileThatEndsWithThePictureIsPutInItsPlaceAndItsEdgeRepeated)
{
    // Deep Zoom: 28 pixels and 2 of each neighbour that there is.
    const TileGrid grid(50, 40, 32, 2, TileGrid::Edge::Clipped);
    const PixelRect first = grid.getPixels({0, 0, 0});
    ASSERT_EQ(first.width, 30);
    const TileData tile = TileData::encoded(encodeJpeg(slope(30, 30), {100}));
    const PageTexels page = makePage(tile, grid, {0, 0, 0}, plain(32), "tile");
    expectSlope(page, 32, 2, 2, 0, 0);
    expectSlope(page, 32, 0, 0, 0, 0);
    expectSlope(page, 32, 31, 31, 29, 29);

    const PixelRect last = grid.getPixels({0, 1, 1});
    ASSERT_EQ(last.width, 24);
    ASSERT_EQ(last.height, 14);
    const TileData rest = TileData::encoded(encodeJpeg(slope(24, 14), {100}));
    const PageTexels end = makePage(rest, grid, {0, 1, 1}, plain(32), "tile");
    expectSlope(end, 32, 0, 0, 0, 0);
    expectSlope(end, 32, 31, 31, 23, 13);
}

TEST(PageTexelsTest, aSideThatIsNoWholeNumberOfBlocksIsRoundedUp)
{
    const TileGrid grid(200, 200, 30, 1);
    EXPECT_EQ(pageSideOf(grid, BlockFormat::RGBA8), 30);
    EXPECT_EQ(pageSideOf(grid, BlockFormat::BC1), 32);
    const PageFormat format{BlockFormat::BC1, 32, EncodeQuality::Normal, {}};
    const TileData tile = TileData::encoded(encodeJpeg(slope(30, 30), {100}));
    const PageTexels page = makePage(tile, grid, {0, 1, 1}, format, "tile");
    ASSERT_EQ(page.size(), format.bytes());
    const Pixels pixels = decodeBlocks(page, BlockFormat::BC1, 32, 32);
    EXPECT_NEAR(pixels.row(0)[0], 40, 8);
    EXPECT_NEAR(pixels.row(29)[29 * 3 + 1], 60 + 29, 8);
    EXPECT_NEAR(pixels.row(31)[31 * 3 + 1], 60 + 29, 8);
}

TEST(PageTexelsTest, tilesWithoutAPictureHaveTheirColourOrTheBackgrounds)
{
    const TileGrid grid(200, 200, 16, 2);
    const PageTexels color =
        makePage(TileData::uniform({9, 8, 7, 6}), grid, {0, 0, 0}, plain(16), "tile");
    EXPECT_EQ(texel(color, 16, 15, 15)[3], 6);
    const PageTexels nothing = makePage({}, grid, {0, 0, 0}, plain(16), "tile");
    EXPECT_EQ(texel(nothing, 16, 7, 7)[2], 3);
}

TEST(PageTexelsTest, aTileOfAnotherSizeIsRefusedByName)
{
    const TileGrid grid(200, 200, 32, 2);
    const TileData tile = TileData::encoded(encodeJpeg(slope(30, 32), {100}));
    try
    {
        makePage(tile, grid, {0, 1, 1}, plain(32), "'a.tiles': tile 1, 1 of level 0");
        FAIL();
    }
    catch (const TileStoreError& error)
    {
        EXPECT_EQ(error.getKind(), TileStoreError::Kind::Damaged);
        EXPECT_EQ(std::string(error.what()),
                  "osgPagedTexture::VirtualPager: 'a.tiles': tile 1, 1 of level 0 has 30 x 32 "
                  "pixels instead of 32 x 32; build the store anew");
    }
}

TEST(PageTexelsTest, storesOfPhotographsNeedNoAlpha)
{
    TileStoreSettings settings;
    EXPECT_EQ(pageFormatOf(settings), BlockFormat::BC1);
    settings.format = "png";
    EXPECT_EQ(pageFormatOf(settings), BlockFormat::BC7);
}
