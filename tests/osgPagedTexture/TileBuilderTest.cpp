// SPDX-License-Identifier: MIT
#include "AtlasReference.h"
#include "BuildSamples.h"
#include "TilePackSamples.h"

#include <osgPagedTexture/ImageFile.h>
#include <osgPagedTexture/TileExtract.h>

#include <gtest/gtest.h>

#include <map>

namespace
{

using namespace osgPagedTexture;

/// Photographs of odd sizes, in folders, grey ones among them, one wider than many tiles.
void addMany(PhotoWall& wall)
{
    wall.add("a/wide.png", 301, 47);
    wall.add("b/wide.png", 33, 120);
    wall.add("grey.png", 65, 65, 1);
    wall.add("single.png", 1, 1);
    wall.add("line.png", 2, 97);
    for (int i = 0; i < 9; ++i)
    {
        wall.add("small" + std::to_string(i) + ".png", 20 + 7 * i, 75 - 6 * i);
    }
}

/// Every tile of every level against the plain computation. Returns the tiles that were compared.
int compareAll(const PhotoWall& wall, const TileBuildSettings& settings, const TileReader& reader,
               double tolerance)
{
    const TileGrid& grid = reader.getSettings().grid;
    int compared = 0;
    LightPicture level = paintReference(wall.layout, wall.photos, settings.channels,
                                        settings.background, settings.linearLight);
    for (int i = 0; i < grid.getLevels(); ++i)
    {
        for (const TileKey& key : tilesOf(grid))
        {
            const TileData tile = reader.read(key);
            if (key.level == i && tile.kind == TileData::Kind::Encoded)
            {
                const double difference =
                    differenceOf(decodeTile(tile.bytes, "tile"), grid.getPixels(key), level);
                EXPECT_LE(difference, i == 0 ? 0.5 : tolerance)
                    << "level " << key.level << ", " << key.x << ", " << key.y;
                ++compared;
            }
        }
        level = halveReference(level);
    }
    return compared;
}

// Each level is rounded to whole code values, half a step at most, and handed on; what comes of
// four of them is off by no more than their mean, so that some levels add up to less than 2.
constexpr double Tolerance = 2.0;

TEST(TileBuilderTest, everyTileOfEveryLevelIsThatOfThePlainComputation)
{
    PhotoWall wall;
    addMany(wall);
    wall.place();
    const TileBuildReport report = buildInto(wall, smallTiles(), "store");
    const TilePackReader reader(wall.file("store"));
    EXPECT_EQ(compareAll(wall, smallTiles(), reader, Tolerance), int(report.encodedTiles));
    EXPECT_GT(report.encodedTiles, 100u);
    EXPECT_TRUE(report.failures.empty());
    EXPECT_GE(reader.getSettings().grid.getLevels(), 5);
}

TEST(TileBuilderTest, eachLevelIsTheRoundedMeanOfTheLevelBelow)
{
    PhotoWall wall;
    addMany(wall);
    wall.place();
    for (const bool linearLight : {true, false})
    {
        TileBuildSettings settings = smallTiles();
        settings.linearLight = linearLight;
        buildInto(wall, settings, "store");
        const TilePackReader reader(wall.file("store"));
        for (int level = 0; level + 1 < reader.getSettings().grid.getLevels(); ++level)
        {
            const LightPicture mean =
                halveReference(readLevel(reader, level, 3, settings.background, linearLight));
            const LightPicture made =
                readLevel(reader, level + 1, 3, settings.background, linearLight);
            double worst = 0.0;
            for (int y = 0; y < made.height; ++y)
                for (int x = 0; x < made.width; ++x)
                    for (int c = 0; c < 3; ++c)
                        worst = std::max(worst, std::abs(mean.code(x, y)[c] - made.code(x, y)[c]));
            // Half a step of rounding; light has 65,536 steps, a twentieth of one in the dark.
            EXPECT_LE(worst, 0.56) << "level " << level + 1 << (linearLight ? "" : ", plain");
        }
    }
}

TEST(TileBuilderTest, theStoreIsTheSameForAnyNumberOfThreads)
{
    PhotoWall wall;
    addMany(wall);
    wall.place();
    TileBuildSettings settings = smallTiles();
    settings.format.coding = TileCoding::Jpeg;
    settings.threads = 1;
    buildInto(wall, settings, "one", "one.mips");
    for (unsigned int threads : {2u, 3u, 8u})
    {
        settings.threads = threads;
        buildInto(wall, settings, "many", "many.mips");
        EXPECT_EQ(bytesOfFile(wall.file("many")), bytesOfFile(wall.file("one"))) << threads;
        EXPECT_EQ(bytesOfFile(wall.file("many.mips")), bytesOfFile(wall.file("one.mips")));
    }
}

TEST(TileBuilderTest, theFileIsAlreadyCompact)
{
    PhotoWall wall;
    addMany(wall);
    wall.place();
    buildInto(wall, smallTiles(), "store");
    const std::string built = bytesOfFile(wall.file("store"));
    compactTilePack(wall.file("store"));
    EXPECT_EQ(bytesOfFile(wall.file("store")), built);
    EXPECT_TRUE(verifyTileStore(wall.file("store")).empty());
}

TEST(TileBuilderTest, tilesOfNothingAreAbsentAndThoseOfOneColourAreUniform)
{
    PhotoWall wall;
    Pixels red(200, 100, 3);
    for (std::size_t i = 0; i < red.bytes.size(); i += 3)
    {
        red.bytes[i] = 200;
    }
    wall.addFile("red.jpg", encodeJpeg(red, {}), red);
    wall.place();
    wall.layout.width = 400;
    wall.layout.height = 300;
    TileBuildSettings settings = smallTiles();
    const TileBuildReport report = buildInto(wall, settings, "store");
    const TilePackReader reader(wall.file("store"));
    EXPECT_EQ(reader.read({0, 3, 1}).kind, TileData::Kind::Uniform);
    EXPECT_NEAR(reader.read({0, 3, 1}).color[0], 200, 1); // the JPEG's own loss
    EXPECT_EQ(reader.read({0, 14, 10}).kind, TileData::Kind::None);
    EXPECT_EQ(reader.read({0, 0, 10}).kind, TileData::Kind::None);
    EXPECT_EQ(report.encodedTiles + report.uniformTiles + report.absentTiles,
              reader.getSettings().grid.getTileCount());
    EXPECT_EQ(reader.getInfo().encodedTiles, report.encodedTiles);
    EXPECT_EQ(reader.getInfo().uniformTiles, report.uniformTiles);
    settings.everyTile = true;
    buildInto(wall, settings, "all");
    EXPECT_EQ(TilePackReader(wall.file("all")).read({0, 14, 10}),
              TileData::uniform({255, 255, 255, 255}));
}

TEST(TileBuilderTest, theKeptPixelsAreThoseOfTheCoarseLevels)
{
    PhotoWall wall;
    addMany(wall);
    wall.place();
    buildInto(wall, smallTiles(), "store", "kept");
    const TilePackReader store(wall.file("store")), kept(wall.file("kept"));
    const TileGrid& grid = kept.getSettings().grid;
    ASSERT_EQ(grid.getLevels() + TileBuilder::KeptLevel, store.getSettings().grid.getLevels());
    for (int level = 0; level < grid.getLevels(); ++level)
    {
        const TileColor white{255, 255, 255, 255};
        EXPECT_EQ(readLevel(kept, level, 3, white).values,
                  readLevel(store, level + TileBuilder::KeptLevel, 3, white).values);
    }
}

TEST(TileBuilderTest, rebuildingAnAreaMakesTheTilesAndPixelsOfTheWholeBuild)
{
    PhotoWall wall;
    addMany(wall);
    wall.place();
    const TileBuildSettings settings = smallTiles();
    buildInto(wall, settings, "store", "kept");
    const TilePackReader store(wall.file("store")), kept(wall.file("kept"));
    const LightPicture coarse = readLevel(kept, 0, 3, settings.background);
    TileBuilder builder(wall.layout, wall.folder(), settings);
    const TileGrid& grid = builder.getGrid();
    const PixelRect areas[] = {{0, 0, 1, 1},
                               {100, 37, 61, 83},
                               {grid.getWidth() - 20, grid.getHeight() - 9, 300, 300},
                               {-50, 60, 90, 1},
                               {0, 0, grid.getWidth(), grid.getHeight()}};
    for (const PixelRect& area : areas)
    {
        std::map<int, std::uint64_t> made;
        LevelPixels pixels;
        builder.rebuild(
            area,
            [&](const TileKey& key, const TileData& tile)
            {
                EXPECT_EQ(tile, store.read(key)) << key.level << ": " << key.x << ", " << key.y;
                ++made[key.level];
            },
            pixels);
        for (int level = 0; level < TileBuilder::KeptLevel; ++level)
        {
            const TileRange touched = grid.getTouched(area, level);
            EXPECT_EQ(made[level], std::uint64_t((touched.lastX - touched.x + 1) *
                                                 (touched.lastY - touched.y + 1)));
        }
        ASSERT_EQ(pixels.level, TileBuilder::KeptLevel);
        ASSERT_EQ(pixels.bytes.size(), std::size_t(pixels.area.width * pixels.area.height * 3));
        for (std::int64_t y = 0; y < pixels.area.height; ++y)
            for (std::int64_t x = 0; x < pixels.area.width; ++x)
                for (int c = 0; c < 3; ++c)
                    ASSERT_NEAR(coarse.code(int(pixels.area.x + x), int(pixels.area.y + y))[c],
                                pixels.bytes[std::size_t((y * pixels.area.width + x) * 3 + c)],
                                1e-6);
    }
    LevelPixels pixels;
    builder.rebuild({grid.getWidth(), 0, 5, 5}, {}, pixels); // outside: nothing to put
    EXPECT_TRUE(pixels.bytes.empty());
}

TEST(TileBuilderTest, losslessTilesHaveThePhotographsOwnBlocks)
{
    PhotoWall wall;
    JpegOptions full, halved, progressive;
    halved.fullChroma = false;
    progressive.progressive = true;
    int number = 0;
    for (const JpegOptions& options : {full, halved, progressive})
    {
        const std::string bytes = encodeJpeg(samplePicture(400, 300, 3, 5), options);
        wall.addFile("photo" + std::to_string(++number) + ".jpg", bytes,
                     readJpegBytes(bytes, "photo").pixels);
    }
    const std::string grey = encodeJpeg(samplePicture(300, 200, 1, 5), full);
    wall.addFile("grey.jpg", grey, readJpegBytes(grey, "photo").pixels);
    wall.add("other.png", 200, 300);
    TileBuildSettings settings = smallTiles();
    settings.tileSide = 64;
    settings.border = 8;
    settings.format.coding = TileCoding::Jpeg;
    settings.format.quality = 10; // of those that cannot be cut
    settings.lossless = true;
    wall.place(AtlasSettings::forTiles(settings.tileSide, settings.border));
    EXPECT_TRUE(buildInto(wall, settings, "store").failures.empty());
    const TilePackReader reader(wall.file("store"));
    const TileGrid& grid = reader.getSettings().grid;
    int inside = 0;
    for (std::size_t i = 0; i < 4; ++i)
    {
        const AtlasPhoto& photo = wall.layout.photos[i];
        const Pixels& pixels = wall.photos[i];
        for (const TileKey& key : tilesOf(grid))
        {
            const PixelRect area = grid.getPixels(key);
            if (key.level > 0 || area.x < photo.x || area.y < photo.y ||
                area.x + area.width > photo.x + photo.width ||
                area.y + area.height > photo.y + photo.height)
            {
                continue;
            }
            ++inside;
            const Pixels tile = decodeTile(reader.read(key).bytes, "tile");
            ASSERT_EQ(tile.channels, pixels.channels);
            // Halved colours are smoothed across the edge of what one decodes.
            const int ring = i == 1 ? 2 : 0;
            for (int y = ring; y < tile.height - ring; ++y)
                for (int x = ring; x < tile.width - ring; ++x)
                {
                    const int column = int(area.x - photo.x) + x;
                    const int row = pixels.height - 1 - (int(area.y - photo.y) + y);
                    for (int c = 0; c < tile.channels; ++c)
                        ASSERT_EQ(tile.row(tile.height - 1 - y)[x * tile.channels + c],
                                  pixels.row(row)[column * pixels.channels + c])
                            << i << ": " << x << ", " << y;
                }
        }
    }
    EXPECT_GT(inside, 80);
    // Coarser levels come of the decoded pixels, and an area again gives the same bytes.
    LevelPixels coarse;
    TileBuilder(wall.layout, wall.folder(), settings)
        .rebuild(
            {150, 120, 200, 90},
            [&](const TileKey& key, const TileData& tile) { EXPECT_EQ(tile, reader.read(key)); },
            coarse);
}

TEST(TileBuilderTest, deepZoomTilesEndWithThePicture)
{
    PhotoWall wall;
    addMany(wall);
    wall.place();
    TileBuildSettings settings = smallTiles();
    settings.edge = TileGrid::Edge::Clipped;
    buildInto(wall, settings, "store");
    const TilePackReader reader(wall.file("store"));
    EXPECT_EQ(reader.getSettings().grid.getWidth(reader.getSettings().grid.getLevels() - 1), 1);
    // More levels, more roundings.
    EXPECT_GT(compareAll(wall, settings, reader, Tolerance + 1.0), 100);
}

} // namespace
