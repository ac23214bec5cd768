// SPDX-License-Identifier: MIT
// Long random runs: after each frame the page tables name only what is there.
#include "VirtualStores.h"

#include <support/ResidentMemory.h>

#include <gtest/gtest.h>

#include <atomic>
#include <random>
#include <thread>

namespace osgPagedTexture
{

struct VirtualPagerRandomTest : StoreTest
{
};

TEST_F(VirtualPagerRandomTest, tablesNameOnlyWhatIsThereWhateverHappens)
{
    for (unsigned int seed = 1; seed <= 6; ++seed)
    {
        std::mt19937 random(seed);
        VirtualPagerSettings settings = smallPager(seed == 1 ? 4 : int(20 + random() % 100));
        settings.cacheBytes = (seed % 2) * 30000;
        settings.queueBytes = pageBytes * (1 + random() % 30);
        settings.switchBytes = pageBytes * (1 + random() % 30);
        source.build(store, 1);
        VirtualPager pager(settings);
        pager.addTexture(store);
        ContextModel model, other;
        unsigned int frame = 0;
        int version = 1;
        for (int step = 0; step < 600; ++step)
        {
            const unsigned int dice = random() % 100;
            if (dice < 50)
            {
                pager.report(random() % 2, needsOf(grid, 0, int(random() % 4), int(random() % 38),
                                                   int(random() % 25), 1 + int(random() % 9),
                                                   1 + int(random() % 9)));
            }
            else if (dice < 53)
            {
                version = version % 15 + 1;
                source.update(store, version);
                pager.invalidate(0);
            }
            else if (dice < 55)
            {
                pager.removeContext(1);
                other = {};
            }
            else if (dice < 57)
            {
                pager.removeView(random() % 2);
            }
            pager.advance(++frame);
            model.apply(pager.takeUploads(0, pageBytes * (random() % 12)));
            if (random() % 3 != 0)
            {
                other.apply(pager.takeUploads(1, pageBytes * (random() % 30)));
                ASSERT_LE(other.versions(0, grid).size(), 1u) << "seed " << seed;
            }
            ASSERT_LE(model.versions(0, grid).size(), 1u) << "seed " << seed << " step " << step;
            ASSERT_LE(pager.getStatistics().usedSlots, settings.slots);
            if (random() % 4 == 0)
            {
                pager.waitForLoads(0.001);
            }
        }
        for (int i = 0; i < 20000 && !pager.isAtRest(); ++i)
        {
            pager.advance(++frame);
            model.apply(pager.takeUploads(0, 5000));
            other.apply(pager.takeUploads(1, 5000));
            pager.waitForLoads(0.001);
        }
        EXPECT_TRUE(pager.isAtRest());
        EXPECT_EQ(model.versions(0, grid), std::set<int>{version}) << "seed " << seed;
        EXPECT_EQ(other.versions(0, grid), std::set<int>{version}) << "seed " << seed;
        EXPECT_TRUE(pager.takeMessages().empty());
    }
}

TEST_F(VirtualPagerRandomTest, tenThousandJumpsLeaveNothingBehind)
{
    std::mt19937 random(9);
    VirtualPagerSettings settings = smallPager(120);
    settings.cacheBytes = 100000;
    VirtualPager pager(settings);
    pager.addTexture(store);
    ContextModel model;
    unsigned int frame = 0;
    double before = 0.0;
    for (int jump = 0; jump < 10000; ++jump)
    {
        pager.report(
            0, needsOf(grid, 0, int(random() % 4), int(random() % 30), int(random() % 20), 6, 6));
        for (int i = 0; i < 3; ++i)
        {
            pager.advance(++frame);
            model.apply(pager.takeUploads(0, 20 * pageBytes));
        }
        if (jump == 1000)
        {
            before = support::residentMiB();
        }
    }
    settle(pager, model, frame);
    EXPECT_EQ(model.versions(0, grid), std::set<int>{1});
    EXPECT_LE(pager.getStatistics().cacheBytes, settings.cacheBytes);
    // What the allocator keeps varies by some hundred kilobytes.
    EXPECT_LT(support::residentMiB(), before + 4.0);
}

TEST_F(VirtualPagerRandomTest, contextsViewsAndUpdatesMayComeFromThreadsOfTheirOwn)
{
    VirtualPagerSettings settings = smallPager(60);
    settings.watchSeconds = 0.001;
    VirtualPager pager(settings);
    pager.addTexture(store);
    std::atomic<bool> ends{false};
    const auto draw = [&](unsigned int context)
    {
        ContextModel model;
        while (!ends)
        {
            model.apply(pager.takeUploads(context, 10 * pageBytes));
            EXPECT_LE(model.versions(0, grid).size(), 1u);
        }
    };
    std::thread first(draw, 0), second(draw, 1);
    std::thread writer(
        [&]
        {
            for (int version = 2; version < 12; ++version)
            {
                source.update(store, version);
                pager.invalidate(0);
                std::this_thread::sleep_for(std::chrono::milliseconds(5));
            }
        });
    std::mt19937 random(4);
    for (unsigned int frame = 1; frame < 400; ++frame)
    {
        pager.report(frame % 2, needsOf(grid, 0, int(random() % 4), int(random() % 30),
                                        int(random() % 20), 4, 4));
        pager.advance(frame);
        pager.getStatistics();
        pager.isAtRest();
        pager.takeMessages();
        std::this_thread::sleep_for(std::chrono::microseconds(500));
    }
    writer.join();
    ends = true;
    first.join();
    second.join();
}

} // namespace osgPagedTexture
