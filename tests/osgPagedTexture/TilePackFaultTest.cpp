// SPDX-License-Identifier: MIT
// Full disks at every write, folders that cannot be written, two writers, readers meanwhile.
#include "TilePackSamples.h"

#include <support/TemporaryFolder.h>

#include <gtest/gtest.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <filesystem>
#include <functional>
#include <thread>

#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

using namespace osgPagedTexture;
namespace fs = std::filesystem;

namespace
{

/// Calls that change a file until the one that fails; none does below 0.
std::atomic<int> callsLeft{-1};
std::atomic<bool> failsOnce{false};
std::atomic<bool> failed{false};

/// Whether this call is one that finds the disk full.
bool isFull()
{
    if (callsLeft < 0 || (failed && failsOnce))
    {
        return false;
    }
    failed = failed || callsLeft-- == 0;
    callsLeft = std::max(callsLeft.load(), 0);
    if (failed)
    {
        errno = ENOSPC;
    }
    return failed;
}

} // namespace

// They take the place of the C library's for the kit too.
extern "C" __attribute__((visibility("default"))) ssize_t pwrite(int file, const void* bytes,
                                                                 size_t count, off_t place)
{
    if (!isFull())
    {
        return syscall(SYS_pwrite64, file, bytes, count, place);
    }
    // A full disk takes a part first.
    return count > 1 && failsOnce ? syscall(SYS_pwrite64, file, bytes, count / 2, place) : -1;
}

extern "C" __attribute__((visibility("default"))) int fdatasync(int file)
{
    return isFull() ? -1 : static_cast<int>(syscall(SYS_fdatasync, file));
}

extern "C" __attribute__((visibility("default"))) int rename(const char* from,
                                                             const char* to) noexcept
{
    return isFull() ? -1 : static_cast<int>(syscall(SYS_rename, from, to));
}

namespace
{

TilePackWriter::Options smallSteps()
{
    TilePackWriter::Options options;
    options.maxPending = 20;
    return options;
}

void update(const std::string& path)
{
    TilePackWriter writer(path, smallSteps());
    putAll(writer, sampleSettings().grid, 1);
    writer.put({0, 0, 0}, TileData::encoded(std::string(5 << 20, 'x'))); // more than is gathered
    writer.put({0, 0, 0}, sampleTile({0, 0, 0}, 1));
    writer.commit();
}

void build(const std::string& path)
{
    buildSample(path, 1, sampleSettings(), smallSteps());
}

/// Lets the n-th call fail for all n until the work gets through, and looks at the store each time.
void failAtEachCall(const std::function<void(const std::string& path)>& work, int versionAfter)
{
    const support::TemporaryFolder folder;
    const std::string path = folder.file("store.tiles");
    int calls = 0;
    for (bool full = true; full; ++calls)
    {
        ASSERT_LT(calls, 1000);
        fs::remove(path);
        buildSample(path, 0);
        failed = false;
        callsLeft = calls;
        try
        {
            work(path);
        }
        catch (const TileStoreError& error)
        {
            const std::string line = error.what();
            EXPECT_EQ(error.getKind(), TileStoreError::Kind::Unwritable);
            EXPECT_NE(line.find("No space left on device; make room on the disk"),
                      std::string::npos)
                << line;
            EXPECT_NE(line.find(path), std::string::npos) << line;
        }
        callsLeft = -1;
        full = failed;
        const TilePackReader reader(path);
        const int version = versionOf(reader, 2);
        EXPECT_TRUE(version == versionAfter || (full && version == 0)) << calls;
        EXPECT_TRUE(reader.verify().empty()) << calls;
        EXPECT_FALSE(fs::exists(path + ".part")) << calls;
        work(path); // once there is room it gets through
        EXPECT_EQ(versionOf(TilePackReader(path), 2), versionAfter) << calls;
    }
    EXPECT_GT(calls, 4);
}

class TilePackFullDiskTest : public testing::TestWithParam<bool>
{
protected:
    void SetUp() override { failsOnce = GetParam(); }
    void TearDown() override { callsLeft = -1; }
};

} // namespace

TEST_P(TilePackFullDiskTest, updateLeavesTheOldStoreAtEveryFailingWrite)
{
    failAtEachCall(update, 1);
}

TEST_P(TilePackFullDiskTest, buildLeavesTheOldStoreAtEveryFailingWrite)
{
    failAtEachCall(build, 1);
}

TEST_P(TilePackFullDiskTest, compactLeavesTheOldStoreAtEveryFailingWrite)
{
    failAtEachCall([](const std::string& path) { compactTilePack(path, smallSteps()); }, 0);
}

INSTANTIATE_TEST_SUITE_P(Disk, TilePackFullDiskTest, testing::Values(false, true),
                         [](const auto& once)
                         { return once.param ? "shortWriteOnce" : "fullFromThenOn"; });

TEST(TilePackFaultTest, failedWriterRefusesToGoOn)
{
    const support::TemporaryFolder folder;
    const std::string path = folder.file("store.tiles");
    buildSample(path, 0);
    TilePackWriter writer(path, {});
    writer.put({0, 0, 0}, TileData::uniform({}));
    failsOnce = false;
    failed = false;
    callsLeft = 0;
    EXPECT_THROW(writer.commit(), TileStoreError);
    callsLeft = -1;
    EXPECT_THROW(writer.commit(), TileStoreError);
    EXPECT_EQ(versionOf(TilePackReader(path), 1), 0);
}

TEST(TilePackFaultTest, secondWriterSaysSoOrWaits)
{
    const support::TemporaryFolder folder;
    const std::string path = folder.file("store.tiles");
    buildSample(path, 0);
    auto first = std::make_unique<TilePackWriter>(path, TilePackWriter::Options());
    try
    {
        compactTilePack(path);
        ADD_FAILURE();
    }
    catch (const TileStoreError& error)
    {
        EXPECT_EQ(error.getKind(), TileStoreError::Kind::Busy);
        EXPECT_NE(std::string(error.what())
                      .find("is being written by another process (process " +
                            std::to_string(getpid()) + ")"),
                  std::string::npos)
            << error.what();
    }
    std::atomic<bool> opened{false};
    std::thread waiting(
        [&]()
        {
            TilePackWriter::Options patient;
            patient.waitSeconds = 60.0;
            TilePackWriter second(path, patient);
            opened = true;
            putAll(second, sampleSettings().grid, 2);
            second.commit();
        });
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    EXPECT_FALSE(opened) << "it did not wait";
    putAll(*first, sampleSettings().grid, 1);
    first->commit();
    EXPECT_EQ(versionOf(TilePackReader(path), 3), 1);
    first.reset();
    waiting.join();
    EXPECT_EQ(versionOf(TilePackReader(path), 3), 2);
}

TEST(TilePackFaultTest, readersSeeWholeVersionsWhileItIsWrittenAndCompacted)
{
    const support::TemporaryFolder folder;
    const std::string path = folder.file("store.tiles");
    const TileStoreSettings settings = sampleSettings(300);
    buildSample(path, 0, settings);
    std::atomic<bool> stop{false};
    std::atomic<int> mixed{0}, seen{0}, changes{0};
    const auto read = [&]()
    {
        TilePackReader reader(path);
        while (!stop)
        {
            mixed += versionOf(reader, 26) < 0;
            mixed += !reader.verify().empty();
            ++seen;
            changes += reader.refresh();
        }
    };
    std::thread first(read), second(read);
    for (unsigned int version = 1; version < 26; ++version)
    {
        TilePackWriter::Options options;
        options.waitSeconds = 10.0;
        options.maxPending = 10;
        {
            TilePackWriter writer(path, options);
            putAll(writer, settings.grid, version);
            writer.commit();
        }
        if (version % 3 == 0)
        {
            compactTilePack(path, options);
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    stop = true;
    first.join();
    second.join();
    EXPECT_EQ(mixed, 0);
    EXPECT_GT(seen, 10);
    EXPECT_GT(changes, 5);
}

TEST(TilePackFaultTest, folderThatCannotBeWrittenIsNamedAndStillRead)
{
    const support::TemporaryFolder folder;
    const std::string path = folder.file("store.tiles");
    buildSample(path, 0);
    fs::remove(path + ".lock");
    fs::permissions(folder.getPath(), fs::perms(0555));
    fs::permissions(path, fs::perms(0444));
    const pid_t child = fork();
    if (child == 0)
    {
        const bool nobody = getuid() != 0 || setuid(65534) == 0; // root may write everywhere
        std::string line;
        try
        {
            compactTilePack(path);
        }
        catch (const TileStoreError& error)
        {
            line = error.what();
        }
        const bool named =
            line.find(path + ".lock' cannot be opened: Permission denied") != std::string::npos;
        _exit(nobody && named && versionOf(TilePackReader(path), 1) == 0 ? 0 : 1);
    }
    int status = -1;
    waitpid(child, &status, 0);
    fs::permissions(folder.getPath(), fs::perms::owner_all);
    EXPECT_EQ(status, 0);
}
