// SPDX-License-Identifier: MIT
// osgViewer binds the thread that draws to one core, and threads begin on the cores of the one that
// starts them; helpers have all.
#include <osgMultiRender/AllCores.h>
#include <osgPagedTexture/CoreTeam.h>
#include <osgPagedTexture/WorkerPool.h>

#include <gtest/gtest.h>

#include <future>
#include <mutex>
#include <thread>

#include <sched.h>

using namespace osgPagedTexture;

namespace
{

cpu_set_t coresOfThread()
{
    cpu_set_t cores;
    CPU_ZERO(&cores);
    EXPECT_EQ(sched_getaffinity(0, sizeof(cores), &cores), 0);
    return cores;
}

/// Binds the thread to the first of its cores, as osgViewer does.
struct AllCoresTest : testing::Test
{
    void SetUp() override
    {
        if (CPU_COUNT(&all) < 2)
            GTEST_SKIP() << "one core";
        int first = 0;
        while (!CPU_ISSET(first, &all))
            ++first;
        CPU_ZERO(&one);
        CPU_SET(first, &one);
        ASSERT_EQ(sched_setaffinity(0, sizeof(one), &one), 0);
    }
    void TearDown() override { sched_setaffinity(0, sizeof(all), &all); }

    const cpu_set_t all = coresOfThread();
    cpu_set_t one;
};

TEST_F(AllCoresTest, threadsBeginOnTheirStartersCores)
{
    std::async(std::launch::async,
               [&]
               {
                   const cpu_set_t before = coresOfThread();
                   EXPECT_TRUE(CPU_EQUAL(&before, &one));
                   osgMultiRender::useAllCores();
                   const cpu_set_t after = coresOfThread();
                   EXPECT_TRUE(CPU_EQUAL(&after, &all));
               })
        .get();
    const cpu_set_t own = coresOfThread();
    EXPECT_TRUE(CPU_EQUAL(&own, &one)) << "of other threads nothing changes";
}

TEST_F(AllCoresTest, workersHaveAll)
{
    WorkerPool pool(1);
    std::promise<cpu_set_t> promise;
    pool.submit({}, [&](const std::atomic<bool>&) { promise.set_value(coresOfThread()); });
    const cpu_set_t cores = promise.get_future().get();
    EXPECT_TRUE(CPU_EQUAL(&cores, &all));
}

TEST_F(AllCoresTest, membersOfATeamHaveAllButTheCaller)
{
    CoreTeam team(2);
    std::once_flag once;
    std::promise<void> otherIsThere;
    const std::shared_future<void> other = otherIsThere.get_future().share();
    team.run(2,
             [&](std::size_t, unsigned int member)
             {
                 if (member == 0)
                     return other.wait(); // else it might do both parts
                 const cpu_set_t cores = coresOfThread();
                 EXPECT_TRUE(CPU_EQUAL(&cores, &all));
                 std::call_once(once, [&] { otherIsThere.set_value(); });
             });
    const cpu_set_t own = coresOfThread();
    EXPECT_TRUE(CPU_EQUAL(&own, &one));
}

} // namespace
