// SPDX-License-Identifier: MIT
#include "PictureFiles.h"

#include <osgPagedTexture/ImageFile.h>
#include <osgPagedTexture/TileExtract.h>
#include <osgPagedTexture/TileFolders.h>

#include <support/ChildProcess.h>
#include <support/TemporaryFolder.h>

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

using namespace osgPagedTexture;
namespace fs = std::filesystem;

namespace
{

constexpr int Width = 300;
constexpr int Height = 170;

std::string encodeUniform(const TileColor& color, int width, int height)
{
    Pixels pixels(width, height, 3);
    for (std::size_t i = 0; i < pixels.bytes.size(); ++i)
    {
        pixels.bytes[i] = color[i % 3];
    }
    return encodePng(pixels);
}

/// A pixel from the top left corner.
const std::uint8_t* at(const Pixels& pixels, std::int64_t x, std::int64_t y)
{
    return pixels.row(pixels.height - 1 - int(y)) + x * pixels.channels;
}

/// Puts the tiles of all levels of a picture; each level takes every second pixel of the one below.
void putPicture(TileWriter& writer, const TileGrid& grid, const Pixels& picture)
{
    for (int level = 0; level < grid.getLevels(); ++level)
    {
        for (std::int64_t y = 0; y < grid.getRows(level); ++y)
        {
            for (std::int64_t x = 0; x < grid.getColumns(level); ++x)
            {
                const PixelRect rect = grid.getPixels({level, x, y});
                Pixels tile(int(rect.width), int(rect.height), 3);
                for (int row = 0; row < tile.height; ++row)
                {
                    for (int column = 0; column < tile.width; ++column)
                    {
                        const auto fromX =
                            std::clamp<std::int64_t>(rect.x + column, 0, grid.getWidth(level) - 1);
                        const auto fromY =
                            std::clamp<std::int64_t>(rect.y + row, 0, grid.getHeight(level) - 1);
                        std::copy_n(at(picture, fromX << level, fromY << level), 3,
                                    tile.row(tile.height - 1 - row) + 3 * column);
                    }
                }
                writer.put({level, x, y}, TileData::encoded(encodePng(tile)));
            }
        }
    }
}

TileStoreSettings settingsOf(TileGrid::Edge edge)
{
    TileStoreSettings settings;
    settings.grid = TileGrid(Width, Height, 64, 2, edge);
    settings.format = "png";
    settings.description = "a \"picture\"";
    return settings;
}

void expectPicture(const std::string& path, const Pixels& picture, int step)
{
    Pixels expected((picture.width + step - 1) / step, (picture.height + step - 1) / step, 3);
    for (int y = 0; y < expected.height; ++y)
    {
        for (int x = 0; x < expected.width; ++x)
        {
            std::copy_n(at(picture, x * step, y * step), 3,
                        expected.row(expected.height - 1 - y) + 3 * x);
        }
    }
    const auto input = OIIO::ImageInput::open(path);
    ASSERT_TRUE(input) << OIIO::geterror();
    Pixels found(input->spec().width, input->spec().height, input->spec().nchannels);
    input->read_image(0, 0, 0, found.channels, OIIO::TypeUInt8, found.row(found.height - 1),
                      OIIO::AutoStride, -OIIO::stride_t(found.width) * found.channels);
    EXPECT_EQ(largestDifference(found, expected), 0) << path;
}

class TileFoldersTest : public testing::Test
{
protected:
    const support::TemporaryFolder folder;
    const std::string deepZoom = folder.file("atlas.dzi");
    const std::string libVT = folder.file("atlas");
    const Pixels picture = samplePicture(Width, Height, 3);

    void write(const std::string& path, FolderLayout layout)
    {
        const TileStoreSettings settings = settingsOf(
            layout == FolderLayout::LibVT ? TileGrid::Edge::Padded : TileGrid::Edge::Clipped);
        TileFolderWriter writer(path, layout, settings, encodeUniform);
        putPicture(writer, settings.grid, picture);
        writer.commit();
    }
};

std::string messageOf(const std::function<void()>& body)
{
    try
    {
        body();
    }
    catch (const TileStoreError& error)
    {
        return error.what();
    }
    return "";
}

support::ProcessResult runProgram(const std::vector<std::string>& arguments)
{
    support::ChildProcess program;
    program.arguments = arguments;
    return program.run();
}

} // namespace

TEST_F(TileFoldersTest, libVTFindsItsNames)
{
    write(libVT, FolderLayout::LibVT);
    EXPECT_TRUE(fs::exists(libVT + "/tiles_b2_level0/tile_0_0_0.png"));
    EXPECT_TRUE(fs::exists(libVT + "/tiles_b2_level0/tile_0_4_2.png"));
    EXPECT_FALSE(fs::exists(libVT + "/tiles_b2_level0/tile_0_5_0.png"));
    EXPECT_TRUE(fs::exists(libVT + "/tiles_b2_level1/tile_1_2_1.png"));
    EXPECT_TRUE(fs::exists(libVT + "/tiles_b2_level3/tile_3_0_0.png"));
    EXPECT_FALSE(fs::exists(libVT + "/tiles_b2_level4"));
}

TEST_F(TileFoldersTest, bothLayoutsGiveTheirPictureBack)
{
    write(libVT, FolderLayout::LibVT);
    write(deepZoom, FolderLayout::DeepZoom);
    for (const std::string& path : {libVT, deepZoom})
    {
        EXPECT_TRUE(verifyTileStore(path).empty());
        const auto reader = openTileStore(path);
        EXPECT_EQ(reader->getSettings().format, "png");
        for (int level = 0; level < 3; ++level)
        {
            const std::string out = folder.file("out.png");
            extractRegion(*reader, level, {0, 0, 10000, 10000}, {}, out);
            expectPicture(out, picture, 1 << level);
        }
    }
    EXPECT_EQ(openTileStore(libVT)->getSettings().description, "a \"picture\"");
}

TEST_F(TileFoldersTest, vipsReadsOurDeepZoomTilesAsItsOwn)
{
    if (runProgram({"vips", "--version"}).exitCode != 0)
    {
        GTEST_SKIP() << "needs vips (libvips-tools)";
    }
    const std::string source = folder.file("source.png");
    writePicture(source, picture);
    const std::string theirs = folder.file("theirs");
    const auto result = runProgram({"vips", "dzsave", source, theirs, "--tile-size", "60",
                                    "--overlap", "2", "--suffix", ".png"});
    ASSERT_EQ(result.exitCode, 0) << result.errors;
    write(deepZoom, FolderLayout::DeepZoom);

    // The same files with the same pixels, level by level.
    std::size_t files = 0, compared = 0;
    for (const auto& entry : fs::recursive_directory_iterator(theirs + "_files"))
    {
        if (entry.path().extension() == ".png")
        {
            ++files;
            const std::string name = fs::relative(entry.path(), theirs + "_files").string();
            const std::string mine = folder.file("atlas_files/" + name);
            ASSERT_TRUE(fs::exists(mine)) << name;
            const auto theirPixels = OIIO::ImageInput::open(entry.path().string());
            const auto ourPixels = OIIO::ImageInput::open(mine);
            ASSERT_TRUE(theirPixels && ourPixels);
            EXPECT_EQ(theirPixels->spec().width, ourPixels->spec().width) << name;
            EXPECT_EQ(theirPixels->spec().height, ourPixels->spec().height) << name;
            if (name.compare(0, 2, "9/") == 0) // the full size: no filter is between them
            {
                const Pixels ours0 = readImageFile(mine).pixels;
                const Pixels theirs0 = readImageFile(entry.path().string()).pixels;
                EXPECT_EQ(largestDifference(ours0, theirs0), 0) << name;
                ++compared;
            }
        }
    }
    EXPECT_EQ(compared, 15u);
    EXPECT_EQ(files, openTileStore(deepZoom)->getSettings().grid.getTileCount());

    // Theirs is a store for us, ours is a picture for them.
    const std::string out = folder.file("out.png");
    extractRegion(*openTileStore(theirs + ".dzi"), 0, {0, 0, Width, Height}, {}, out);
    expectPicture(out, picture, 1);
    EXPECT_TRUE(verifyTileStore(theirs + ".dzi").empty());
}

TEST_F(TileFoldersTest, uniformTilesBecomeFilesAndNothingNone)
{
    const TileStoreSettings settings = settingsOf(TileGrid::Edge::Clipped);
    TileFolderWriter writer(deepZoom, FolderLayout::DeepZoom, settings, encodeUniform);
    writer.put({0, 1, 1}, TileData::uniform({10, 20, 30, 255}));
    writer.put({0, 2, 1}, TileData::uniform({10, 20, 30, 255}));
    writer.put({0, 2, 1}, {});
    writer.commit();
    const auto reader = openTileStore(deepZoom);
    EXPECT_EQ(reader->read({0, 2, 1}).kind, TileData::Kind::None);
    const Pixels tile = decodeTile(reader->read({0, 1, 1}).bytes, "tile");
    EXPECT_EQ(tile.width, 64);
    EXPECT_EQ(tile.bytes[0], 10);
    EXPECT_EQ(tile.bytes[2], 30);
}

TEST_F(TileFoldersTest, damagedTilesAreNamed)
{
    write(libVT, FolderLayout::LibVT);
    std::ofstream(libVT + "/tiles_b2_level0/tile_0_1_1.png") << "\x89PNG nonsense";
    std::ofstream(libVT + "/tiles_b2_level1/tile_1_0_0.png");
    fs::copy_file(libVT + "/tiles_b2_level0/tile_0_0_0.png",
                  libVT + "/tiles_b2_level1/tile_1_1_0.png", fs::copy_options::overwrite_existing);
    const std::vector<std::string> problems = verifyTileStore(libVT);
    ASSERT_EQ(problems.size(), 2u);
    EXPECT_NE(problems[0].find("tile 1, 1 of level 0"), std::string::npos) << problems[0];
    EXPECT_NE(problems[1].find("tile_1_0_0.png' has 0 bytes"), std::string::npos) << problems[1];
}

TEST_F(TileFoldersTest, badRequestsAreRefusedInOneLine)
{
    const TileStoreSettings padded = settingsOf(TileGrid::Edge::Padded);
    EXPECT_NE(messageOf([&]() { TileFolderWriter(deepZoom, FolderLayout::DeepZoom, padded, {}); })
                  .find("use a clipped grid"),
              std::string::npos);
    EXPECT_NE(messageOf([&]() { TileFolderWriter(libVT, FolderLayout::DeepZoom, padded, {}); })
                  .find("does not end in .dzi"),
              std::string::npos);
    EXPECT_NE(messageOf([&]() { openTileStore(folder.write("a.dzi", "<Image TileSize=\"x\"/>")); })
                  .find("has no attribute Overlap"),
              std::string::npos);
    EXPECT_NE(messageOf(
                  [&]()
                  {
                      openTileStore(folder.write("b.dzi", "<Image Overlap=\"1\" "
                                                          "TileSize=\"99999999999999\"/>"));
                  })
                  .find("no number of pixels"),
              std::string::npos);
    EXPECT_NE(messageOf([&]() { openTileStore(folder.getPath().string()); })
                  .find("tiles.json' cannot be opened"),
              std::string::npos);
    folder.write("tiles.json", "[1, 2");
    EXPECT_NE(messageOf([&]() { openTileStore(folder.getPath().string()); }).find("has no number "),
              std::string::npos);
}
