// SPDX-License-Identifier: MIT
#include "PictureFiles.h"

#include <osgPagedTexture/ImageFile.h>
#include <osgPagedTexture/TileExtract.h>
#include <osgPagedTexture/TilePack.h>

#include <support/ResidentMemory.h>
#include <support/TemporaryFolder.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

using namespace osgPagedTexture;
namespace fs = std::filesystem;

namespace
{

/// Where a tile's pixels come from in the tests: a colour for each tile, so that borders show.
TileColor colorOfTile(const TileKey& key)
{
    return {std::uint8_t(40 + 30 * key.x), std::uint8_t(40 + 30 * key.y),
            std::uint8_t(40 * key.level), 255};
}

std::string jpegOf(const TileColor& color, int side)
{
    Pixels pixels(side, side, 3);
    for (std::size_t i = 0; i < pixels.bytes.size(); ++i)
    {
        pixels.bytes[i] = color[i % 3];
    }
    return encodeJpeg(pixels, {100});
}

class TileExtractTest : public testing::Test
{
protected:
    TileExtractTest()
    {
        TileStoreSettings settings;
        settings.grid = TileGrid(300, 200, 64, 2); // payload 60: 5 x 4 tiles
        TilePackWriter writer(path, settings, {});
        for (int level = 0; level < 2; ++level)
        {
            for (std::int64_t y = 0; y < settings.grid.getRows(level); ++y)
            {
                for (std::int64_t x = 0; x < settings.grid.getColumns(level); ++x)
                {
                    const TileKey key{level, x, y};
                    if (x == 2)
                    {
                        writer.put(key, TileData::uniform(colorOfTile(key)));
                    }
                    else if (x != 3)
                    {
                        writer.put(key, TileData::encoded(jpegOf(colorOfTile(key), 64)));
                    }
                }
            }
        }
        writer.commit();
    }
    std::string extract(int level, const PixelRect& region, const std::string& name = "out.png",
                        const ExtractSettings& settings = {})
    {
        const std::string out = folder.file(name);
        extractRegion(TilePackReader(path), level, region, settings, out);
        return out;
    }

    const support::TemporaryFolder folder;
    const std::string path = folder.file("store.tiles");
};

} // namespace

TEST_F(TileExtractTest, regionOverTilesOfAllKindsHasTheirPayloads)
{
    const PixelRect region{50, 30, 200, 100};
    const Pixels pixels = readImageFile(extract(0, region)).pixels;
    ASSERT_EQ(pixels.width, 200);
    ASSERT_EQ(pixels.height, 100);
    for (int y = 0; y < 100; ++y)
    {
        for (int x = 0; x < 200; ++x)
        {
            const TileKey key{0, (x + 50) / 60, (y + 30) / 60};
            const TileColor color = key.x == 3 ? TileColor{255, 255, 255, 255} : colorOfTile(key);
            const std::uint8_t* pixel = pixels.row(99 - y) + 3 * x;
            for (int channel = 0; channel < 3; ++channel)
            {
                // One step: the rounding of JPEG's colour space.
                ASSERT_NEAR(pixel[channel], color[channel], 1) << x << " " << y;
            }
        }
    }
}

TEST_F(TileExtractTest, regionIsCutToItsLevel)
{
    const Pixels pixels = readImageFile(extract(1, {-10, 90, 1000, 1000})).pixels;
    EXPECT_EQ(pixels.width, 150);
    EXPECT_EQ(pixels.height, 10);
}

TEST_F(TileExtractTest, alphaAndOtherFormatsAreWritten)
{
    ExtractSettings settings;
    settings.channels = 4;
    settings.background = {0, 0, 0, 0};
    const Pixels pixels = readImageFile(extract(0, {0, 0, 300, 60}, "out.tif", settings)).pixels;
    ASSERT_EQ(pixels.channels, 4);
    EXPECT_EQ(pixels.bytes[3], 255);
    EXPECT_EQ(pixels.bytes[4 * 200 + 3], 0);
}

TEST_F(TileExtractTest, badRequestsAreRefusedInOneLineAndLeaveNothing)
{
    for (const auto& [level, region, name] :
         {std::tuple<int, PixelRect, std::string>{9, {0, 0, 10, 10}, "a.png"},
          {-1, {0, 0, 10, 10}, "b.png"},
          {0, {300, 0, 10, 10}, "c.png"},
          {0, {0, 0, 0, 10}, "d.png"},
          {0, {INT64_MAX, INT64_MAX, INT64_MAX, 1}, "e.png"},
          {0, {0, 0, 10, 10}, "f.nonsense"},
          {0, {0, 0, 10, 10}, "no/such/folder.png"}})
    {
        try
        {
            extract(level, region, name);
            ADD_FAILURE() << name;
        }
        catch (const TileStoreError& error)
        {
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
            EXPECT_NE(std::string(error.what()).find("; "), std::string::npos) << error.what();
        }
        EXPECT_FALSE(fs::exists(folder.file(name)));
    }
}

TEST_F(TileExtractTest, damagedTileLeavesNoPicture)
{
    {
        TilePackWriter writer(path, {});
        writer.put({0, 1, 1}, TileData::encoded(jpegOf({}, 32)));
        writer.put({0, 1, 2}, TileData::encoded("no picture"));
        writer.commit();
    }
    EXPECT_THROW(extract(0, {0, 0, 300, 100}), TileStoreError); // has another size
    EXPECT_THROW(extract(0, {0, 120, 300, 60}), TileStoreError);
    EXPECT_FALSE(fs::exists(folder.file("out.png")));
}

TEST_F(TileExtractTest, memoryIsARowOfTilesWhateverTheHeight)
{
    TileStoreSettings settings;
    settings.grid = TileGrid(512, 512 * 512, 64, 0); // 403 MB of pixels
    const std::string tall = folder.file("tall.tiles");
    TilePackWriter::Options options;
    options.durable = false;
    TilePackWriter writer(tall, settings, options);
    for (std::int64_t y = 0; y < settings.grid.getRows(0); ++y)
    {
        for (std::int64_t x = 0; x < 8; ++x)
        {
            writer.put({0, x, y}, TileData::uniform({std::uint8_t(x), std::uint8_t(y), 7, 255}));
        }
    }
    writer.commit();
    const TilePackReader reader(tall);
    const double before = support::residentMiB();
    double most = before;
    std::int64_t rows = 0, wrong = 0;
    readRegion(reader, 0, {0, 0, 512, 512 * 512}, {},
               [&](const std::uint8_t* row)
               {
                   wrong += row[3 * 511] != 7 || row[3 * 511 + 1] != std::uint8_t(rows / 64);
                   if (rows++ % 4096 == 0)
                   {
                       most = std::max(most, support::residentMiB());
                   }
               });
    EXPECT_EQ(rows, 512 * 512);
    EXPECT_EQ(wrong, 0);
    // The reader's pages of the index are some of it.
    EXPECT_LT(most - before, 8.0);
}
