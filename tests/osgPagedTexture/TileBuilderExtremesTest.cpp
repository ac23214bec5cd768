// SPDX-License-Identifier: MIT
// Photographs and disks that are not as one hopes.
#include "AtlasReference.h"
#include "BuildSamples.h"
#include "TilePackSamples.h"

#include <osgPagedTexture/ImageFile.h>
#include <osgPagedTexture/TileExtract.h>

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include <csignal>
#include <sys/resource.h>

namespace
{

using namespace osgPagedTexture;

const TileColor White{255, 255, 255, 255};

/// The largest difference of level 0 of a store and what its photographs show.
double worstOfLevel0(const PhotoWall& wall, const std::string& store,
                     const TileBuildSettings& settings)
{
    const TilePackReader reader(wall.file(store));
    const LightPicture expected = paintReference(wall.layout, wall.photos, settings.channels,
                                                 settings.background, settings.linearLight);
    const LightPicture made =
        readLevel(reader, 0, settings.channels, settings.background, settings.linearLight);
    double worst = 0.0;
    for (int y = 0; y < made.height; ++y)
        for (int x = 0; x < made.width; ++x)
            for (int c = 0; c < settings.channels; ++c)
                worst = std::max(worst, std::abs(made.code(x, y)[c] - expected.code(x, y)[c]));
    return worst;
}

TEST(TileBuilderExtremesTest, noPhotographsAreAStoreOfNothing)
{
    PhotoWall wall;
    wall.place();
    const TileBuildReport report = buildInto(wall, smallTiles(), "store", "kept");
    EXPECT_EQ(report.encodedTiles + report.uniformTiles, 0u);
    EXPECT_EQ(TilePackReader(wall.file("store")).read({0, 0, 0}).kind, TileData::Kind::None);
}

TEST(TileBuilderExtremesTest, aSinglePixelFillsItsTile)
{
    PhotoWall wall;
    wall.add("pixel.png", 1, 1);
    AtlasSettings tight;
    tight.padding = 0;
    tight.alignment = 1;
    wall.place(tight);
    buildInto(wall, smallTiles(), "store");
    const TileData tile = TilePackReader(wall.file("store")).read({0, 0, 0});
    ASSERT_EQ(tile.kind, TileData::Kind::Uniform);
    for (int c = 0; c < 3; ++c)
        EXPECT_EQ(tile.color[c], wall.photos[0].bytes[c]);
}

TEST(TileBuilderExtremesTest, aPhotographOf60000By3Pixels)
{
    PhotoWall wall;
    wall.add("long.png", 60000, 3);
    wall.add("small.png", 50, 40);
    wall.place();
    TileBuildSettings settings = smallTiles();
    settings.linearLight = false; // the plain computation is fast then
    buildInto(wall, settings, "store");
    EXPECT_EQ(worstOfLevel0(wall, "store", settings), 0.0);
    EXPECT_TRUE(verifyTileStore(wall.file("store")).empty());
}

TEST(TileBuilderExtremesTest, sameNamesInDifferentFoldersAreDifferentPhotographs)
{
    PhotoWall wall;
    wall.add("north/wall.png", 90, 60);
    wall.add("south/wall.png", 90, 60);
    wall.place();
    buildInto(wall, smallTiles(), "store");
    EXPECT_EQ(worstOfLevel0(wall, "store", smallTiles()), 0.0);
}

TEST(TileBuilderExtremesTest, jpegsOfEveryKindShowWhatTheyShow)
{
    PhotoWall wall;
    const Pixels picture = samplePicture(150, 90, 3, 5);
    JpegOptions progressive, cmyk, turned, strange;
    progressive.progressive = true;
    cmyk.cmyk = true;
    turned.orientation = 6;
    strange.cmyk = true;
    strange.adobe = false;
    int number = 0;
    for (const JpegOptions& options : {JpegOptions(), progressive, cmyk, turned, strange})
    {
        const std::string bytes = encodeJpeg(picture, options);
        wall.addFile("photo" + std::to_string(++number) + ".jpg", bytes,
                     readJpegBytes(bytes, "photo").pixels);
    }
    const std::string grey = encodeJpeg(samplePicture(70, 80, 1, 6), {});
    wall.addFile("grey.jpg", grey, readJpegBytes(grey, "grey").pixels);
    EXPECT_EQ(wall.photos[3].width, 90); // turned on its side
    wall.place();
    const TileBuildReport report = buildInto(wall, smallTiles(), "store");
    EXPECT_TRUE(report.failures.empty());
    EXPECT_EQ(worstOfLevel0(wall, "store", smallTiles()), 0.0);
}

TEST(TileBuilderExtremesTest, alphaIsKeptOrLaidOverTheBackground)
{
    PhotoWall wall;
    wall.add("opaque.png", 70, 50);
    wall.add("holes.png", 90, 80, 4);
    wall.add("greyAndAlpha.png", 33, 44, 2);
    wall.place();
    TileBuildSettings settings = smallTiles();
    settings.background = {0, 128, 255, 255};
    buildInto(wall, settings, "over");
    // The background's light and the photograph's have 65,536 steps each.
    EXPECT_LE(worstOfLevel0(wall, "over", settings), 1.001);
    settings.channels = 4;
    settings.background = {0, 0, 0, 0};
    buildInto(wall, settings, "kept");
    const TilePackReader reader(wall.file("kept"));
    const LightPicture expected = paintReference(wall.layout, wall.photos, 4, settings.background);
    LightPicture level = expected;
    for (int i = 0; i < reader.getSettings().grid.getLevels(); ++i, level = halveReference(level))
        for (const TileKey& key : tilesOf(reader.getSettings().grid))
            if (const TileData tile = reader.read(key);
                key.level == i && tile.kind == TileData::Kind::Encoded)
            {
                // Where next to nothing covers, colours have few steps: alpha of 1 or 2 of 255
                // weighs them by halves. Tested where at least an eighth covers.
                const Pixels pixels = decodeTile(tile.bytes, "tile");
                const PixelRect area = reader.getSettings().grid.getPixels(key);
                for (int y = 0; y < pixels.height; ++y)
                    for (int x = 0; x < pixels.width; ++x)
                    {
                        const auto wanted =
                            level.code(std::clamp(int(area.x) + x, 0, level.width - 1),
                                       std::clamp(int(area.y) + y, 0, level.height - 1));
                        const std::uint8_t* pixel = pixels.row(pixels.height - 1 - y) + 4 * x;
                        EXPECT_NEAR(pixel[3], wanted[3], 2.0);
                        for (int c = 0; c < 3 && wanted[3] > 32.0; ++c)
                            EXPECT_NEAR(pixel[c], wanted[c], 3.0) << "level " << i;
                    }
            }
}

TEST(TileBuilderExtremesTest, pictures16BitAndFloatAndTiledAreRead)
{
    PhotoWall wall;
    const Pixels picture = samplePicture(100, 70, 3, 9);
    for (const char* type : {"uint8", "uint16"})
    {
        const std::string name = std::string(type) + ".tif";
        writePicture(wall.file(name), picture, type, type == std::string("uint16"));
        wall.addFile("copy" + name, bytesOfFile(wall.file(name)),
                     readImageFile(wall.file(name)).pixels);
    }
    writePicture(wall.file("half.exr"), picture, "half");
    wall.addFile("copyhalf.exr", bytesOfFile(wall.file("half.exr")),
                 readImageFile(wall.file("half.exr")).pixels);
    writePicture(wall.file("plain.ppm"), picture);
    wall.addFile("copyplain.ppm", bytesOfFile(wall.file("plain.ppm")), picture);
    wall.place();
    EXPECT_TRUE(buildInto(wall, smallTiles(), "store").failures.empty());
    EXPECT_EQ(worstOfLevel0(wall, "store", smallTiles()), 0.0);
}

TEST(TileBuilderExtremesTest, brokenPhotographsAreNamedAndTheOthersBuilt)
{
    PhotoWall wall;
    for (int i = 0; i < 12; ++i)
        wall.add("photo" + std::to_string(i) + ".png", 80 + i, 70);
    const Pixels picture = samplePicture(120, 90, 3, 7);
    const std::string jpeg = encodeJpeg(picture, {});
    wall.addFile("cut.jpg", jpeg.substr(0, jpeg.size() / 2), picture);
    wall.addFile("text.jpg", "\xff\xd8 this is no picture", picture);
    wall.addFile("text.png", "nor is this", picture);
    wall.addFile("gone.jpg", jpeg, picture);
    wall.addFile("other size.jpg", encodeJpeg(samplePicture(121, 90, 3), {}), picture);
    wall.place();
    std::filesystem::remove(wall.file("gone.jpg"));
    const TileBuildReport report = buildInto(wall, smallTiles(), "store");
    ASSERT_EQ(report.failures.size(), 5u);
    const char* const names[] = {"cut.jpg", "text.jpg", "text.png", "gone.jpg", "other size.jpg"};
    for (std::size_t i = 0; i < 5; ++i)
    {
        EXPECT_EQ(report.failures[i].photo, 12 + i);
        EXPECT_NE(report.failures[i].cause.find(names[i]), std::string::npos);
        EXPECT_EQ(report.failures[i].cause.find('\n'), std::string::npos);
    }
    const TilePackReader reader(wall.file("store"));
    const LightPicture made = readLevel(reader, 0, 3, White);
    const LightPicture expected = paintReference(wall.layout, wall.photos, 3, White);
    for (std::size_t i = 0; i < wall.photos.size(); ++i)
    {
        const PixelRect place = wall.layout.photos[i].getPlace();
        for (std::int64_t y = place.y; y < place.y + place.height; ++y)
            for (std::int64_t x = place.x; x < place.x + place.width; ++x)
                for (int c = 0; c < 3 && i != 12; ++c) // of the one cut the upper half is there
                {
                    const double wanted = i < 12 ? expected.code(int(x), int(y))[c] : 255.0;
                    ASSERT_NEAR(made.code(int(x), int(y))[c], wanted, 1e-6);
                }
    }
}

TEST(TileBuilderExtremesTest, anAtlasTooWideForTheMemoryIsRefused)
{
    PhotoWall wall;
    wall.add("long.png", 60000, 3);
    wall.place();
    TileBuildSettings settings = smallTiles();
    settings.maxBytes = 10 << 20;
    try
    {
        buildInto(wall, settings, "store");
        ADD_FAILURE() << "it was built";
    }
    catch (const TileStoreError& error)
    {
        EXPECT_EQ(error.getKind(), TileStoreError::Kind::Refused);
        EXPECT_NE(std::string(error.what()).find("allow more memory"), std::string::npos);
    }
}

TEST(TileBuilderExtremesTest, photographsCloserThanTheirPaddingAreRefused)
{
    PhotoWall wall;
    wall.add("a.png", 50, 50);
    wall.add("b.png", 50, 50);
    wall.place();
    wall.layout.photos[0].x = wall.layout.photos[0].y = wall.layout.photos[1].y = 0;
    wall.layout.photos[1].x = 60;
    EXPECT_THROW(buildInto(wall, smallTiles(), "store"), TileStoreError);
}

TEST(TileBuilderExtremesTest, aFullDiskIsToldAndTheOldStoreStays)
{
    PhotoWall wall;
    wall.add("photo.png", 900, 700);
    wall.place();
    TileBuildSettings settings = smallTiles();
    settings.threads = 3;
    buildInto(wall, settings, "store");
    const std::string before = bytesOfFile(wall.file("store"));
    settings.linearLight = false;
    rlimit old{};
    getrlimit(RLIMIT_FSIZE, &old);
    const auto ignored = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{before.size() / 2, old.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
    EXPECT_THROW(buildInto(wall, settings, "store"), TileStoreError);
    setrlimit(RLIMIT_FSIZE, &old);
    std::signal(SIGXFSZ, ignored);
    EXPECT_EQ(bytesOfFile(wall.file("store")), before);
    EXPECT_TRUE(verifyTileStore(wall.file("store")).empty());
}

TEST(TileBuilderExtremesTest, formatsLoseNoMoreThanTheyAreKnownTo)
{
    PhotoWall wall;
    wall.add("photo.png", 300, 200);
    wall.place();
    struct Case
    {
        TileCoding coding;
        ChromaSampling chroma;
        double leastPsnr;
    };
    // The sample has noise and hard edges of colour: halved colours cost most.
    const Case cases[] = {{TileCoding::Jpeg, ChromaSampling::Full, 35.0},
                          {TileCoding::Jpeg, ChromaSampling::Half, 26.0},
                          {TileCoding::Jpeg, ChromaSampling::Quarter, 24.0},
                          {TileCoding::Bc1, ChromaSampling::Full, 28.0},
                          {TileCoding::Bc3, ChromaSampling::Full, 28.0},
                          {TileCoding::Bc7, ChromaSampling::Full, 33.0}};
    TileBuildSettings settings = smallTiles();
    buildInto(wall, settings, "exact");
    const TilePackReader exact(wall.file("exact"));
    settings.format.quality = 92;
    for (const Case& each : cases)
    {
        settings.format.coding = each.coding;
        settings.format.chroma = each.chroma;
        buildInto(wall, settings, "store");
        const TilePackReader reader(wall.file("store"));
        double sum = 0.0;
        int tiles = 0;
        for (const TileKey& key : tilesOf(exact.getSettings().grid))
        {
            const TileData tile = exact.read(key);
            ASSERT_EQ(reader.read(key).kind, tile.kind);
            if (tile.kind != TileData::Kind::Encoded)
                continue;
            Pixels pixels = decodeTile(reader.read(key).bytes, "tile");
            if (pixels.channels == 4)
            {
                Pixels opaque(pixels.width, pixels.height, 3);
                for (std::size_t i = 0; i < pixels.bytes.size() / 4; ++i)
                    std::copy_n(&pixels.bytes[4 * i], 3, &opaque.bytes[3 * i]);
                pixels = opaque;
            }
            sum += psnr(pixels, decodeTile(tile.bytes, "tile"));
            ++tiles;
        }
        EXPECT_GE(sum / tiles, each.leastPsnr) << int(each.coding) << " " << int(each.chroma);
    }
}

} // namespace
