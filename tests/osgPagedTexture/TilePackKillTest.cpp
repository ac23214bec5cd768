// SPDX-License-Identifier: MIT
// A writer is killed at random moments; the store must be the old or the new one.
#include "TilePackSamples.h"

#include <support/TemporaryFolder.h>

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <random>

#include <sys/wait.h>
#include <unistd.h>

using namespace osgPagedTexture;

namespace
{

enum class Work
{
    Update,
    Compact,
    Build
};

/// Works on the store for ever and reports each version that it has committed.
[[noreturn]] void workUntilKilled(const std::string& path, Work work, unsigned int version,
                                  int reports)
{
    // Small steps, so that kills meet many places; one commit is merged of several segments.
    TilePackWriter::Options options;
    options.maxPending = 11;
    const TileStoreSettings settings = sampleSettings(300);
    for (;;)
    {
        if (write(reports, &version, sizeof(version)) != sizeof(version))
        {
            _exit(1);
        }
        if (work == Work::Compact)
        {
            compactTilePack(path, options);
            continue;
        }
        ++version;
        if (work == Work::Build)
        {
            buildSample(path, version, settings, options);
            continue;
        }
        TilePackWriter writer(path, options);
        putAll(writer, settings.grid, version);
        writer.commit();
    }
}

/// The last version that a child says to have committed before it was killed.
unsigned int killAfter(int microseconds, const std::string& path, Work work, unsigned int version)
{
    int ends[2];
    if (pipe(ends) != 0)
    {
        std::abort();
    }
    const pid_t child = fork();
    if (child == 0)
    {
        close(ends[0]);
        workUntilKilled(path, work, version, ends[1]);
    }
    close(ends[1]);
    unsigned int reported = version;
    EXPECT_EQ(read(ends[0], &reported, sizeof(reported)), ssize_t(sizeof(reported)));
    usleep(static_cast<useconds_t>(microseconds));
    kill(child, SIGKILL);
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status)) << "the child ended by itself";
    while (read(ends[0], &reported, sizeof(reported)) == ssize_t(sizeof(reported)))
    {
    }
    close(ends[0]);
    return reported;
}

bool holds(const TileReader& reader, unsigned int version)
{
    for (const TileKey& key : tilesOf(reader.getSettings().grid))
    {
        if (!(reader.read(key) == sampleTile(key, version)))
        {
            return false;
        }
    }
    return true;
}

} // namespace

TEST(TilePackKillTest, storeIsTheOldOrTheNewOneWheneverItsWriterIsKilled)
{
    const int kills = std::getenv("OSGKITS_LONG") ? 500 : 50;
    const support::TemporaryFolder folder;
    const std::string path = folder.file("store.tiles");
    unsigned int version = 1;
    buildSample(path, version, sampleSettings(300));
    double commitMicroseconds = 1000.0;
    std::mt19937 random(20);
    int commits = 0;
    for (int i = 0; i < kills && !testing::Test::HasFailure(); ++i)
    {
        const Work work = Work(i % 3);
        // Disks differ, also from one moment to the next: from at once to after some commits.
        std::uniform_int_distribution<int> moment(0, 1000 + int(3 * commitMicroseconds));
        const unsigned int reported = killAfter(moment(random), path, work, version);
        const TilePackReader reader(path);
        const std::vector<std::string> problems = reader.verify();
        EXPECT_TRUE(problems.empty()) << "kill " << i << ": " << problems.front();
        const bool next = work != Work::Compact && holds(reader, reported + 1);
        EXPECT_TRUE(next || holds(reader, reported)) << "kill " << i;
        commits += reported + next > version;
        version = reported + next;

        // What follows completes.
        const auto start = std::chrono::steady_clock::now();
        TilePackWriter writer(path, {});
        putAll(writer, reader.getSettings().grid, ++version);
        writer.commit();
        commitMicroseconds =
            std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start)
                .count();
        EXPECT_TRUE(holds(TilePackReader(path), version));
    }
    compactTilePack(path);
    buildSample(folder.file("fresh.tiles"), version, sampleSettings(300));
    EXPECT_EQ(bytesOfFile(path), bytesOfFile(folder.file("fresh.tiles")));
    std::printf("%d kills, after %d of them there was a new commit\n", kills, commits);
}
