// SPDX-License-Identifier: MIT
#include <osgPagedTexture/TileGrid.h>
#include <osgPagedTexture/TileStore.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

using namespace osgPagedTexture;

namespace
{

bool overlaps(std::int64_t beginA, std::int64_t endA, std::int64_t beginB, std::int64_t endB)
{
    return beginA < endB && beginB < endA;
}

/// The same as TileGrid::getTouched(), tile by tile, from what each covers of level 0.
std::set<std::pair<std::int64_t, std::int64_t>> touchedOneByOne(const TileGrid& grid,
                                                                const PixelRect& pixels, int level)
{
    const std::int64_t texel = std::int64_t(1) << level;
    std::set<std::pair<std::int64_t, std::int64_t>> tiles;
    for (std::int64_t y = 0; y < grid.getRows(level); ++y)
    {
        for (std::int64_t x = 0; x < grid.getColumns(level); ++x)
        {
            const PixelRect tile = grid.getPixels({level, x, y});
            if (overlaps(tile.x * texel, (tile.x + tile.width) * texel, pixels.x,
                         pixels.x + pixels.width) &&
                overlaps(tile.y * texel, (tile.y + tile.height) * texel, pixels.y,
                         pixels.y + pixels.height))
            {
                tiles.insert({x, y});
            }
        }
    }
    return tiles;
}

} // namespace

TEST(TileGridTest, levelsHalveRoundedUpDownToOneTile)
{
    const TileGrid grid(1000, 601, 256, 8); // payload 240
    EXPECT_EQ(grid.getLevels(), 4);
    EXPECT_EQ(grid.getWidth(3), 125);
    EXPECT_EQ(grid.getHeight(1), 301);
    EXPECT_EQ(grid.getColumns(0), 5);
    EXPECT_EQ(grid.getRows(0), 3);
    EXPECT_EQ(grid.getTileCount(3), 1u);
    EXPECT_EQ(grid.getTileCount(), 15u + 6u + 2u + 1u);
}

TEST(TileGridTest, levelsOfClippedGridsGoDownToOnePixel)
{
    const TileGrid grid(1000, 601, 256, 1, TileGrid::Edge::Clipped);
    EXPECT_EQ(grid.getLevels(), 11); // Deep Zoom: ceil(log2(1000)) + 1
    EXPECT_EQ(grid.getWidth(10), 1);
    const PixelRect corner = grid.getPixels({0, 3, 2});
    EXPECT_EQ(corner.x, 3 * 254 - 1);
    EXPECT_EQ(corner.x + corner.width, 1000);
    EXPECT_EQ(corner.y + corner.height, 601);
    EXPECT_EQ(grid.getPixels({0, 0, 0}).width, 255);
}

TEST(TileGridTest, pictureOfOnePixelIsOneTile)
{
    for (const auto edge : {TileGrid::Edge::Padded, TileGrid::Edge::Clipped})
    {
        const TileGrid grid(1, 1, 64, 1, edge);
        EXPECT_EQ(grid.getTileCount(), 1u);
        EXPECT_EQ(grid.getPayloadPixels({0, 0, 0}).width, 1);
    }
}

TEST(TileGridTest, thinPicturesHaveOneRowOnAllLevels)
{
    const TileGrid grid(60000, 3, 256, 8);
    for (int level = 0; level < grid.getLevels(); ++level)
    {
        EXPECT_EQ(grid.getRows(level), 1);
    }
    EXPECT_EQ(grid.getColumns(0), 250);
}

TEST(TileGridTest, payloadsCoverEachPixelOnce)
{
    const TileGrid grid(530, 301, 64, 5);
    for (int level = 0; level < grid.getLevels(); ++level)
    {
        std::int64_t area = 0;
        for (std::int64_t y = 0; y < grid.getRows(level); ++y)
        {
            for (std::int64_t x = 0; x < grid.getColumns(level); ++x)
            {
                const PixelRect pixels = grid.getPayloadPixels({level, x, y});
                EXPECT_GT(pixels.width, 0);
                EXPECT_GT(pixels.height, 0);
                area += pixels.width * pixels.height;
            }
        }
        EXPECT_EQ(area, grid.getWidth(level) * grid.getHeight(level));
    }
}

TEST(TileGridTest, touchedTilesAreThoseWhosePixelsMeetTheChange)
{
    const TileGrid grid(530, 301, 64, 5);
    for (const PixelRect pixels : {PixelRect{0, 0, 1, 1},
                                   {529, 300, 1, 1},
                                   {49, 49, 1, 1},
                                   {48, 100, 12, 70},
                                   {200, 5, 330, 296},
                                   {53, 53, 54, 54}})
    {
        for (int level = 0; level < grid.getLevels(); ++level)
        {
            const TileRange range = grid.getTouched(pixels, level);
            std::set<std::pair<std::int64_t, std::int64_t>> tiles;
            for (std::int64_t y = range.y; y <= range.lastY; ++y)
            {
                for (std::int64_t x = range.x; x <= range.lastX; ++x)
                {
                    tiles.insert({x, y});
                }
            }
            EXPECT_EQ(tiles, touchedOneByOne(grid, pixels, level)) << pixels.x << " " << level;
        }
    }
}

TEST(TileGridTest, nothingIsTouchedByWhatLiesOutside)
{
    const TileGrid grid(530, 301, 64, 5);
    const TileRange range = grid.getTouched({530, 0, 10, 10}, 0);
    EXPECT_LT(range.lastX, range.x);
}

TEST(TileGridTest, walkFinishesEachRowOnceAndNotBeforeItsPixelsAreThere)
{
    for (const TileGrid& grid : {TileGrid(530, 3001, 64, 5), TileGrid(7, 999, 8, 3),
                                 TileGrid(3000, 500, 34, 1, TileGrid::Edge::Clipped)})
    {
        std::map<std::pair<int, std::int64_t>, int> seen;
        for (std::int64_t step = 0; step < grid.getRows(0); ++step)
        {
            for (const TileRow& row : grid.getRowsFinishedAt(step))
            {
                ++seen[{row.level, row.y}];
                const std::int64_t bottom = std::min(
                    (row.y + 1) * grid.getPayload() + grid.getBorder(), grid.getHeight(row.level));
                const std::int64_t needed = std::min(bottom << row.level, grid.getHeight());
                EXPECT_LE(needed, (step + 1) * grid.getPayload());
                EXPECT_GT(needed, step * grid.getPayload());
            }
        }
        std::size_t rows = 0;
        for (int level = 0; level < grid.getLevels(); ++level)
        {
            rows += std::size_t(grid.getRows(level));
        }
        EXPECT_EQ(seen.size(), rows);
        EXPECT_TRUE(
            std::all_of(seen.begin(), seen.end(), [](const auto& row) { return row.second == 1; }));
    }
}

TEST(TileGridTest, thousandMillionTilesKeepAllTheirBits)
{
    // 28,000^2 tiles of level 0, 1,045,352,000 of all levels: pixels and bytes are beyond 32 bits.
    const std::int64_t side = std::int64_t(28000) * 254;
    const TileGrid grid(side, side, 256, 1);
    EXPECT_EQ(grid.getTileCount(0), 784000000u);
    EXPECT_GT(grid.getTileCount(), 1000000000u);
    const TileKey last{0, 27999, 27999};
    EXPECT_EQ(grid.getPixels(last).x, std::int64_t(27999) * 254 - 1);
    EXPECT_TRUE(grid.contains(last));
    EXPECT_FALSE(grid.contains({0, 28000, 0}));
    const TileRange touched = grid.getTouched({side - 1, side - 1, 1, 1}, 0);
    EXPECT_EQ(touched.x, 27999);
    EXPECT_EQ(touched.lastY, 27999);
    EXPECT_FALSE(grid.getRowsFinishedAt(27999).empty());
}

TEST(TileGridTest, numbersWithoutSenseAreRefusedInOneLine)
{
    for (const auto& [width, height, side, border] :
         {std::tuple<std::int64_t, std::int64_t, int, int>{0, 5, 256, 1},
          {5, -1, 256, 1},
          {5, 5, 2, 1},
          {5, 5, 256, -1},
          {5, 5, 1 << 30, 1},
          {TileGrid::MaxSide + 1, 5, 256, 1},
          {TileGrid::MaxSide, 5, 64, 0}})
    {
        try
        {
            TileGrid(width, height, side, border);
            ADD_FAILURE() << width << " " << height << " " << side << " " << border;
        }
        catch (const TileStoreError& error)
        {
            EXPECT_EQ(error.getKind(), TileStoreError::Kind::Refused);
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
        }
    }
}
