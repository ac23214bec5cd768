// SPDX-License-Identifier: MIT
// The n-th allocation finds no memory, for n = 1, 2, ...: of builds, updates and loads, each in a
// process of its own. Each ends with an error or with all that was asked for, none with a crash or
// a wait for ever. By default some hundred of all n, with OSGKITS_LONG all.
//
// Of builds and updates only allocations of JsonBytes and more fail: nlohmann-json's constructors
// and destructors, which are noexcept, ask for less.
#include "ChainSamples.h"
#include "UpdateSamples.h"

#include <osgPagedTexture/ChainLoader.h>
#include <osgPagedTexture/PageLoader.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <new>

#include <sys/wait.h>
#include <unistd.h>

using namespace osgPagedTexture;
namespace fs = std::filesystem;

// Sanitizers have an allocator of their own.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool CanFail = false;
namespace
{
std::atomic<long> allocationsLeft{-1};
std::atomic<std::size_t> leastBytes{0};
} // namespace
#else
constexpr bool CanFail = true;

namespace
{

/// Until the one that fails; none does below 0.
std::atomic<long> allocationsLeft{-1};
std::atomic<size_t> leastBytes{0};

bool isOut(size_t bytes)
{
    return bytes >= leastBytes && allocationsLeft.load(std::memory_order_relaxed) >= 0 &&
           allocationsLeft-- == 0;
}

} // namespace

// They take the place of the C library's, for all libraries.
extern "C"
{
    void* __libc_malloc(size_t bytes);
    void* __libc_calloc(size_t count, size_t bytes);
    void* __libc_realloc(void* old, size_t bytes);

    __attribute__((visibility("default"))) void* malloc(size_t bytes)
    {
        return isOut(bytes) ? nullptr : __libc_malloc(bytes);
    }
    __attribute__((visibility("default"))) void* calloc(size_t count, size_t bytes)
    {
        return isOut(count * bytes) ? nullptr : __libc_calloc(count, bytes);
    }
    __attribute__((visibility("default"))) void* realloc(void* old, size_t bytes)
    {
        return isOut(bytes) ? nullptr : __libc_realloc(old, bytes);
    }
}
#endif

namespace
{

constexpr long Never = 1000000000;
constexpr size_t JsonBytes = 2048;

/// How a process has ended.
enum Outcome
{
    Done,
    Refused, ///< By an error that says so.
    Wrong
};

/// Runs the work where the n-th allocation fails. The number of a signal is added to 128.
int outcomeOf(const std::function<Outcome()>& work, long n)
{
    const pid_t child = fork();
    if (child == 0)
    {
        alarm(60); // a wait for ever
        Outcome outcome = Wrong;
        allocationsLeft = n;
        try
        {
            outcome = work();
        }
        catch (const std::bad_alloc&)
        {
            outcome = Refused;
        }
        catch (const std::exception& error)
        {
            outcome = *error.what() ? Refused : Wrong;
        }
        allocationsLeft = -1;
        _exit(outcome);
    }
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

/// How many allocations the work takes; -1 where it does not get done.
long countAllocations(const std::function<Outcome()>& work)
{
    int ends[2];
    if (pipe(ends) != 0)
        return -1;
    const pid_t child = fork();
    if (child == 0)
    {
        allocationsLeft = Never;
        const bool isDone = work() == Done;
        const long used = isDone ? Never - allocationsLeft : -1;
        _exit(write(ends[1], &used, sizeof(used)) == sizeof(used) ? 0 : 1);
    }
    long used = -1;
    const bool isRead = read(ends[0], &used, sizeof(used)) == sizeof(used);
    waitpid(child, nullptr, 0);
    close(ends[0]);
    close(ends[1]);
    return isRead ? used : -1;
}

/// `before` makes things ready for each, `after` looks at what is there then.
void failEach(const std::function<Outcome()>& work, const std::function<void()>& before,
              const std::function<void(int outcome)>& after)
{
    if (!CanFail)
        GTEST_SKIP() << "sanitizers have their own allocator";
    before();
    const long count = countAllocations(work);
    ASSERT_GT(count, 20);
    const long step = std::getenv("OSGKITS_LONG") ? 1 : std::max(1l, count / 300);
    int refused = 0;
    for (long n = 0; n < count && !testing::Test::HasFailure(); n += step)
    {
        before();
        const int outcome = outcomeOf(work, n);
        ASSERT_TRUE(outcome == Done || outcome == Refused)
            << "allocation " << n << " of " << count << ": " << outcome;
        refused += outcome == Refused;
        after(outcome);
    }
    EXPECT_GT(refused, 5) << "no proof";
    std::printf("%ld allocations, %ld tried, %d ended with an error\n", count,
                (count + step - 1) / step, refused);
}

struct NoMemoryTest : testing::Test
{
    NoMemoryTest() { sample.build(); }

    void keep() const { fs::copy(folder(), kept(), fs::copy_options::recursive); }
    void restore() const
    {
        fs::remove_all(folder());
        fs::copy(kept(), folder(), fs::copy_options::recursive);
    }
    std::string folder() const { return fs::path(sample.store()).parent_path().string(); }
    std::string kept() const { return _place.file("kept"); }

    const UpdateSample sample{3};

private:
    const support::TemporaryFolder _place;
};

TEST_F(NoMemoryTest, builds)
{
    leastBytes = JsonBytes;
    sample.build();
    const std::string other = sample.store() + ".other";
    sample.buildAt(other);
    const std::string whole = UpdateSample::bytesOf(other);
    failEach([&] { return sample.buildAt(other).failures.empty() ? Done : Refused; },
             [&] { fs::remove(other); },
             [&](int outcome)
             {
                 if (outcome == Done)
                 {
                     EXPECT_TRUE(UpdateSample::bytesOf(other) == whole);
                 }
                 else if (fs::exists(other)) // without what could not be read
                 {
                     EXPECT_NO_THROW(TilePackReader reader(other));
                 }
             });
}

TEST_F(NoMemoryTest, updates)
{
    leastBytes = JsonBytes;
    sample.writePhoto(UpdateSample::nameOf(1), 200, 100, 99);
    keep();
    TileUpdateSettings settings;
    settings.threads = 2;
    settings.lookInside = true;
    settings.pack.durable = false;
    failEach(
        [&] { return updateTileStore(sample.store(), settings).failures.empty() ? Done : Refused; },
        [&] { restore(); },
        [&](int)
        {
            updateTileStore(sample.store(), settings);
            EXPECT_TRUE(sample.equalsFullBuild());
        });
}

TEST_F(NoMemoryTest, pagesOfVirtualTextures)
{
    leastBytes = 0;
    failEach(
        [&]
        {
            const auto store = std::make_shared<TilePackReader>(sample.store());
            PageLoader loader(2);
            const TileGrid& grid = store->getSettings().grid;
            std::size_t wanted = 0;
            for (int level = 0; level < grid.getLevels(); ++level)
                for (int x = 0; x < grid.getColumns(level); ++x, ++wanted)
                {
                    PageRequest request;
                    request.page = {{0, level, x, 0}, 1};
                    request.store = store;
                    request.name = "store";
                    request.format = {BlockFormat::BC1, 40, EncodeQuality::Normal, {}};
                    loader.request(request);
                }
            std::size_t loaded = 0, failed = 0;
            while (loader.getStatistics().waiting > 0)
            {
                loader.wait(5.0);
                for (const PageResult& result : loader.poll())
                    ++(result.state == PageResult::State::Loaded ? loaded : failed);
            }
            return loaded == wanted ? Done : loaded + failed == wanted ? Refused : Wrong;
        },
        [] {}, [](int) {});
}

TEST_F(NoMemoryTest, texturesFromFilesAndTheCache)
{
    leastBytes = 0;
    const support::TemporaryFolder cache;
    for (const bool cached : {false, true})
    {
        const std::string entries = cache.file("entries");
        ChainLoaderSettings settings;
        settings.threads = 2;
        settings.cacheFolder = entries;
        settings.retrySeconds = {0.001};
        const auto load = [&]
        {
            ChainLoader loader(settings);
            for (int i = 0; i < 3; ++i)
                loader.request({sample.photo(UpdateSample::nameOf(i)), plainRecipe(), 0, 0.0, 16});
            std::size_t complete = 0, failed = 0;
            for (bool isWaiting = true; isWaiting;)
            {
                isWaiting = loader.getStatistics().waiting > 0;
                for (const ChainResult& result : loader.poll())
                {
                    complete += result.state == ChainResult::State::Complete;
                    failed += result.state == ChainResult::State::Failed;
                }
            }
            loader.takeMessages();
            return complete == 3 ? Done : complete + failed == 3 ? Refused : Wrong;
        };
        ASSERT_EQ(load(), Done);
        failEach(
            load,
            [&]
            {
                if (!cached)
                    fs::remove_all(entries);
            },
            [](int) {});
    }
}

} // namespace
