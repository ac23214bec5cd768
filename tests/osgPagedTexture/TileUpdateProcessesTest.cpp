// SPDX-License-Identifier: MIT
#include "UpdateSamples.h"

#include <osgPagedTexture/AtlasWatch.h>

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <thread>

#include <sys/wait.h>
#include <unistd.h>

using namespace osgPagedTexture;
namespace fs = std::filesystem;

namespace
{

void change(const UpdateSample& sample, std::size_t photo, unsigned int seed)
{
    const AtlasPhoto before = sample.layout().photos[photo];
    sample.writePhoto(fs::path(before.path).filename().string(), before.width, before.height, seed);
}

TEST(TileUpdateProcesses, aSecondOneSaysThatAnotherUpdates)
{
    const UpdateSample sample(5);
    sample.build();
    change(sample, 2, 77);
    const AtlasLock lock(sample.layoutFile());
    try
    {
        updateTileStore(sample.store());
        FAIL();
    }
    catch (const TileStoreError& error)
    {
        EXPECT_EQ(error.getKind(), TileStoreError::Kind::Busy);
        EXPECT_NE(std::string(error.what()).find(std::to_string(getpid())), std::string::npos);
    }
}

TEST(TileUpdateProcesses, severalThatWaitDoAllThatIsToBeDone)
{
    const UpdateSample sample(20);
    sample.build();
    for (unsigned int round = 0; round < 5; ++round)
    {
        change(sample, round, 100 + round);
        std::vector<pid_t> children;
        for (int i = 0; i < 3; ++i)
        {
            children.push_back(fork());
            if (children.back() == 0)
            {
                TileUpdateSettings settings;
                settings.pack.waitSeconds = 60.0;
                try
                {
                    updateTileStore(sample.store(), settings);
                    _exit(0);
                }
                catch (const std::exception&)
                {
                    _exit(1);
                }
            }
        }
        for (const pid_t child : children)
        {
            int status = 0;
            waitpid(child, &status, 0);
            EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
        }
        ASSERT_TRUE(sample.equalsFullBuild()) << round;
    }
}

TEST(TileUpdateProcesses, aReaderSeesTheFormerStoreUntilItLooksAgain)
{
    const UpdateSample sample(5);
    sample.build();
    TilePackReader reader(sample.store());
    const TileData before = reader.read({0, 0, 0});
    for (std::size_t i = 0; i < 5; ++i)
    {
        change(sample, i, 300 + unsigned(i));
    }
    updateTileStore(sample.store());
    EXPECT_TRUE(reader.read({0, 0, 0}) == before);
    EXPECT_TRUE(reader.refresh());
    EXPECT_FALSE(reader.read({0, 0, 0}) == before);
}

TEST(TileUpdateProcesses, aPhotographThatCannotBeReadKeepsItsTiles)
{
    const UpdateSample sample(12);
    sample.build();
    const std::string before = UpdateSample::bytesOf(sample.store());
    const std::string broken = sample.photo(UpdateSample::nameOf(3));
    std::ofstream(broken) << "no picture";
    const TileUpdateReport report = updateTileStore(sample.store());
    ASSERT_EQ(report.failures.size(), 1u);
    EXPECT_NE(report.failures[0].find(UpdateSample::nameOf(3)), std::string::npos);
    EXPECT_EQ(UpdateSample::bytesOf(sample.store()), before);
    change(sample, 7, 55);
    EXPECT_EQ(updateTileStore(sample.store()).changed, 1u) << "the others are done";
}

TEST(TileUpdateProcesses, missingPhotographsAreKeptWhereThatIsAskedFor)
{
    const UpdateSample sample(12);
    sample.build();
    fs::remove(sample.photo(UpdateSample::nameOf(3)));
    TileUpdateSettings settings;
    settings.keepMissing = true;
    const TileUpdateReport report = updateTileStore(sample.store(), settings);
    EXPECT_EQ(report.removed, 0u);
    EXPECT_EQ(report.notes.size(), 1u);
    EXPECT_EQ(sample.layout().photos.size(), 12u);
    EXPECT_EQ(updateTileStore(sample.store()).removed, 1u);
}

TEST(TileUpdateProcesses, aStoreIsNotEmptiedWhenItsDiskIsNotThere)
{
    const UpdateSample sample(5);
    sample.build();
    fs::rename(sample.photo(""), sample.store() + ".elsewhere");
    fs::create_directories(sample.photo(""));
    EXPECT_THROW(updateTileStore(sample.store()), TileStoreError);
    EXPECT_EQ(sample.layout().photos.size(), 5u);
}

TEST(TileUpdateProcesses, whatIsNotThereIsBuiltAnew)
{
    const UpdateSample sample(12);
    sample.build();
    fs::remove(keptPathOf(sample.store()));
    change(sample, 1, 99);
    EXPECT_NE(updateTileStore(sample.store()).rebuilt.find(".mips' is not there"),
              std::string::npos);
    EXPECT_TRUE(sample.equalsFullBuild());
    AtlasLayout layout = sample.layout();
    std::swap(layout.photos[0].path, layout.photos[1].path);
    std::swap(layout.photos[0].hash, layout.photos[1].hash);
    writeAtlasLayout(sample.layoutFile(), layout);
    EXPECT_NE(updateTileStore(sample.store()).rebuilt.find("another state of its layout"),
              std::string::npos);
    EXPECT_TRUE(sample.equalsFullBuild());
}

TEST(TileUpdateProcesses, aStoreWithoutALayoutIsRefused)
{
    const support::TemporaryFolder folder;
    TileStoreSettings settings;
    settings.grid = TileGrid(64, 64, 32, 0);
    TilePackWriter(folder.file("a.tiles"), settings, {}).commit();
    EXPECT_THROW(updateTileStore(folder.file("a.tiles")), TileStoreError);
}

TEST(TileUpdateProcesses, aWatchSeesWhatRestsAndNothingElse)
{
    const UpdateSample sample(5);
    sample.build();
    AtlasWatch watch(sample.layout(), fs::path(sample.store()).parent_path().string());
    EXPECT_FALSE(watch.look());
    change(sample, 1, 5);
    EXPECT_FALSE(watch.look()) << "it may still be written";
    EXPECT_TRUE(watch.look());
    EXPECT_FALSE(watch.look()) << "once";
    sample.writePhoto("another.jpg", 20, 20, 1);
    watch.look();
    sample.writePhoto("another.jpg", 40, 20, 1);
    EXPECT_FALSE(watch.look()) << "it was written between the looks";
    EXPECT_TRUE(watch.look());
    fs::remove(sample.photo("another.jpg"));
    watch.look();
    EXPECT_TRUE(watch.look());
}

} // namespace
