// SPDX-License-Identifier: MIT
#include "../osgPagedTexture/PictureFiles.h"

#include <osgPagedTexture/AtlasLayout.h>
#include <osgPagedTexture/TileExtract.h>
#include <osgPagedTexture/TilePack.h>

#include <support/ChildProcess.h>
#include <support/TemporaryFolder.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <iterator>

namespace
{

namespace fs = std::filesystem;
using namespace osgPagedTexture;
using nlohmann::json;

support::ProcessResult run(const std::vector<std::string>& words)
{
    support::ChildProcess process;
    process.arguments = {OSGKITS_OSGTILESTORE, "build"};
    process.arguments.insert(process.arguments.end(), words.begin(), words.end());
    return process.run();
}

std::string contentOf(const std::string& path)
{
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// Five photographs in two folders.
void addPhotos(const support::TemporaryFolder& folder)
{
    fs::create_directories(folder.file("photos/north"));
    for (int i = 0; i < 4; ++i)
        folder.write("photos/photo" + std::to_string(i) + ".jpg",
                     encodeJpeg(samplePicture(300 + 40 * i, 200, 3, unsigned(i + 1))));
    folder.write("photos/north/photo0.JPG", encodeJpeg(samplePicture(150, 250, 1, 9)));
    folder.write("photos/notes.txt", "no photograph");
    folder.write("photos/.hidden.jpg", "nor this");
}

TEST(OsgTileStoreBuildTest, aFolderBecomesAStoreWithItsLayoutAndKeptPixels)
{
    const support::TemporaryFolder folder;
    addPhotos(folder);
    const auto result = run({folder.file("photos"), "--tile-side", "64", "--json"});
    ASSERT_EQ(result.exitCode, 0) << result.errors;
    const json report = json::parse(result.output);
    EXPECT_EQ(report["store"], folder.file("photos.tiles"));
    EXPECT_EQ(report["photographs"], 5);
    EXPECT_TRUE(report["failures"].empty());
    const TilePackReader reader(folder.file("photos.tiles"));
    EXPECT_EQ(reader.getInfo().encodedTiles, report["encodedTiles"].get<std::uint64_t>());
    EXPECT_EQ(reader.getSettings().grid.getPayload(), 48);
    EXPECT_TRUE(verifyTileStore(folder.file("photos.tiles")).empty());
    EXPECT_TRUE(verifyTileStore(folder.file("photos.tiles.mips")).empty());
    const AtlasLayout layout = readAtlasLayout(folder.file("photos.tiles.layout.json"));
    EXPECT_EQ(layout.photos[0].path, "photos/north/photo0.JPG");
    const json settings = json::parse(reader.getSettings().description);
    EXPECT_EQ(settings["layoutHash"], layout.getContentHash());
}

TEST(OsgTileStoreBuildTest, itsLayoutLeadsToTheSameFileAgainForAnyNumberOfThreads)
{
    const support::TemporaryFolder folder;
    addPhotos(folder);
    ASSERT_EQ(run({folder.file("photos"), "--threads", "1"}).exitCode, 0);
    const std::string layout = folder.file("photos.tiles.layout.json");
    const std::string before = contentOf(folder.file("photos.tiles")), laid = contentOf(layout);
    ASSERT_EQ(run({layout, "--threads", "3"}).exitCode, 0);
    EXPECT_EQ(contentOf(folder.file("photos.tiles")), before);
    EXPECT_EQ(contentOf(layout), laid);
}

TEST(OsgTileStoreBuildTest, aConfigurationFileSaysTheSameAsOptionsWhichGoBefore)
{
    const support::TemporaryFolder folder;
    addPhotos(folder);
    const std::string config =
        folder.write("monument.json", R"({"photos": "photos", "store": "out.tiles", "tileSide": 128,
                             "border": 4, "format": "png", "compression": 1, "filter": "plain",
                             "background": [1, 2, 3], "memory": "64MiB", "notUpdatable": true})");
    ASSERT_EQ(run({config, "--border=2"}).exitCode, 0);
    const TilePackReader reader(folder.file("out.tiles"));
    EXPECT_EQ(reader.getSettings().format, "png");
    EXPECT_EQ(reader.getSettings().grid.getTileSide(), 128);
    EXPECT_EQ(reader.getSettings().grid.getBorder(), 2);
    EXPECT_FALSE(fs::exists(folder.file("out.tiles.mips")));
}

TEST(OsgTileStoreBuildTest, whatMakesNoSenseIsNamed)
{
    const support::TemporaryFolder folder;
    addPhotos(folder);
    const std::string photos = folder.file("photos");
    const std::pair<std::vector<std::string>, const char*> cases[] = {
        {{folder.file("none")}, "cannot be read"},
        {{folder.write("bad.json", "{ \"photos\": ")}, "is no JSON"},
        {{folder.write("typo.json", R"({"fotos": "photos"})")}, "unknown member 'fotos'"},
        {{folder.write("word.json", R"({"photos": "photos", "format": "gif"})")},
         "format must be one of jpg, png, bc1, bc3, bc7, not \"gif\""},
        {{folder.write("number.json", R"({"photos": "photos", "quality": "high"})")},
         "quality must be a whole number from 1 to 100"},
        {{photos, "--channels", "4"}, "choose png, bc3 or bc7"},
        {{photos, "--border", "200"}, "have no room"},
        {{photos, "--output", "tape"}, "output must be one of pack, libvt, deepzoom"},
        {{photos, "--store", folder.file("no/such/folder/a.tiles")}, "no/such/folder"},
        {{photos, "--memory", "64KiB", "--max-width", "100"}, "allow more memory"},
    };
    for (const auto& [words, cause] : cases)
    {
        const auto result = run(words);
        EXPECT_NE(result.exitCode, 0) << cause;
        EXPECT_NE(result.errors.find(cause), std::string::npos) << cause << ": " << result.errors;
        EXPECT_EQ(std::count(result.errors.begin(), result.errors.end(), '\n'), 1) << cause;
    }
    fs::create_directories(folder.file("empty"));
    EXPECT_NE(run({folder.file("empty")}).errors.find("no photograph is in"), std::string::npos);
}

TEST(OsgTileStoreBuildTest, brokenPhotographsAreNamedWithStatusOneAndTheRestIsBuilt)
{
    const support::TemporaryFolder folder;
    addPhotos(folder);
    const std::string jpeg = encodeJpeg(samplePicture(200, 200, 3));
    folder.write("photos/cut.jpg", jpeg.substr(0, jpeg.size() / 2));
    folder.write("photos/text.png", "no picture");
    const auto result = run({folder.file("photos"), "--json"});
    EXPECT_EQ(result.exitCode, 1);
    EXPECT_NE(result.errors.find("cut.jpg"), std::string::npos) << result.errors;
    EXPECT_NE(result.errors.find("text.png"), std::string::npos) << result.errors;
    const json report = json::parse(result.output);
    EXPECT_EQ(report["failures"].size(), 2u);
    EXPECT_EQ(report["photographs"], 6); // the half one has its place
    EXPECT_TRUE(verifyTileStore(folder.file("photos.tiles")).empty());
}

TEST(OsgTileStoreBuildTest, libVtAndDeepZoomFoldersShowTheSamePicture)
{
    const support::TemporaryFolder folder;
    addPhotos(folder);
    const std::string photos = folder.file("photos");
    ASSERT_EQ(run({photos, "--format", "png", "--compression", "1"}).exitCode, 0);
    const std::string layout = folder.file("photos.tiles.layout.json");
    ASSERT_EQ(run({layout, "--format", "png", "--store", folder.file("vt"), "--output", "libvt",
                   "--border", "1"})
                  .exitCode,
              0);
    ASSERT_EQ(run({layout, "--format", "png", "--store", folder.file("web.dzi")}).exitCode, 0);
    EXPECT_TRUE(fs::exists(folder.file("vt/tiles_b1_level0/tile_0_0_0.png")));
    EXPECT_TRUE(fs::exists(folder.file("web_files/0/0_0.png")));
    const auto pixelsOf = [](const std::string& store)
    {
        std::string pixels;
        const auto reader = openTileStore(store);
        const TileGrid& grid = reader->getSettings().grid;
        readRegion(*reader, 0, {0, 0, grid.getWidth(), grid.getHeight()}, {},
                   [&](const std::uint8_t* row)
                   { pixels.append(reinterpret_cast<const char*>(row), 3 * grid.getWidth()); });
        return pixels;
    };
    const std::string packed = pixelsOf(folder.file("photos.tiles"));
    EXPECT_EQ(pixelsOf(folder.file("vt")), packed);
    EXPECT_EQ(pixelsOf(folder.file("web.dzi")), packed);
}

TEST(OsgTileStoreBuildTest, theAtlasIsWrittenInPartsOnlyWhereItIsAskedFor)
{
    const support::TemporaryFolder folder;
    addPhotos(folder);
    const auto result = run({folder.file("photos"), "--format", "png", "--atlas",
                             folder.file("atlas.ppm"), "--atlas-side", "400", "--json"});
    ASSERT_EQ(result.exitCode, 0) << result.errors;
    const json report = json::parse(result.output);
    const int columns = (report["width"].get<int>() + 399) / 400;
    const int rows = (report["height"].get<int>() + 399) / 400;
    ASSERT_GT(columns * rows, 1);
    EXPECT_EQ(report["atlas"].size(), std::size_t(columns * rows));
    const auto reader = openTileStore(folder.file("photos.tiles"));
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x)
        {
            const std::string name = std::to_string(x) + "_" + std::to_string(y) + ".ppm";
            extractRegion(*reader, 0, {x * 400, y * 400, 400, 400}, {}, folder.file(name));
            EXPECT_EQ(contentOf(folder.file("atlas_" + name)), contentOf(folder.file(name)));
        }
    ASSERT_EQ(run({folder.file("photos.tiles.layout.json"), "--atlas", folder.file("whole.tif")})
                  .exitCode,
              0);
    EXPECT_TRUE(fs::exists(folder.file("whole.tif")));
}

TEST(OsgTileStoreBuildTest, alphaIsFoundWhereTheFormatKeepsIt)
{
    const support::TemporaryFolder folder;
    addPhotos(folder);
    writePicture(folder.file("photos/leaves.png"), samplePicture(90, 90, 4));
    for (const auto& [format, channels] : {std::pair{"png", 4}, {"jpg", 3}, {"bc1", 3}})
    {
        ASSERT_EQ(run({folder.file("photos"), "--format", format}).exitCode, 0);
        const TilePackReader reader(folder.file("photos.tiles"));
        EXPECT_EQ(json::parse(reader.getSettings().description)["channels"], channels) << format;
    }
}

} // namespace
