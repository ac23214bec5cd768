// SPDX-License-Identifier: MIT
#include "TileStoreRun.h"

#include <osgPagedTexture/TilePack.h>

#include <support/TemporaryFolder.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>

namespace
{

using namespace osgPagedTexture;
using nlohmann::json;

/// A store of two levels: red and blue above, nothing below.
std::string writeStore(const support::TemporaryFolder& folder)
{
    const std::string path = folder.file("halves.tiles");
    TileStoreSettings settings;
    settings.grid = TileGrid(128, 128, 64, 0);
    settings.description = "{\"quality\": 85}";
    TilePackWriter writer(path, settings, {});
    writer.put({0, 0, 0}, TileData::uniform({255, 0, 0, 255}));
    writer.put({0, 1, 0}, TileData::uniform({0, 0, 255, 255}));
    writer.put({1, 0, 0}, TileData::uniform({128, 0, 128, 255}));
    writer.commit();
    return path;
}

TEST(OsgTileStoreTest, helpNamesEverySubcommandAndEachHasItsOwn)
{
    const auto help = run({"--help"});
    EXPECT_EQ(help.exitCode, 0);
    for (const char* name : {"info", "verify", "extract", "compact"})
    {
        EXPECT_NE(help.output.find(std::string("  ") + name), std::string::npos) << name;
        const auto page = run({name, "--help"});
        EXPECT_EQ(page.exitCode, 0) << name;
        EXPECT_EQ(page.output.rfind(std::string("osgtilestore ") + name, 0), 0u) << page.output;
        EXPECT_NE(page.output.find("--json"), std::string::npos) << name;
    }
}

TEST(OsgTileStoreTest, wrongWordsAreNamedInOneLineWithStatusTwo)
{
    const std::pair<std::vector<std::string>, const char*> cases[] = {
        {{}, "no subcommand"},
        {{"paint"}, "'paint' is no subcommand"},
        {{"info"}, "needs STORE"},
        {{"info", "a", "b"}, "'b' is one name too many"},
        {{"verify", "--loud", "a"}, "unknown option '--loud'"},
        {{"verify", "a", "--most"}, "--most: 1 required value missing"},
        {{"verify", "a", "--json=5"}, "json was given"},
        {{"verify", "a", "--most", "9x"}, "--most needs a whole number"},
        {{"extract", "a", "b", "--channels", "2"}, "--channels needs 1, 3 or 4"},
    };
    for (const auto& [words, cause] : cases)
    {
        const auto result = run(words);
        EXPECT_EQ(result.exitCode, 2) << cause;
        EXPECT_NE(result.errors.find(cause), std::string::npos) << result.errors;
        EXPECT_EQ(std::count(result.errors.begin(), result.errors.end(), '\n'), 1) << cause;
    }
}

TEST(OsgTileStoreTest, infoCountsTilesOfEachKindAndShowsTheBuildersSettings)
{
    const support::TemporaryFolder folder;
    const auto result = run({"info", writeStore(folder), "--json"});
    ASSERT_EQ(result.exitCode, 0) << result.errors;
    const json info = json::parse(result.output);
    EXPECT_EQ(info["width"], 128);
    EXPECT_EQ(info["uniformTiles"], 3);
    EXPECT_EQ(info["absentTiles"], 2);
    EXPECT_EQ(info["settings"]["quality"], 85);
    EXPECT_EQ(info["levels"][0]["uniformTiles"], 2);
    EXPECT_NE(run({"info", writeStore(folder)}).output.find("128 x 128 pixels, 2 levels"),
              std::string::npos);
}

// Its 250 libraries take a quarter of a second to load, more than an update of a photograph.
TEST(OsgTileStoreTest, openImageIoIsNotLoadedBeforeAPictureNeedsIt)
{
    const support::TemporaryFolder folder;
    const auto result = run({"info", writeStore(folder)}, {{"LD_DEBUG", "libs"}});
    ASSERT_EQ(result.exitCode, 0);
    if (result.errors.find("libosgPagedTexture") == std::string::npos)
        GTEST_SKIP() << "the loader does not tell what it loads";
    EXPECT_EQ(result.errors.find("OpenImageIO"), std::string::npos);
}

TEST(OsgTileStoreTest, verifyNamesADamageWithStatusOne)
{
    const support::TemporaryFolder folder;
    const std::string store = writeStore(folder);
    EXPECT_EQ(run({"verify", store}).exitCode, 0);
    std::fstream file(store, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(-40, std::ios::end);
    file.put('#').put('#').put('#');
    file.close();
    const auto result = run({"verify", store});
    EXPECT_EQ(result.exitCode, 1);
    EXPECT_FALSE(result.output.empty() && result.errors.empty());
}

TEST(OsgTileStoreTest, extractWritesTheRegionOfALevel)
{
    const support::TemporaryFolder folder;
    const std::string picture = folder.file("middle.ppm");
    const auto result = run({"extract", writeStore(folder), picture, "--level", "0", "--region",
                             "63,62,2,3", "--background", "9,8,7"});
    ASSERT_EQ(result.exitCode, 0) << result.errors;
    std::ifstream file(picture, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    const std::string red("\xff\0\0", 3), blue("\0\0\xff", 3), nothing("\x09\x08\x07", 3);
    const std::string pixels = red + blue + red + blue + nothing + nothing;
    ASSERT_GT(bytes.size(), pixels.size());
    EXPECT_EQ(bytes.substr(bytes.size() - pixels.size()), pixels);
}

TEST(OsgTileStoreTest, compactRemovesDeadBytes)
{
    const support::TemporaryFolder folder;
    const std::string store = writeStore(folder);
    for (int round = 0; round < 3; ++round)
    {
        TilePackWriter writer(store, TilePackWriter::Options());
        writer.put({0, 0, 1}, TileData::encoded(std::string(5000, char('a' + round))));
        writer.commit();
    }
    const auto result = run({"compact", store, "--json"});
    ASSERT_EQ(result.exitCode, 0) << result.errors;
    const json report = json::parse(result.output);
    EXPECT_GT(report["bytesBefore"].get<int>(), report["bytes"].get<int>() + 10000);
    EXPECT_EQ(json::parse(run({"info", store, "--json"}).output)["deadShare"].get<double>(), 0.0);
}

TEST(OsgTileStoreTest, aStoreThatIsNotThereIsNamed)
{
    for (const char* name : {"info", "verify", "compact"})
    {
        const auto result = run({name, "no/such.tiles"});
        EXPECT_EQ(result.exitCode, 1) << name;
        EXPECT_NE((result.errors + result.output).find("no/such.tiles"), std::string::npos);
    }
}

} // namespace
