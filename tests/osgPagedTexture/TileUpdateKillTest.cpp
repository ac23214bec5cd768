// SPDX-License-Identifier: MIT
// Updates are killed at random moments; the store must be the old or the new one, and the next
// update must do the rest.
#include "UpdateSamples.h"

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <thread>

#include <sys/wait.h>
#include <unistd.h>

using namespace osgPagedTexture;
namespace fs = std::filesystem;

namespace
{

using Clock = std::chrono::steady_clock;

TileUpdateSettings quickSettings()
{
    TileUpdateSettings settings;
    settings.threads = 2;
    // A killed process loses nothing that it has written: only the order counts.
    settings.pack.durable = false;
    return settings;
}

/// Changes, adds, removes or moves a photograph, or some of that at once.
void changeSomething(const UpdateSample& sample, std::mt19937& random, unsigned int step)
{
    const std::vector<std::string> files = findPhotos(sample.photo(""));
    const std::string file = files[random() % files.size()];
    switch (random() % 8)
    {
    case 0:
        sample.writePhoto("new" + std::to_string(step) + ".jpg", 60 + int(random() % 100), 80,
                          step);
        break;
    case 1:
        if (files.size() > 8)
        {
            fs::remove(sample.photo(file));
        }
        break;
    case 2:
        fs::rename(sample.photo(file), sample.photo("moved" + std::to_string(step) + ".jpg"));
        break;
    case 3:
        sample.writePhoto(file, 60 + int(random() % 200), 60 + int(random() % 200), step);
        break;
    default:
        for (const AtlasPhoto& photo : sample.layout().photos)
        {
            if (photo.path == "photos/" + file)
            {
                sample.writePhoto(file, photo.width, photo.height, step);
            }
        }
    }
}

/// Runs an update in another process and kills that after some time; true where it was still
/// running.
bool updateAndKill(const UpdateSample& sample, std::chrono::microseconds after)
{
    const pid_t child = fork();
    if (child == 0)
    {
        try
        {
            updateTileStore(sample.store(), quickSettings());
            _exit(0);
        }
        catch (const std::exception& error)
        {
            std::fprintf(stderr, "%s\n", error.what());
            _exit(1);
        }
    }
    std::this_thread::sleep_for(after);
    kill(child, SIGKILL);
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status) || WEXITSTATUS(status) == 0);
    return WIFSIGNALED(status);
}

void expectWhole(const UpdateSample& sample, int kill)
{
    for (const std::string& path : {sample.store(), keptPathOf(sample.store())})
    {
        const std::vector<std::string> problems = TilePackReader(path).verify();
        ASSERT_TRUE(problems.empty()) << "kill " << kill << ": " << problems.front();
    }
    ASSERT_NO_THROW(sample.layout()) << "kill " << kill;
}

TEST(TileUpdateKill, everyKillLeavesAStoreThatTheNextUpdateCompletes)
{
    const int kills = std::getenv("OSGKITS_LONG") ? 500 : 40;
    const UpdateSample sample(16, 1);
    sample.build();
    std::mt19937 random(5);
    const auto start = Clock::now();
    changeSomething(sample, random, 1);
    updateTileStore(sample.store(), quickSettings());
    const auto whole =
        std::chrono::duration_cast<std::chrono::microseconds>(Clock::now() - start).count();
    int killed = 0, rebuilt = 0, step = 2;
    for (int kill = 1; kill <= kills; ++step)
    {
        changeSomething(sample, random, unsigned(step));
        const std::chrono::microseconds after(random() % std::uint64_t(whole + whole / 4));
        if (!updateAndKill(sample, after))
        {
            continue; // it had finished
        }
        ++killed;
        expectWhole(sample, kill);
        // Some kills hit what an earlier one has left.
        if (random() % 3 != 0)
        {
            const TileUpdateReport report = updateTileStore(sample.store(), quickSettings());
            rebuilt += !report.rebuilt.empty();
            ASSERT_TRUE(report.failures.empty()) << report.failures.front();
            ASSERT_TRUE(sample.layout().pending.empty());
            ASSERT_TRUE(updateTileStore(sample.store(), quickSettings()).isNothing()) << kill;
        }
        if (kill % 10 == 0)
        {
            updateTileStore(sample.store(), quickSettings());
            ASSERT_TRUE(sample.equalsFullBuild()) << "kill " << kill;
        }
        ++kill;
    }
    EXPECT_EQ(killed, kills);
    EXPECT_LT(rebuilt, kills / 5) << "what a kill leaves is not done by building all";
}

} // namespace
