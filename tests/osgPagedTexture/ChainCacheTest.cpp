// SPDX-License-Identifier: MIT
#include "ChainSamples.h"

#include <osgPagedTexture/ChainCache.h>

#include <support/TemporaryFolder.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <thread>

using namespace osgPagedTexture;
namespace fs = std::filesystem;

namespace
{

constexpr std::uint64_t Plenty = 1 << 30;

MipChain fromLevel(MipChain chain, int level)
{
    chain.levels.erase(chain.levels.begin(), chain.levels.begin() + (level - chain.firstLevel));
    chain.firstLevel = level;
    return chain;
}

std::uint64_t bytesIn(const fs::path& folder)
{
    std::uint64_t bytes = 0;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
    {
        bytes += entry.is_regular_file() ? entry.file_size() : 0;
    }
    return bytes;
}

std::string readText(const std::string& path)
{
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

} // namespace

class ChainCacheTest : public testing::Test
{
protected:
    support::TemporaryFolder folder;
    const std::string path = folder.file("cache");
    const ContentHash key = chainKey(hashText("a picture"), "settings");
};

TEST_F(ChainCacheTest, EveryFormatComesBackAsItWas)
{
    for (int i = 0; i <= static_cast<int>(BlockFormat::BC7); ++i)
    {
        const auto format = static_cast<BlockFormat>(i);
        for (const auto& [width, height] : {std::pair{37, 20}, {1, 1}, {1, 512}, {64, 64}})
        {
            ChainCache cache(path, Plenty);
            const MipChain chain = sampleChain(format, width, height, 0, i);
            const ContentHash one =
                chainKey(hashText(formatName(format)), std::to_string(width * 1000 + height));
            ASSERT_TRUE(cache.write(one, chain));
            const auto found = ChainCache(path, Plenty).read(one, 0);
            EXPECT_TRUE(found && *found == chain) << formatName(format) << width;
        }
    }
}

TEST_F(ChainCacheTest, OnlyTheLevelsThatAreAskedForAreRead)
{
    ChainCache cache(path, Plenty);
    const MipChain chain = sampleChain(BlockFormat::BC1, 1000, 600);
    cache.write(key, chain);
    for (int level = 0; level < levelCount(1000, 600); ++level)
    {
        const std::uint64_t before = cache.getStatistics().bytesRead;
        const auto found = cache.read(key, level);
        ASSERT_TRUE(found && *found == fromLevel(chain, level)) << level;
        EXPECT_EQ(cache.getStatistics().bytesRead - before, found->bytes() + 10 * 8) << level;
    }
    EXPECT_EQ(cache.read(key, 99)->firstLevel, 9) << "there is no coarser one";
}

TEST_F(ChainCacheTest, ACoarseEntryServesNoFinerLevelAndGivesWayToAFinerOne)
{
    ChainCache cache(path, Plenty);
    const MipChain chain = sampleChain(BlockFormat::BC3, 256, 128);
    EXPECT_TRUE(cache.write(key, fromLevel(chain, 3)));
    EXPECT_FALSE(cache.read(key, 2));
    EXPECT_TRUE(*cache.read(key, 4) == fromLevel(chain, 4));
    EXPECT_TRUE(cache.write(key, chain));
    EXPECT_TRUE(*cache.read(key, 0) == chain);
    EXPECT_TRUE(cache.write(key, fromLevel(chain, 5)));
    EXPECT_TRUE(*cache.read(key, 0) == chain) << "a coarser one must not replace it";
}

TEST_F(ChainCacheTest, OtherContentAndOtherSettingsAreOtherEntries)
{
    ChainCache cache(path, Plenty);
    cache.write(key, sampleChain(BlockFormat::BC1, 8, 8));
    EXPECT_FALSE(cache.read(chainKey(hashText("a picture"), "settings2"), 0));
    EXPECT_FALSE(cache.read(chainKey(hashText("b picture"), "settings"), 0));
}

TEST_F(ChainCacheTest, AnEntryUnderAnotherNameIsNotTakenForIt)
{
    ChainCache cache(path, Plenty);
    cache.write(key, sampleChain(BlockFormat::BC1, 8, 8));
    const ContentHash other = chainKey(hashText("b picture"), "settings");
    fs::create_directories(fs::path(cache.getPath(other)).parent_path());
    fs::copy_file(cache.getPath(key), cache.getPath(other));
    EXPECT_FALSE(cache.read(other, 0));
}

TEST_F(ChainCacheTest, NoFlippedByteAndNoCutIsEverShown)
{
    // A chain without its finest levels does not show the width of level 0 in their sizes.
    const MipChain chains[] = {sampleChain(BlockFormat::BC1, 12, 8),
                               sampleChain(BlockFormat::BC7, 12, 8),
                               sampleChain(BlockFormat::RGB8, 13, 9, 2)};
    for (const MipChain& chain : chains)
    {
        ChainCache(path, Plenty).write(key, chain);
        const std::string file = ChainCache(path, Plenty).getPath(key);
        const std::string good = readText(file);
        for (std::size_t i = 0; i < 8 * good.size(); ++i)
        {
            const std::size_t at = i / 8;
            const int bit = 1 << i % 8;
            std::string bad = good;
            bad[at] = static_cast<char>(bad[at] ^ bit);
            std::ofstream(file, std::ios::binary) << bad;
            ChainCache cache(path, Plenty);
            EXPECT_FALSE(cache.read(key, chain.firstLevel))
                << formatName(chain.format) << " byte " << at;
            EXPECT_FALSE(fs::exists(file)) << "removed, to be made again";
            EXPECT_EQ(cache.getStatistics().damaged, 1u);
        }
        for (std::size_t size = 0; size < good.size(); ++size)
        {
            std::ofstream(file, std::ios::binary) << good.substr(0, size);
            EXPECT_FALSE(ChainCache(path, Plenty).read(key, chain.firstLevel)) << size;
        }
        std::ofstream(file, std::ios::binary) << good + "x";
        EXPECT_FALSE(ChainCache(path, Plenty).read(key, chain.firstLevel)) << "longer";
    }
}

TEST_F(ChainCacheTest, WhatWasReadLongestAgoGoesFirst)
{
    const MipChain chain = sampleChain(BlockFormat::RGBA8, 64, 64); // 21.8 KB
    ChainCache cache(path, 250000);
    std::vector<ContentHash> keys;
    const auto now = fs::file_time_type::clock::now();
    for (int i = 0; i < 10; ++i)
    {
        keys.push_back(chainKey(hashText(std::to_string(i)), ""));
        cache.write(keys.back(), chain);
        fs::last_write_time(cache.getPath(keys.back()), now - std::chrono::hours(100 - i));
    }
    EXPECT_TRUE(cache.read(keys[0], 0)) << "now the last that goes";
    for (int i = 10; i < 13; ++i)
    {
        cache.write(chainKey(hashText(std::to_string(i)), ""), chain);
    }
    EXPECT_TRUE(fs::exists(cache.getPath(keys[0])));
    EXPECT_FALSE(fs::exists(cache.getPath(keys[1])));
    EXPECT_TRUE(fs::exists(cache.getPath(keys[9])));
    EXPECT_LE(bytesIn(path), 250000u);
    EXPECT_GT(cache.getStatistics().evicted, 0u);
}

TEST_F(ChainCacheTest, TheLimitHoldsOverManyWritesOfTwoCaches)
{
    ChainCache one(path, 300000), two(path, 300000);
    for (int i = 0; i < 60; ++i)
    {
        (i % 2 ? one : two)
            .write(chainKey(hashText(std::to_string(i)), ""),
                   sampleChain(BlockFormat::RGBA8, 64, 64));
        // Each looks at the folder again after an eighth of the limit.
        EXPECT_LE(bytesIn(path), 300000u * 5 / 4) << i;
    }
}

TEST_F(ChainCacheTest, EntriesOfTheFutureGoToo)
{
    // The clock went back a year since they were written.
    ChainCache cache(path, 100000);
    const auto future = fs::file_time_type::clock::now() + std::chrono::hours(24 * 365);
    for (int i = 0; i < 20; ++i)
    {
        const ContentHash one = chainKey(hashText(std::to_string(i)), "");
        EXPECT_TRUE(cache.write(one, sampleChain(BlockFormat::RGBA8, 64, 64)));
        EXPECT_TRUE(cache.read(one, 0));
        fs::last_write_time(cache.getPath(one), future);
        EXPECT_LE(bytesIn(path), 125000u);
    }
}

TEST_F(ChainCacheTest, LeftOverTemporaryFilesAreRemoved)
{
    fs::create_directories(fs::path(path) / "ab");
    const fs::path old = fs::path(path) / "ab/old.dds.1.part",
                   young = fs::path(path) / "ab/new.part";
    std::ofstream(old) << "left by a process that was killed";
    std::ofstream(young) << "being written";
    fs::last_write_time(old, fs::file_time_type::clock::now() - std::chrono::hours(2));
    ChainCache(path, Plenty).write(key, sampleChain(BlockFormat::BC1, 8, 8));
    EXPECT_FALSE(fs::exists(old));
    EXPECT_TRUE(fs::exists(young));
}

TEST_F(ChainCacheTest, WithoutAFolderNothingIsKeptAndNothingSaid)
{
    ChainCache cache("", Plenty);
    EXPECT_FALSE(cache.write(key, sampleChain(BlockFormat::BC1, 8, 8)));
    EXPECT_FALSE(cache.read(key, 0));
    EXPECT_TRUE(cache.takeMessages().empty());
}

TEST_F(ChainCacheTest, ThreadsShareIt)
{
    ChainCache cache(path, 400000);
    std::vector<std::thread> threads;
    std::atomic<int> wrong{0};
    for (int thread = 0; thread < 4; ++thread)
    {
        threads.emplace_back(
            [&, thread]
            {
                for (int i = 0; i < 100; ++i)
                {
                    const unsigned int number = (i * 7 + thread) % 30;
                    const MipChain chain =
                        sampleChain(BlockFormat::BC1, 128, 64 + number, 0, number);
                    const ContentHash one = chainKey(hashText(std::to_string(number)), "");
                    cache.write(one, chain);
                    const auto found = cache.read(one, 0);
                    wrong += found && !(*found == chain);
                }
            });
    }
    for (std::thread& thread : threads)
    {
        thread.join();
    }
    EXPECT_EQ(wrong, 0);
    EXPECT_EQ(cache.getStatistics().damaged, 0u);
    EXPECT_TRUE(cache.takeMessages().empty());
}
