// SPDX-License-Identifier: MIT
#include "ChainSamples.h"
#include "LoaderRun.h"
#include "PictureFiles.h"

#include <osgPagedTexture/ChainLoader.h>

#include <support/TemporaryFolder.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>

using namespace osgPagedTexture;
using State = ChainResult::State;
namespace fs = std::filesystem;

class ChainLoaderFailureTest : public testing::Test
{
protected:
    ChainLoaderFailureTest()
    {
        settings.threads = 2;
        settings.cacheFolder = folder.file("cache");
        settings.retrySeconds = {0.05, 0.1};
    }
    ChainRequest requestFor(const std::string& file, int firstLevel = 0)
    {
        return {file, recipe, firstLevel, 0.0, 0};
    }
    /// A file that was written long ago, so that nobody may still be writing it.
    std::string settled(const std::string& name, const std::string& text)
    {
        const std::string path = folder.write(name, text);
        fs::last_write_time(path, fs::file_time_type::clock::now() - std::chrono::hours(1));
        return path;
    }

    support::TemporaryFolder folder;
    ChainLoaderSettings settings;
    std::shared_ptr<ChainRecipe> recipe = plainRecipe();
    const std::string good = encodeJpeg(samplePicture(64, 64, 3));
};

TEST_F(ChainLoaderFailureTest, AMissingFileFailsAfterItsRetriesAndIsNamedOnce)
{
    ChainLoader loader(settings);
    const auto start = std::chrono::steady_clock::now();
    loader.request(requestFor("/nowhere/a.jpg"));
    loader.request(requestFor("/nowhere/a.jpg", 1));
    const auto results = takeResults(loader);
    EXPECT_GE(std::chrono::steady_clock::now() - start, std::chrono::milliseconds(149));
    ASSERT_EQ(results.size(), 2u);
    EXPECT_EQ(results[0].state, State::Failed);
    EXPECT_EQ(loader.getStatistics().retried, 4u);
    const std::vector<std::string> expected = {"osgPagedTexture::ChainLoader: '/nowhere/a.jpg': "
                                               "there is no such file; check the path that "
                                               "the model names"};
    EXPECT_EQ(loader.takeMessages(), expected);
    loader.request(requestFor("/nowhere/a.jpg"));
    takeResults(loader);
    EXPECT_TRUE(loader.takeMessages().empty());
}

TEST_F(ChainLoaderFailureTest, AFileThatComesLateIsTaken)
{
    settings.retrySeconds = {0.05, 0.05, 60.0};
    ChainLoader loader(settings);
    loader.request(requestFor(folder.file("late.jpg")));
    waitUntil([&] { return loader.getStatistics().retried == 1; });
    folder.write("late.jpg", good);
    const auto results = takeResults(loader);
    ASSERT_EQ(results.size(), 1u);
    EXPECT_EQ(results[0].state, State::Complete);
    EXPECT_TRUE(loader.takeMessages().empty());
}

TEST_F(ChainLoaderFailureTest, AFileThatIsStillBeingWrittenIsTriedAgain)
{
    settings.retrySeconds = {0.05, 0.05, 60.0};
    ChainLoader loader(settings);
    const std::string path = folder.write("a.jpg", good.substr(0, good.size() / 2));
    loader.request(requestFor(path));
    waitUntil([&] { return loader.getStatistics().retried == 1; });
    folder.write("a.jpg", good);
    const auto results = takeResults(loader);
    ASSERT_EQ(results.size(), 1u);
    EXPECT_EQ(results[0].state, State::Complete);
}

TEST_F(ChainLoaderFailureTest, AYoungDamagedFileThatStaysAsItIsFailsAfterOneRetry)
{
    settings.retrySeconds = {0.05, 60.0, 60.0};
    ChainLoader loader(settings);
    loader.request(requestFor(folder.write("a.jpg", good.substr(0, good.size() / 2))));
    const auto results = takeResults(loader);
    ASSERT_EQ(results.size(), 1u);
    EXPECT_EQ(results[0].state, State::Failed);
    EXPECT_EQ(loader.getStatistics().retried, 1u);
}

TEST_F(ChainLoaderFailureTest, ADamagedFileFailsAtOnceAndIsNotCached)
{
    ChainLoader loader(settings);
    const std::string path = settled("a.jpg", good.substr(0, good.size() / 2));
    loader.request(requestFor(path));
    const auto results = takeResults(loader);
    ASSERT_EQ(results.size(), 1u);
    EXPECT_EQ(results[0].state, State::Failed);
    EXPECT_EQ(results[0].error, "'" + path +
                                    "': is a damaged JPEG (Premature end of JPEG file); "
                                    "copy it from its source again");
    EXPECT_EQ(loader.getStatistics().retried, 0u);
    EXPECT_EQ(loader.getStatistics().cache.written, 0u);
    EXPECT_EQ(loader.getStatistics().memoryBytes, 0u);
}

TEST_F(ChainLoaderFailureTest, ADamagedFileIsShownWhereAUserAsksForItButNeverCached)
{
    settings.showDegraded = true;
    ChainLoader loader(settings);
    loader.request(requestFor(settled("a.jpg", good.substr(0, good.size() / 2))));
    EXPECT_EQ(takeResults(loader).at(0).state, State::Complete);
    EXPECT_EQ(loader.getStatistics().cache.written, 0u);
    EXPECT_EQ(loader.takeMessages().size(), 1u) << "it is named all the same";
}

TEST_F(ChainLoaderFailureTest, ARecipeThatFailsFailsItsRequest)
{
    recipe->make = [](Pixels, int, int, int) -> MipChain { throw std::runtime_error("no blocks"); };
    ChainLoader loader(settings);
    const std::string path = settled("a.jpg", good);
    loader.request(requestFor(path));
    EXPECT_EQ(takeResults(loader).at(0).error, "'" + path + "': cannot be encoded: no blocks");
}

TEST_F(ChainLoaderFailureTest, OneFailureHoldsNoOtherUp)
{
    settings.retrySeconds = {60.0};
    ChainLoader loader(settings);
    for (int i = 0; i < 5; ++i)
    {
        loader.request(requestFor("/nowhere/" + std::to_string(i)));
    }
    loader.request(requestFor(settled("a.jpg", good)));
    std::vector<ChainResult> results;
    waitUntil([&] { return !(results = loader.poll()).empty(); });
    ASSERT_EQ(results.size(), 1u);
    EXPECT_EQ(results[0].state, State::Complete);
    EXPECT_EQ(loader.getStatistics().waiting, 5u);
}
