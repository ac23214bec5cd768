// SPDX-License-Identifier: MIT
// What a cache survives: folders that cannot be written, full and slow disks, processes that die.
#include "ChainSamples.h"

#include <osgPagedTexture/ChainCache.h>

#include <support/TemporaryFolder.h>

#include <gtest/gtest.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <random>
#include <thread>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

using namespace osgPagedTexture;
namespace fs = std::filesystem;

namespace
{

/// A disk on which removing a file takes until somebody has looked at the cache, or ten seconds.
std::atomic<bool> slowDisk{false}, removing{false}, looked{false}, lookedInTime{false};

} // namespace

// It takes the place of the C library's for the kit, too.
extern "C" __attribute__((visibility("default"))) int remove(const char* path) noexcept
{
    if (slowDisk)
    {
        removing = true;
        for (int wait = 0; wait < 1000 && !looked; ++wait)
        {
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
        lookedInTime = looked.load();
    }
    const int done = static_cast<int>(syscall(SYS_unlinkat, AT_FDCWD, path, 0));
    return done == 0 || errno != EISDIR ? done : static_cast<int>(syscall(SYS_rmdir, path));
}

namespace
{

constexpr std::uint64_t Plenty = 1 << 30;

MipChain chainNumber(unsigned int number)
{
    return sampleChain(BlockFormat::BC1, 256, 256 + int(number % 5) * 40, 0, number);
}

ContentHash keyNumber(unsigned int number)
{
    return chainKey(hashText(std::to_string(number)), "");
}

/// Runs it in a child and returns its exit code.
int inChild(const std::function<int()>& body)
{
    const pid_t child = fork();
    if (child == 0)
    {
        _exit(body());
    }
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

std::size_t filesIn(const std::string& folder)
{
    std::size_t files = 0;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
    {
        files += entry.is_regular_file();
    }
    return files;
}

/// 0 where writing fails, says so once in a line with this cause, and reading what was there goes
/// on.
int checkReadsOnly(const std::string& path, const std::string& cause)
{
    ChainCache cache(path, Plenty);
    if (cache.write(keyNumber(2), chainNumber(2)) || cache.write(keyNumber(3), chainNumber(3)))
    {
        return 1;
    }
    const std::vector<std::string> messages = cache.takeMessages();
    if (messages.size() != 1 || messages[0].find(cause) == std::string::npos ||
        messages[0].find("osgPagedTexture::ChainCache: folder '" + path + "': cannot ") != 0)
    {
        std::fprintf(stderr, "%zu messages: %s\n", messages.size(),
                     messages.empty() ? "" : messages[0].c_str());
        return 2;
    }
    const auto found = cache.read(keyNumber(1), 0);
    return found && *found == chainNumber(1) ? 0 : 3;
}

} // namespace

class ChainCacheFaultTest : public testing::Test
{
protected:
    void SetUp() override
    {
        ASSERT_TRUE(ChainCache(path, Plenty).write(keyNumber(1), chainNumber(1)));
    }

    support::TemporaryFolder folder;
    const std::string path = folder.file("cache");
};

TEST_F(ChainCacheFaultTest, AFolderThatCannotBeWrittenIsReadFromAndNamedOnce)
{
    for (const auto& entry : fs::recursive_directory_iterator(path))
    {
        fs::permissions(entry.path(), fs::perms(entry.is_directory() ? 0555 : 0444));
    }
    fs::permissions(path, fs::perms(0555));
    fs::permissions(folder.getPath(), fs::perms(0755));
    EXPECT_EQ(inChild(
                  [&]
                  {
                      // Root may write anywhere.
                      return getuid() == 0 && setuid(65534) != 0
                                 ? 9
                                 : checkReadsOnly(path, "Permission denied");
                  }),
              0);
    fs::permissions(path, fs::perms(0755));
}

TEST_F(ChainCacheFaultTest, AFullDiskIsNamedOnceAndLeavesNoHalfFile)
{
    EXPECT_EQ(inChild(
                  [&]
                  {
                      std::signal(SIGXFSZ, SIG_IGN);
                      const rlimit limit{20000, 20000}; // a chain has 43 KB
                      setrlimit(RLIMIT_FSIZE, &limit);
                      return checkReadsOnly(path, "File too large");
                  }),
              0);
    EXPECT_EQ(filesIn(path), 1u);
}

TEST_F(ChainCacheFaultTest, NobodyWaitsForADiskThatRemovesButWhoWrites)
{
    ChainCache cache(path, 100000);
    ASSERT_TRUE(cache.write(keyNumber(2), chainNumber(2)));
    slowDisk = true;
    std::thread writer([&] { cache.write(keyNumber(3), chainNumber(3)); });
    while (!removing)
    {
        std::this_thread::yield();
    }
    // What frames ask for.
    EXPECT_EQ(cache.getStatistics().written, 1u);
    EXPECT_TRUE(cache.takeMessages().empty());
    looked = true;
    writer.join();
    slowDisk = false;
    EXPECT_TRUE(lookedInTime);
    EXPECT_GT(cache.getStatistics().evicted, 0u);
    EXPECT_EQ(cache.getStatistics().written, 2u);
}

TEST_F(ChainCacheFaultTest, AFileInThePlaceOfTheFolderIsNamed)
{
    const std::string file = folder.write("file", "");
    ChainCache cache(file, Plenty);
    EXPECT_FALSE(cache.write(keyNumber(1), chainNumber(1)));
    EXPECT_EQ(cache.takeMessages().size(), 1u);
    EXPECT_FALSE(cache.read(keyNumber(1), 0));
}

TEST_F(ChainCacheFaultTest, ProcessesThatAreKilledAtAnyMomentLeaveOnlyWholeEntries)
{
    std::mt19937 random(7);
    std::size_t hits = 0;
    for (int kill = 0; kill < 200; ++kill)
    {
        const unsigned int first = random() % 20;
        const pid_t child = fork();
        if (child == 0)
        {
            ChainCache cache(path, 2000000); // it also removes entries
            for (unsigned int i = first;; ++i)
            {
                cache.write(keyNumber(i % 40), chainNumber(i % 40));
                cache.read(keyNumber(i * 7 % 40), 0);
            }
        }
        std::this_thread::sleep_for(std::chrono::microseconds(random() % 20000));
        ::kill(child, SIGKILL);
        waitpid(child, nullptr, 0);
        ChainCache cache(path, Plenty);
        for (unsigned int i = kill % 4; i < 40; i += 4)
        {
            const auto found = cache.read(keyNumber(i), 0);
            hits += found.has_value();
            ASSERT_TRUE(!found || *found == chainNumber(i)) << kill;
        }
        ASSERT_EQ(cache.getStatistics().damaged, 0u) << "an entry had its name before it was whole";
    }
    EXPECT_GT(hits, 200u) << "the children wrote too little to tell anything";
}

TEST_F(ChainCacheFaultTest, ProcessesThatWriteTheSameEntriesAtOnceDoNotDisturbEachOther)
{
    std::vector<pid_t> children;
    for (int process = 0; process < 3; ++process)
    {
        children.push_back(fork());
        if (children.back() == 0)
        {
            ChainCache cache(path, 1000000);
            int wrong = 0;
            for (unsigned int i = 0; i < 150; ++i)
            {
                const unsigned int number = (i * (process + 3)) % 30;
                cache.write(keyNumber(number), chainNumber(number));
                const auto found = cache.read(keyNumber(number), 0);
                wrong += found && !(*found == chainNumber(number));
            }
            _exit(wrong || cache.getStatistics().damaged || !cache.takeMessages().empty());
        }
    }
    for (pid_t child : children)
    {
        int status = 0;
        waitpid(child, &status, 0);
        EXPECT_EQ(status, 0);
    }
}
