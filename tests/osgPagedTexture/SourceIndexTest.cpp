// SPDX-License-Identifier: MIT
#include <osgPagedTexture/SourceIndex.h>

#include <support/TemporaryFolder.h>

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>

using namespace osgPagedTexture;
namespace fs = std::filesystem;

namespace
{

constexpr std::int64_t Second = 1000000000;

FileStamp stampAt(std::int64_t seconds)
{
    return {100, 5, seconds * Second, seconds * Second};
}

} // namespace

class SourceIndexTest : public testing::Test
{
protected:
    support::TemporaryFolder folder;
    const std::string file = folder.file("cache/sources.index");
    const ContentHash hash = hashText("content");
};

TEST_F(SourceIndexTest, AnUnchangedFileIsKnownInTheNextRun)
{
    SourceIndex(file).remember("a.jpg", stampAt(1000), hash, 2000 * Second);
    SourceIndex next(file);
    EXPECT_EQ(next.find("a.jpg", stampAt(1000)), hash);
    EXPECT_FALSE(next.find("b.jpg", stampAt(1000)));
}

TEST_F(SourceIndexTest, EachPartOfTheStampTellsOfAChange)
{
    SourceIndex index(file);
    index.remember("a.jpg", stampAt(1000), hash, 2000 * Second);
    FileStamp stamps[4] = {stampAt(1000), stampAt(1000), stampAt(1000), stampAt(1000)};
    ++stamps[0].bytes;
    ++stamps[1].inode;
    ++stamps[2].modified;
    ++stamps[3].changed; // as when the time of modification was set back by hand
    for (const FileStamp& stamp : stamps)
    {
        EXPECT_FALSE(index.find("a.jpg", stamp));
    }
}

TEST_F(SourceIndexTest, AFileThatMayChangeWithinItsTimeStampIsNotTrusted)
{
    SourceIndex index(file);
    // Hashed within two seconds of its change, or before it by a clock that went back.
    for (const std::int64_t hashedAt : {1000 * Second, 1002 * Second - 1, 1 * Second})
    {
        index.remember("a.jpg", stampAt(1000), hash, hashedAt);
        EXPECT_FALSE(index.find("a.jpg", stampAt(1000))) << hashedAt;
    }
    index.remember("a.jpg", stampAt(1000), hash, 1002 * Second);
    EXPECT_TRUE(index.find("a.jpg", stampAt(1000)));
}

TEST_F(SourceIndexTest, AChangeWithinTheSameSecondIsNoticed)
{
    SourceIndex index(file);
    const std::string path = folder.write("a.jpg", "first content");
    const FileStamp before = *stampOf(path);
    index.remember(path, before, hash, wallClock());
    // The worst: the same size, and the time of modification set back to the same.
    const auto time = fs::last_write_time(path);
    std::ofstream(path) << "other content";
    fs::last_write_time(path, time);
    EXPECT_FALSE(index.find(path, *stampOf(path)));
}

TEST_F(SourceIndexTest, TheLastRecordCounts)
{
    SourceIndex index(file);
    index.remember("a.jpg", stampAt(1000), hash, 2000 * Second);
    index.remember("a.jpg", stampAt(1500), hashText("new"), 2000 * Second);
    EXPECT_FALSE(SourceIndex(file).find("a.jpg", stampAt(1000)));
    EXPECT_EQ(SourceIndex(file).find("a.jpg", stampAt(1500)), hashText("new"));
}

TEST_F(SourceIndexTest, DamageCostsNoMoreThanTheRecordsItMeets)
{
    SourceIndex index(file);
    for (int i = 0; i < 20; ++i)
    {
        index.remember(std::to_string(i), stampAt(i), hash, 2000 * Second);
    }
    const auto size = fs::file_size(file);
    std::ifstream in(file, std::ios::binary);
    const std::string good{std::istreambuf_iterator<char>(in), {}};
    for (std::size_t at = 0; at < size; at += 7)
    {
        for (int mutation = 0; mutation < 2; ++mutation)
        {
            std::string bad = good;
            mutation ? bad.erase(at, 5) : (bad[at] = static_cast<char>(bad[at] ^ 4), bad);
            std::ofstream(file, std::ios::binary) << bad;
            SourceIndex damaged(file);
            int known = 0;
            for (int i = 0; i < 20; ++i)
            {
                const auto found = damaged.find(std::to_string(i), stampAt(i));
                known += found.has_value();
                ASSERT_TRUE(!found || *found == hash);
            }
            ASSERT_GE(known, 18) << at;
            ASSERT_LT(known, 20) << at;
        }
    }
}

TEST_F(SourceIndexTest, OutdatedRecordsDoNotPileUp)
{
    SourceIndex index(file);
    for (int i = 0; i < 5000; ++i)
    {
        index.remember("a.jpg", stampAt(i), hash, 20000 * Second);
    }
    EXPECT_EQ(SourceIndex(file).find("a.jpg", stampAt(4999)), hash);
    EXPECT_LT(fs::file_size(file), 200u);
}

TEST_F(SourceIndexTest, AFolderThatCannotBeWrittenIsNoTrouble)
{
    SourceIndex index("/proc/nowhere/sources.index");
    index.remember("a.jpg", stampAt(1000), hash, 2000 * Second);
    EXPECT_TRUE(index.find("a.jpg", stampAt(1000)));
}
