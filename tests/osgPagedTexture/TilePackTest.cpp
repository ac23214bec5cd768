// SPDX-License-Identifier: MIT
#include "TilePackSamples.h"

#include <osgPagedTexture/TilePack.h>

#include <support/TemporaryFolder.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <random>

using namespace osgPagedTexture;
namespace fs = std::filesystem;

namespace
{

class TilePackTest : public testing::Test
{
protected:
    const support::TemporaryFolder folder;
    const std::string path = folder.file("store.tiles");
    const TileStoreSettings settings = sampleSettings();
    const TileGrid& grid = settings.grid;

    std::string compacted()
    {
        compactTilePack(path);
        return bytesOfFile(path);
    }
    std::string fresh(unsigned int version)
    {
        const std::string other = folder.file("fresh.tiles");
        buildSample(other, version);
        return bytesOfFile(other);
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

} // namespace

TEST_F(TilePackTest, tilesComeBackAsTheyWerePut)
{
    buildSample(path, 3);
    const TilePackReader reader(path);
    EXPECT_EQ(versionOf(reader, 5), 3);
    EXPECT_EQ(reader.getSettings().grid, grid);
    EXPECT_EQ(reader.getSettings().format, "jpg");
    EXPECT_EQ(reader.getSettings().description, settings.description);
    EXPECT_TRUE(reader.verify().empty());
    EXPECT_EQ(reader.getInfo().warning, "");
}

TEST_F(TilePackTest, emptyStoreIsAStore)
{
    TilePackWriter(path, settings, {}).commit();
    const TilePackReader reader(path);
    EXPECT_EQ(reader.read({0, 0, 0}).kind, TileData::Kind::None);
    EXPECT_TRUE(reader.verify().empty());
    EXPECT_EQ(reader.getInfo().getDeadShare(), 0.0);
    EXPECT_EQ(compacted().size(), reader.getInfo().committedBytes);
}

TEST_F(TilePackTest, infoCountsWhatIsThere)
{
    buildSample(path, 0);
    std::uint64_t encoded = 0, uniform = 0, bytes = 0;
    for (const TileKey& key : tilesOf(grid))
    {
        const TileData tile = sampleTile(key, 0);
        encoded += tile.kind == TileData::Kind::Encoded;
        uniform += tile.kind == TileData::Kind::Uniform;
        bytes += tile.bytes.size();
    }
    const TilePackReader reader(path);
    const TilePackInfo info = reader.getInfo();
    EXPECT_EQ(info.encodedTiles, encoded);
    EXPECT_EQ(info.uniformTiles, uniform);
    EXPECT_EQ(info.committedBytes, fs::file_size(path));
    EXPECT_EQ(info.liveBytes, info.committedBytes);
    EXPECT_EQ(info.generation, 1u);
    std::uint64_t levelTiles = 0, levelBytes = 0;
    for (const TileLevelInfo& level : reader.countTiles())
    {
        levelTiles += level.encodedTiles + level.uniformTiles;
        levelBytes += level.encodedBytes;
    }
    EXPECT_EQ(levelTiles, encoded + uniform);
    EXPECT_EQ(levelBytes, bytes);
}

TEST_F(TilePackTest, uniformTilesTakeAnEntryAndNoBytes)
{
    TilePackWriter writer(path, settings, {});
    for (const TileKey& key : tilesOf(grid))
    {
        writer.put(key, TileData::uniform({1, 2, 3, 4}));
    }
    writer.commit();
    // Two heads, one page of up to 170 entries, the description and the copy of the head.
    EXPECT_LE(grid.getTileCount(), 170u);
    EXPECT_EQ(fs::file_size(path), 8192u + 32 + 4096 + 32 + 16 + 32 + 4096);
    EXPECT_EQ(TilePackReader(path).read({0, 1, 1}).color, (TileColor{1, 2, 3, 4}));
}

TEST_F(TilePackTest, changesSwitchAtTheCommit)
{
    buildSample(path, 0);
    TilePackReader reader(path);
    TilePackWriter writer(path, {});
    putAll(writer, grid, 1);
    EXPECT_EQ(versionOf(TilePackReader(path), 2), 0);
    writer.commit();
    EXPECT_EQ(versionOf(reader, 2), 0); // it keeps what it saw
    EXPECT_TRUE(reader.refresh());
    EXPECT_EQ(versionOf(reader, 2), 1);
    EXPECT_FALSE(reader.refresh());
    EXPECT_TRUE(reader.verify().empty());
}

TEST_F(TilePackTest, writerWithoutCommitLeavesTheFileAsItWas)
{
    buildSample(path, 0);
    const std::string before = bytesOfFile(path);
    {
        TilePackWriter writer(path, {});
        putAll(writer, grid, 1);
    }
    EXPECT_EQ(bytesOfFile(path), before);
    {
        TilePackWriter writer(path, settings, {});
        putAll(writer, grid, 1);
    }
    EXPECT_EQ(bytesOfFile(path), before);
    EXPECT_FALSE(fs::exists(path + ".part"));
}

TEST_F(TilePackTest, compactFileEqualsAFreshBuildByteForByte)
{
    buildSample(path, 0);
    std::vector<TileKey> keys = tilesOf(grid);
    std::shuffle(keys.begin(), keys.end(), std::mt19937(7));
    TilePackWriter::Options options;
    for (std::size_t first = 0; first < keys.size(); first += 10)
    {
        TilePackWriter writer(path, options);
        for (std::size_t i = first; i < std::min(first + 10, keys.size()); ++i)
        {
            writer.put(keys[i], TileData::uniform({9, 9, 9, 9}));
            writer.put(keys[i], sampleTile(keys[i], 1)); // the last one counts
        }
        writer.commit();
    }
    EXPECT_EQ(versionOf(TilePackReader(path), 2), 1);
    EXPECT_GT(TilePackReader(path).getInfo().getDeadShare(), 0.3);
    EXPECT_TRUE(TilePackReader(path).verify().empty());
    EXPECT_EQ(compacted(), fresh(1));
    EXPECT_EQ(compacted(), fresh(1)); // and stays so
}

TEST_F(TilePackTest, removedTilesAreNothingAgain)
{
    buildSample(path, 0);
    {
        TilePackWriter writer(path, {});
        for (const TileKey& key : tilesOf(grid))
        {
            writer.put(key, {});
        }
        writer.commit();
    }
    const TilePackReader reader(path);
    EXPECT_EQ(reader.getInfo().encodedTiles + reader.getInfo().uniformTiles, 0u);
    EXPECT_TRUE(reader.verify().empty());
    for (const TileKey& key : tilesOf(grid))
    {
        EXPECT_EQ(reader.read(key).kind, TileData::Kind::None);
    }
    const std::string empty = folder.file("empty.tiles");
    TilePackWriter(empty, settings, {}).commit();
    EXPECT_EQ(compacted(), bytesOfFile(empty));
}

TEST_F(TilePackTest, smallMemoryForTheIndexGivesTheSameTiles)
{
    TilePackWriter::Options options;
    options.maxPending = 7;
    const TileStoreSettings large = sampleSettings(2000);
    buildSample(path, 2, large, options);
    {
        TilePackWriter writer(path, options);
        putAll(writer, large.grid, 4);
        writer.commit();
    }
    const TilePackReader reader(path);
    EXPECT_EQ(versionOf(reader, 5), 4);
    EXPECT_TRUE(reader.verify().empty());
    compactTilePack(path);
    buildSample(folder.file("fresh.tiles"), 4, large);
    EXPECT_EQ(bytesOfFile(path), bytesOfFile(folder.file("fresh.tiles")));
}

TEST_F(TilePackTest, descriptionChangesWithACommit)
{
    buildSample(path, 0);
    TilePackWriter writer(path, {});
    writer.setDescription("other");
    writer.commit();
    writer.commit(); // nothing new
    const TilePackReader reader(path);
    EXPECT_EQ(reader.getSettings().description, "other");
    EXPECT_EQ(reader.getInfo().generation, 2u);
    EXPECT_EQ(versionOf(reader, 1), 0);
}

TEST_F(TilePackTest, timeOfAnUpdateGoesWithItsTilesNotWithTheStore)
{
    TileStoreSettings large = sampleSettings();
    large.grid = TileGrid(320 * 8, 320 * 8, 10, 1); // 136,534 tiles
    buildSample(path, 0, large);
    const std::uint64_t before = fs::file_size(path);
    std::uint64_t grown = 0;
    {
        TilePackWriter writer(path, {});
        writer.put({0, 5, 5}, TileData::uniform({}));
        writer.commit();
        grown = fs::file_size(path) - before;
    }
    EXPECT_EQ(grown, 32u + 4096 + 32 + 4096); // a page of the index and the head
    EXPECT_TRUE(TilePackReader(path).verify().empty());
}

TEST_F(TilePackTest, badRequestsAreRefusedInOneLine)
{
    TilePackWriter writer(path, settings, {});
    EXPECT_NE(messageOf(
                  [&]() {
                      writer.put({0, 99, 0}, TileData::encoded("x"));
                  })
                  .find("tile 99, 0 of level 0 lies outside"),
              std::string::npos);
    EXPECT_NE(messageOf(
                  [&]() {
                      writer.put({0, 0, 0}, TileData::encoded(""));
                  })
                  .find("0 bytes"),
              std::string::npos);
    TileStoreSettings bad = settings;
    bad.format = "../../x";
    const std::string other = folder.file("other.tiles");
    EXPECT_NE(messageOf([&]() { TilePackWriter(other, bad, {}); }).find("no tile format"),
              std::string::npos);
    EXPECT_FALSE(fs::exists(other + ".part"));
    EXPECT_NE(messageOf([&]() { TilePackReader(folder.file("none")); }).find("cannot be opened"),
              std::string::npos);
    EXPECT_NE(messageOf([&]() { TilePackReader(folder.write("text", "hello")); })
                  .find("is no packed tile store"),
              std::string::npos);
    EXPECT_NE(messageOf([&]() { TilePackReader(folder.getPath().string()); }).find("no regular"),
              std::string::npos);
}
