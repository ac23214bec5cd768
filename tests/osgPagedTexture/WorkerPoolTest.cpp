// SPDX-License-Identifier: MIT
#include <osgPagedTexture/WorkerPool.h>

#include <gtest/gtest.h>

#include <chrono>
#include <future>
#include <mutex>
#include <random>

using namespace osgPagedTexture;
using namespace std::chrono_literals;

namespace
{

/// A pool of one thread that is kept busy until open().
struct HeldPool
{
    HeldPool()
    {
        pool.submit({100, 0.0}, [this](const std::atomic<bool>&) { gate.get_future().wait(); });
        while (pool.getWaitingCount())
        {
            std::this_thread::yield();
        }
    }
    WorkerPool::JobId add(int name, JobPriority priority)
    {
        return pool.submit(priority,
                           [this, name](const std::atomic<bool>&) { ran.push_back(name); });
    }
    void finish()
    {
        std::promise<void> last;
        pool.submit({-100, 0.0}, [&](const std::atomic<bool>&) { last.set_value(); });
        gate.set_value();
        last.get_future().wait();
    }
    std::promise<void> gate;
    std::vector<int> ran; ///< By the one thread.
    WorkerPool pool{1};
};

} // namespace

TEST(WorkerPoolTest, NoThreadExistsBeforeTheFirstJob)
{
    WorkerPool pool(3);
    EXPECT_EQ(pool.getThreadCount(), 0u);
    pool.submit({}, [](const std::atomic<bool>&) {});
    EXPECT_EQ(pool.getThreadCount(), 1u);
}

TEST(WorkerPoolTest, RankGoesFirstThenValueThenAge)
{
    HeldPool held;
    held.add(1, {0, 5.0});
    held.add(2, {0, 5.0});
    held.add(3, {0, 9.0});
    held.add(4, {1, -3.0});
    held.finish();
    EXPECT_EQ(held.ran, (std::vector<int>{4, 3, 1, 2}));
}

TEST(WorkerPoolTest, PrioritiesMayChangeWhileTheyWait)
{
    HeldPool held;
    const auto first = held.add(1, {0, 5.0});
    const auto second = held.add(2, {0, 4.0});
    held.add(3, {0, 3.0});
    held.pool.setPriority(second, {0, 6.0});
    held.pool.setPriority(first, {0, 1.0});
    held.finish();
    EXPECT_EQ(held.ran, (std::vector<int>{2, 3, 1}));
}

TEST(WorkerPoolTest, ACancelledJobThatWaitsNeverRuns)
{
    HeldPool held;
    const auto first = held.add(1, {0, 5.0});
    held.add(2, {0, 4.0});
    EXPECT_TRUE(held.pool.cancel(first));
    EXPECT_FALSE(held.pool.cancel(first));
    held.finish();
    EXPECT_EQ(held.ran, (std::vector<int>{2}));
}

TEST(WorkerPoolTest, ARunningJobIsToldThatItIsCancelled)
{
    WorkerPool pool(1);
    std::promise<void> started, ended;
    const auto id = pool.submit({},
                                [&](const std::atomic<bool>& cancelled)
                                {
                                    started.set_value();
                                    while (!cancelled)
                                    {
                                        std::this_thread::yield();
                                    }
                                    ended.set_value();
                                });
    started.get_future().wait();
    EXPECT_FALSE(pool.cancel(id));
    EXPECT_EQ(ended.get_future().wait_for(10s), std::future_status::ready);
}

TEST(WorkerPoolTest, ADelayedJobWaitsWhileOthersRun)
{
    WorkerPool pool(2);
    const auto start = std::chrono::steady_clock::now();
    std::promise<void> delayed;
    std::atomic<bool> promptRan{false}, promptWasFirst{false};
    pool.submit(
        {9, 0.0},
        [&](const std::atomic<bool>&)
        {
            promptWasFirst = bool(promptRan);
            delayed.set_value();
        },
        1.0);
    pool.submit({0, 0.0}, [&](const std::atomic<bool>&) { promptRan = true; });
    delayed.get_future().wait();
    EXPECT_TRUE(promptWasFirst);
    EXPECT_GE(std::chrono::steady_clock::now() - start, 999ms);
}

TEST(WorkerPoolTest, ItsEndDropsWhatWaitsAndCancelsWhatRuns)
{
    std::atomic<int> ran{0};
    {
        WorkerPool pool(2);
        for (int i = 0; i < 100; ++i)
        {
            pool.submit({},
                        [&](const std::atomic<bool>& cancelled)
                        {
                            ++ran;
                            while (!cancelled)
                            {
                                std::this_thread::yield();
                            }
                        });
        }
        pool.submit(
            {}, [&](const std::atomic<bool>&) { ran += 1000; }, 0.01);
        while (ran < 2)
        {
            std::this_thread::sleep_for(1ms);
        }
        std::this_thread::sleep_for(50ms); // in which a third could begin
    }
    EXPECT_EQ(ran, 2);
}

TEST(WorkerPoolTest, ManyThreadsMayCallItAtOnce)
{
    std::atomic<int> ran{0}, dropped{0};
    {
        WorkerPool pool(3);
        std::vector<std::thread> threads;
        for (unsigned int seed = 0; seed < 4; ++seed)
        {
            threads.emplace_back(
                [&, seed]
                {
                    std::mt19937 random(seed);
                    for (int i = 0; i < 500; ++i)
                    {
                        const auto id = pool.submit(
                            {int(random() % 3), double(random() % 10)},
                            [&](const std::atomic<bool>&) { ++ran; },
                            random() % 4 ? 0.0 : 0.001 * (random() % 3));
                        pool.setPriority(id - random() % 5, {int(random() % 3), 1.0});
                        dropped += random() % 5 == 0 && pool.cancel(id);
                    }
                });
        }
        for (std::thread& thread : threads)
        {
            thread.join();
        }
        while (ran + dropped < 2000)
        {
            std::this_thread::sleep_for(1ms);
        }
    }
    EXPECT_EQ(ran + dropped, 2000);
}
