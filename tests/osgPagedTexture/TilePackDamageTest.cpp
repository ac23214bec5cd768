// SPDX-License-Identifier: MIT
// Bytes that are not what was written must never pass for a tile.
#include "TilePackSamples.h"

#include <support/TemporaryFolder.h>

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

using namespace osgPagedTexture;
namespace fs = std::filesystem;

namespace
{

class TilePackDamageTest : public testing::Test
{
protected:
    TilePackDamageTest()
    {
        buildSample(path, 0, settings);
        firstCommitBytes = fs::file_size(path);
        TilePackWriter writer(path, {});
        putAll(writer, settings.grid, 1);
        writer.commit();
    }

    void setByte(std::uint64_t place, char value)
    {
        std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
        file.seekp(static_cast<std::streamoff>(place));
        file.put(value);
    }

    const support::TemporaryFolder folder;
    const std::string path = folder.file("store.tiles");
    const TileStoreSettings settings = sampleSettings(200);
    std::uint64_t firstCommitBytes = 0;
};

/// Whether every tile is that of this version or an error.
bool givesNothingElse(const TileReader& reader, unsigned int version)
{
    bool good = true;
    for (const TileKey& key : tilesOf(reader.getSettings().grid))
    {
        try
        {
            good = good && reader.read(key) == sampleTile(key, version);
        }
        catch (const TileStoreError& error)
        {
            good = good && error.getKind() == TileStoreError::Kind::Damaged;
        }
    }
    return good;
}

bool isNoticed(const std::string& path)
{
    try
    {
        const TilePackReader reader(path);
        return !reader.verify().empty() && givesNothingElse(reader, 1);
    }
    catch (const TileStoreError& error) // the description is lost
    {
        return error.getKind() == TileStoreError::Kind::Damaged;
    }
}

} // namespace

TEST_F(TilePackDamageTest, everyFlippedByteIsNoticed)
{
    const std::string bytes = bytesOfFile(path);
    const std::size_t step = std::getenv("OSGKITS_LONG") ? 1 : 3;
    for (std::size_t at = 0; at < bytes.size() && !HasFailure(); at += step)
    {
        setByte(at, char(bytes[at] ^ (1 << at % 8)));
        EXPECT_TRUE(isNoticed(path)) << at;
        setByte(at, bytes[at]);
    }
    EXPECT_TRUE(TilePackReader(path).verify().empty());
}

TEST_F(TilePackDamageTest, bothHeadsLostAreFoundAgainAtTheEnd)
{
    for (std::uint64_t at = 0; at < 8192; ++at)
    {
        setByte(at, 'x');
    }
    const TilePackReader reader(path);
    EXPECT_EQ(versionOf(reader, 2), 1);
    EXPECT_NE(reader.getInfo().warning.find("a head is damaged"), std::string::npos);
    compactTilePack(path);
    EXPECT_TRUE(TilePackReader(path).verify().empty());
    EXPECT_EQ(versionOf(TilePackReader(path), 2), 1);
}

TEST_F(TilePackDamageTest, writerGivesTheLastCommitItsHeadBack)
{
    setByte(100, 'x'); // the head of generation 2
    EXPECT_FALSE(TilePackReader(path).verify().empty());
    TilePackWriter(path, {});
    EXPECT_TRUE(TilePackReader(path).verify().empty());
    EXPECT_EQ(versionOf(TilePackReader(path), 2), 1);
}

TEST_F(TilePackDamageTest, fileThatIsCutOffIsTheOlderCommitOrAnError)
{
    const std::string bytes = bytesOfFile(path);
    for (std::size_t length = bytes.size() - 1; length > 8; length -= length > 500 ? 97 : 1)
    {
        fs::resize_file(path, length);
        try
        {
            const TilePackReader reader(path);
            EXPECT_EQ(versionOf(reader, 2), 0) << length;
            EXPECT_GE(length, firstCommitBytes);
            EXPECT_FALSE(reader.getInfo().warning.empty());
        }
        catch (const TileStoreError& error)
        {
            EXPECT_LT(length, firstCommitBytes) << error.what();
            EXPECT_EQ(error.getKind(), TileStoreError::Kind::Damaged);
        }
    }
}

TEST_F(TilePackDamageTest, whatADeadWriterLeftBehindIsIgnoredAndThenRemoved)
{
    const std::uint64_t committed = fs::file_size(path);
    std::ofstream(path, std::ios::binary | std::ios::app) << std::string(5000, 'x');
    EXPECT_TRUE(TilePackReader(path).verify().empty());
    EXPECT_EQ(versionOf(TilePackReader(path), 2), 1);
    TilePackWriter(path, {});
    EXPECT_EQ(fs::file_size(path), committed);
}

TEST_F(TilePackDamageTest, damagedTileIsNamed)
{
    const std::string bytes = bytesOfFile(path);
    TileKey key;
    for (const TileKey& candidate : tilesOf(settings.grid))
    {
        key = sampleTile(candidate, 1).kind == TileData::Kind::Encoded ? candidate : key;
    }
    setByte(bytes.find(sampleTile(key, 1).bytes), '#');
    const TilePackReader reader(path);
    const std::string name = "tile " + std::to_string(key.x) + ", " + std::to_string(key.y) +
                             " of level " + std::to_string(key.level);
    const std::vector<std::string> problems = reader.verify();
    ASSERT_EQ(problems.size(), 1u);
    EXPECT_NE(problems[0].find(name), std::string::npos) << problems[0];
    EXPECT_THROW(reader.read(key), TileStoreError);
    EXPECT_THROW(compactTilePack(path), TileStoreError);
    EXPECT_EQ(bytesOfFile(path).size(), bytes.size()); // as it was
}
