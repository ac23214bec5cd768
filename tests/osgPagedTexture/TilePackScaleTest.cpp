// SPDX-License-Identifier: MIT
#include "TilePackSamples.h"

#include <osgPagedTexture/ContentHash.h>
#include <osgPagedTexture/PackFormat.h>

#include <support/ResidentMemory.h>
#include <support/TemporaryFolder.h>

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>

using namespace osgPagedTexture;
namespace fs = std::filesystem;

TEST(TilePackScaleTest, hundredThousandTinyTilesComeBackAfterUpdatesAndACompact)
{
    const support::TemporaryFolder folder;
    const std::string path = folder.file("store.tiles");
    TileStoreSettings settings;
    settings.grid = TileGrid(280 * 4, 280 * 4, 6, 1);
    ASSERT_GT(settings.grid.getTileCount(), 100000u);
    TilePackWriter::Options options;
    options.maxPending = 5000;
    buildSample(path, 0, settings, options);
    EXPECT_EQ(versionOf(TilePackReader(path), 1), 0);
    {
        TilePackWriter writer(path, options);
        putAll(writer, settings.grid, 1);
        writer.commit();
    }
    EXPECT_EQ(versionOf(TilePackReader(path), 2), 1);
    EXPECT_TRUE(TilePackReader(path).verify().empty());
    compactTilePack(path, options);
    buildSample(folder.file("fresh.tiles"), 1, settings, options);
    EXPECT_EQ(bytesOfFile(path), bytesOfFile(folder.file("fresh.tiles")));
}

TEST(TilePackScaleTest, memoryDoesNotGoWithTheTiles)
{
    const support::TemporaryFolder folder;
    const std::string path = folder.file("store.tiles");
    TileStoreSettings settings;
    settings.grid = TileGrid(1024 * 4, 1024 * 4, 4, 0); // 1,398,101 tiles, 33 MB of index
    TilePackWriter::Options options;
    options.maxPending = 1 << 14;
    options.durable = false;
    const double before = support::residentMiB();
    double most = before;
    {
        TilePackWriter writer(path, settings, options);
        for (std::int64_t y = 0; y < 1024; ++y)
        {
            for (std::int64_t x = 0; x < 1024; ++x)
            {
                writer.put({0, x, y}, TileData::uniform({std::uint8_t(x), std::uint8_t(y), 0, 0}));
            }
            most = std::max(most, support::residentMiB());
        }
        writer.commit();
        most = std::max(most, support::residentMiB());
    }
    const TilePackReader reader(path);
    for (std::int64_t i = 0; i < 1024; ++i)
    {
        ASSERT_EQ(reader.read({0, i, 1023 - i}).color[0], std::uint8_t(i));
    }
    most = std::max(most, support::residentMiB());
    // 0.4 MB of entries, 4 MB of gathered bytes, 4 MB of pages of the writer and of the reader.
    EXPECT_LT(most - before, 20.0);
}

TEST(TilePackScaleTest, keysKeepAllBitsOfAThousandMillionTiles)
{
    const TileGrid grid(std::int64_t(28000) * 254, std::int64_t(28000) * 254, 256, 1);
    std::uint64_t before = 0;
    for (int level = 0; level < grid.getLevels(); ++level)
    {
        for (const TileKey& key :
             {TileKey{level, 0, 0}, TileKey{level, grid.getColumns(level) - 1, 0},
              TileKey{level, 0, grid.getRows(level) - 1},
              TileKey{level, grid.getColumns(level) - 1, grid.getRows(level) - 1}})
        {
            EXPECT_EQ(unpackKey(packKey(key)), key);
            EXPECT_GE(packKey(key), before);
            before = packKey(key);
        }
    }
    const TileKey largest{41, (1 << 29) - 1, (1 << 29) - 1};
    EXPECT_EQ(unpackKey(packKey(largest)), largest);
}

TEST(TilePackScaleTest, tilesBeyond4GiBAreFound)
{
    const support::TemporaryFolder folder;
    const std::string path = folder.file("store.tiles");
    buildSample(path, 0);
    // A store of 6 GiB, most of it a hole that costs no disk.
    PackHead head;
    {
        std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
        file.seekg(PackHeadBytes);
        file.read(reinterpret_cast<char*>(&head), sizeof(head));
        head.packBytes = std::uint64_t(6) << 30;
        head.checksum = checksum(&head, sizeof(head) - sizeof(head.checksum));
        file.seekp(PackHeadBytes);
        file.write(reinterpret_cast<const char*>(&head), sizeof(head));
    }
    fs::resize_file(path, head.packBytes);
    {
        TilePackWriter writer(path, {});
        putAll(writer, sampleSettings().grid, 1);
        writer.commit();
    }
    EXPECT_GT(fs::file_size(path), std::uint64_t(6) << 30);
    EXPECT_EQ(versionOf(TilePackReader(path), 2), 1);
    EXPECT_GT(TilePackReader(path).getInfo().getDeadShare(), 0.99);
    compactTilePack(path);
    EXPECT_TRUE(TilePackReader(path).verify().empty());
    EXPECT_EQ(versionOf(TilePackReader(path), 2), 1);
}
