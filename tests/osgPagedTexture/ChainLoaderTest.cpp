// SPDX-License-Identifier: MIT
#include "ChainSamples.h"
#include "LoaderRun.h"
#include "PictureFiles.h"

#include <osgPagedTexture/ChainLoader.h>

#include <support/TemporaryFolder.h>

#include <gtest/gtest.h>

#include <filesystem>

using namespace osgPagedTexture;
using State = ChainResult::State;
namespace fs = std::filesystem;

class ChainLoaderTest : public testing::Test
{
protected:
    std::string jpeg(const std::string& name, int width, int height, unsigned int seed = 1)
    {
        return folder.write(name, encodeJpeg(samplePicture(width, height, 3, seed)));
    }
    ChainLoaderSettings withCache(unsigned int threads = 2)
    {
        ChainLoaderSettings settings;
        settings.threads = threads;
        settings.cacheFolder = folder.file("cache");
        settings.retrySeconds = {0.05, 0.1};
        return settings;
    }
    ChainRequest requestFor(const std::string& file, int firstLevel = 0, int previewSide = 0)
    {
        return {file, recipe, firstLevel, 0.0, previewSide};
    }

    support::TemporaryFolder folder;
    std::shared_ptr<ChainRecipe> recipe = plainRecipe();
};

TEST_F(ChainLoaderTest, ARequestGivesTheChainOfItsLevel)
{
    const std::string file = jpeg("a.jpg", 200, 100);
    for (int level : {0, 2, 20})
    {
        ChainLoader loader;
        loader.request(requestFor(file, level));
        const auto results = takeResults(loader);
        ASSERT_EQ(results.size(), 1u);
        ASSERT_EQ(results[0].state, State::Complete) << results[0].error;
        ReadSettings settings;
        settings.reduction = std::min(level, 7);
        EXPECT_TRUE(*results[0].chain ==
                    plainChain(readImageFile(file, settings).pixels, settings.reduction, 200, 100));
    }
}

TEST_F(ChainLoaderTest, ASecondStartDecodesNothing)
{
    const std::string file = jpeg("a.jpg", 200, 100);
    MipChain first;
    {
        ChainLoader loader(withCache());
        loader.request(requestFor(file));
        first = *takeResults(loader).at(0).chain;
    }
    ChainLoader loader(withCache());
    loader.request(requestFor(file));
    EXPECT_TRUE(*takeResults(loader).at(0).chain == first);
    const auto statistics = loader.getStatistics();
    EXPECT_EQ(statistics.filesDecoded, 0u);
    EXPECT_EQ(statistics.cache.hits, 1u);
}

TEST_F(ChainLoaderTest, AFileThatChangedKeepsNoOldTexels)
{
    ChainLoader loader(withCache());
    for (unsigned int seed = 1; seed < 6; ++seed)
    {
        // Within the same second and of the same size.
        for (const char* name : {"a.bmp", "a.jpg"})
        {
            const Pixels picture = samplePicture(64, 64, 3, seed);
            const std::string path = folder.file(name);
            name == std::string("a.jpg") ? void(folder.write(name, encodeJpeg(picture)))
                                         : writePicture(path, picture);
            loader.request(requestFor(path));
            EXPECT_TRUE(*takeResults(loader).at(0).chain ==
                        plainChain(readImageFile(path).pixels, 0, 64, 64))
                << name << seed;
        }
    }
}

TEST_F(ChainLoaderTest, ThePreviewsOfAllComeBeforeTheRest)
{
    GatedRecipe gated; // until all are there
    recipe = gated.recipe;
    ChainLoader loader(withCache(1));
    for (int i = 0; i < 6; ++i)
    {
        ChainRequest request = requestFor(jpeg(std::to_string(i) + ".jpg", 256, 128, i), 0, 32);
        request.priority = i;
        loader.request(request);
    }
    gated.open();
    const auto results = takeResults(loader);
    ASSERT_EQ(results.size(), 12u);
    for (int i = 0; i < 12; ++i)
    {
        EXPECT_EQ(results[i].state, i < 6 ? State::Preview : State::Complete) << i;
        EXPECT_EQ(results[i].chain->firstLevel, i < 6 ? 3 : 0) << i;
    }
}

TEST_F(ChainLoaderTest, ASmallPictureHasNoPreview)
{
    ChainLoader loader(withCache());
    loader.request(requestFor(jpeg("a.jpg", 32, 16), 0, 32));
    loader.request(requestFor(jpeg("b.jpg", 128, 16), 2, 32));
    const auto results = takeResults(loader);
    ASSERT_EQ(results.size(), 2u);
    EXPECT_EQ(results[0].state, State::Complete);
    EXPECT_EQ(results[1].state, State::Complete);
    EXPECT_EQ(loader.getStatistics().filesDecoded, 2u);
}

TEST_F(ChainLoaderTest, EqualRequestsAreOne)
{
    GatedRecipe gated;
    recipe = gated.recipe;
    ChainLoader loader(withCache());
    const std::string file = jpeg("a.jpg", 64, 64);
    const RequestId first = loader.request(requestFor(file));
    EXPECT_EQ(loader.request(requestFor(file)), first);
    EXPECT_NE(loader.request(requestFor(file, 1)), first);
    loader.cancel(first); // one of its two callers
    gated.open();
    EXPECT_EQ(takeResults(loader).size(), 2u);
    EXPECT_NE(loader.request(requestFor(file)), first) << "the first has ended";
}

TEST_F(ChainLoaderTest, ACancelledRequestGivesNothingAtAnyStage)
{
    GatedRecipe gated;
    recipe = gated.recipe;
    ChainLoader loader(withCache(1));
    const RequestId running = loader.request(requestFor(jpeg("a.jpg", 64, 64)));
    gated.waitUntilEntered();
    const RequestId waiting = loader.request(requestFor(jpeg("b.jpg", 64, 64)));
    loader.cancel(running);
    loader.cancel(waiting);
    gated.open();
    EXPECT_TRUE(takeResults(loader).empty());
    const RequestId ready = loader.request(requestFor(jpeg("c.jpg", 64, 64)));
    waitUntil([&] { return loader.getStatistics().waiting == 0; });
    loader.cancel(ready);
    EXPECT_TRUE(loader.poll().empty());
    waitUntil([&] { return loader.getStatistics().memoryBytes == 0; });
    EXPECT_EQ(loader.getStatistics().memoryBytes, 0u);
}

TEST_F(ChainLoaderTest, PrioritiesChangeTheOrderWhileTheyWait)
{
    GatedRecipe gated;
    recipe = gated.recipe;
    ChainLoader loader(withCache(1));
    loader.request(requestFor(jpeg("first.jpg", 64, 64)));
    gated.waitUntilEntered();
    std::vector<RequestId> ids;
    for (int i = 0; i < 4; ++i)
    {
        ids.push_back(loader.request(requestFor(jpeg(std::to_string(i) + ".jpg", 64, 64, i))));
    }
    loader.setPriority(ids[2], 5.0);
    loader.setPriority(ids[0], -5.0);
    gated.open();
    const auto results = takeResults(loader);
    ASSERT_EQ(results.size(), 5u);
    EXPECT_EQ(results[1].id, ids[2]);
    EXPECT_EQ(results[4].id, ids[0]);
}

TEST_F(ChainLoaderTest, WhatWaitsForPollStaysWithinTheMemoryBudget)
{
    ChainLoaderSettings settings = withCache(2);
    settings.cacheFolder.clear();
    settings.memoryBytes = 2000000;
    ChainLoader loader(settings);
    for (int i = 0; i < 30; ++i)
    {
        loader.request(requestFor(jpeg(std::to_string(i) + ".jpg", 256, 256, i))); // 262 KB each
    }
    for (int i = 0; i < 20; ++i)
    {
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
        EXPECT_LE(loader.getStatistics().memoryBytes, 2000000u);
    }
    EXPECT_GT(loader.getStatistics().waiting, 15u) << "nobody took a result";
    EXPECT_EQ(takeResults(loader).size(), 30u);
    EXPECT_LE(loader.getStatistics().peakMemoryBytes, 2000000u);
    EXPECT_EQ(loader.getStatistics().memoryBytes, 0u);
}

TEST_F(ChainLoaderTest, AChainLargerThanTheBudgetComesAlone)
{
    ChainLoaderSettings settings = withCache(2);
    settings.memoryBytes = 1000;
    ChainLoader loader(settings);
    for (int i = 0; i < 4; ++i)
    {
        loader.request(requestFor(jpeg(std::to_string(i) + ".jpg", 100, 100, i)));
    }
    EXPECT_EQ(takeResults(loader).size(), 4u);
    // File, pixels and a chain of one picture.
    EXPECT_LT(loader.getStatistics().peakMemoryBytes, 100u * 100 * 3 * 3 + 30000);
}

TEST_F(ChainLoaderTest, CacheTroubleIsToldAndLoadingGoesOn)
{
    ChainLoaderSettings settings = withCache();
    settings.cacheFolder = folder.write("file", "in the place of the folder");
    ChainLoader loader(settings);
    loader.request(requestFor(jpeg("a.jpg", 64, 64)));
    loader.request(requestFor(jpeg("b.jpg", 64, 64)));
    EXPECT_EQ(takeResults(loader).size(), 2u);
    EXPECT_EQ(loader.takeMessages().size(), 1u);
}

TEST_F(ChainLoaderTest, ADamagedCacheEntryIsMadeAgain)
{
    const std::string file = jpeg("a.jpg", 64, 64);
    MipChain first;
    {
        ChainLoader loader(withCache());
        loader.request(requestFor(file));
        first = *takeResults(loader).at(0).chain;
    }
    for (const auto& entry : fs::recursive_directory_iterator(folder.file("cache")))
    {
        if (entry.path().extension() == ".dds")
        {
            fs::resize_file(entry.path(), entry.file_size() - 3);
        }
    }
    ChainLoader loader(withCache());
    loader.request(requestFor(file));
    EXPECT_TRUE(*takeResults(loader).at(0).chain == first);
    EXPECT_EQ(loader.getStatistics().cache.damaged, 1u);
    EXPECT_EQ(loader.getStatistics().filesDecoded, 1u);
}

TEST_F(ChainLoaderTest, ItsEndWhileLoadingIsCleanAndSoon)
{
    for (int round = 0; round < 10; ++round)
    {
        ChainLoaderSettings settings = withCache(2);
        settings.cacheFolder.clear();
        settings.memoryBytes = round % 2 ? 1 : 100000000;
        ChainLoader loader(settings);
        for (int i = 0; i < 20; ++i)
        {
            loader.request(requestFor(jpeg(std::to_string(i) + ".jpg", 300, 300, i), 0, 32));
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(round));
    }
}
