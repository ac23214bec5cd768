// SPDX-License-Identifier: MIT
// A store that changes while it is shown: each frame is looked at for a mix of old and new pages.
#include "VirtualStores.h"

#include <osgPagedTexture/TileFolders.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <thread>

namespace osgPagedTexture
{

namespace fs = std::filesystem;

struct VirtualPagerSwitchTest : PagerTest
{
    /// Frames until the pager is at rest; each must show one version of what has changed.
    int lookAtFrames(VirtualPager& pager, std::uint64_t bytes, const PixelRect* changed = nullptr)
    {
        int frames = 0;
        for (; frames < 5000; ++frames)
        {
            pager.advance(++frame);
            model.apply(pager.takeUploads(0, bytes));
            const std::set<int> shown = model.versions(0, grid, changed);
            EXPECT_EQ(shown.size(), 1u) << "frame " << frames;
            if (pager.isAtRest())
            {
                break;
            }
            pager.waitForLoads(0.01);
        }
        EXPECT_LT(frames, 5000);
        return frames;
    }
};

TEST_F(VirtualPagerSwitchTest, noFrameMixesOldAndNewPagesWhileUploadsTrickle)
{
    VirtualPager pager(smallPager(300));
    show(pager, store, 0, 4, 4, 8, 8);
    source.update(store, 2);
    pager.invalidate(0);
    EXPECT_FALSE(pager.isAtRest());

    const int frames = lookAtFrames(pager, 2 * pageBytes);
    EXPECT_GT(frames, 30) << "two pages a frame";
    EXPECT_EQ(model.versions(0, grid), std::set<int>{2});
    EXPECT_TRUE(model.holds({0, 0, 11, 11}));
    EXPECT_EQ(pager.getStatistics().switches, 1u);
}

TEST_F(VirtualPagerSwitchTest, thePictureIsAsSharpInTheFirstFrameOfTheNewState)
{
    VirtualPager pager(smallPager(300));
    show(pager, store, 0, 4, 4, 8, 8);
    source.update(store, 2);
    pager.invalidate(0);
    while (model.versions(0, grid).count(2) == 0)
    {
        EXPECT_TRUE(model.holds({0, 0, 11, 11}));
        pager.advance(++frame);
        model.apply(pager.takeUploads(0, 3 * pageBytes));
        pager.waitForLoads(0.01);
    }
    for (const PageNeed& need : needsOf(grid, 0, 0, 4, 4, 8, 8))
    {
        EXPECT_TRUE(model.holds(need.page));
    }
}

TEST_F(VirtualPagerSwitchTest, pagesThatAreTheSameStayWhereTheyAre)
{
    VirtualPager pager(smallPager(300));
    show(pager, store, 0, 0, 0, 12, 12);
    const std::uint64_t uploaded = pager.getStatistics().uploadedPages;
    const PixelRect changed{20, 20, 8, 8};
    source.update(store, 2, &changed);
    pager.invalidate(0);
    settle(pager, model, frame);

    // The pages that show the pixels of that rectangle: 3 x 3 with the borders and their parents.
    EXPECT_LE(pager.getStatistics().uploadedPages - uploaded, 9u + 4 + 4 + 4 + 1 + 1);
    EXPECT_EQ(model.versions(0, grid, &changed), std::set<int>{2});
    EXPECT_TRUE(model.holds({0, 0, 11, 11}));
    EXPECT_EQ(model.versions(0, grid), (std::set<int>{1, 2}));
}

TEST_F(VirtualPagerSwitchTest, aRegionIsReadAgainAndNothingElse)
{
    VirtualPager pager(smallPager(300));
    show(pager, store, 0, 0, 0, 12, 12);
    const std::uint64_t loaded = pager.getStatistics().loadedPages;
    const PixelRect changed{20, 20, 8, 8};
    source.update(store, 2, &changed);
    pager.invalidate(0, changed);
    lookAtFrames(pager, pageBytes, &changed);
    EXPECT_LE(pager.getStatistics().loadedPages - loaded, 9u + 4 + 4 + 4 + 1 + 1);
    EXPECT_EQ(model.versions(0, grid, &changed), std::set<int>{2});
    EXPECT_TRUE(model.holds({0, 0, 11, 11}));
}

TEST_F(VirtualPagerSwitchTest, withoutRoomPagesAreReplacedInOneFrameTheCoarsestFirst)
{
    for (const int pagesInPlace : {1, 6, 1000})
    {
        source.build(store, 1);
        VirtualPagerSettings settings = smallPager(25); // just what is needed
        settings.switchBytes = std::uint64_t(pagesInPlace) * pageBytes;
        VirtualPager pager(settings);
        pager.addTexture(store);
        model = {};
        pager.report(0, needsOf(grid, 0, 0, 0, 0, 4, 4));
        settle(pager, model, frame);
        source.update(store, 2);
        pager.invalidate(0);
        lookAtFrames(pager, pageBytes);
        EXPECT_EQ(model.versions(0, grid), std::set<int>{2});
        EXPECT_TRUE(model.holds({0, 0, 3, 3}));
    }
}

TEST_F(VirtualPagerSwitchTest, aPagerOfOneSlotSwitchesToo)
{
    VirtualPager pager(smallPager(1));
    show(pager, store, 0, 0, 0, 4, 4);
    source.update(store, 2);
    pager.invalidate(0);
    lookAtFrames(pager, pageBytes);
    EXPECT_EQ(model.versions(0, grid), std::set<int>{2});
}

TEST_F(VirtualPagerSwitchTest, aCameraThatMovesDoesNotKeepTheOldState)
{
    VirtualPager pager(smallPager(200));
    show(pager, store, 0, 0, 0, 5, 5);
    source.update(store, 2);
    pager.invalidate(0);
    int frames = 0;
    for (; frames < 30000 && pager.getStatistics().switches == 0; ++frames)
    {
        pager.report(0, needsOf(grid, 0, 0, frames % 30, frames % 20, 5, 5));
        pager.advance(++frame);
        model.apply(pager.takeUploads(0, pageBytes));
        EXPECT_EQ(model.versions(0, grid).size(), 1u);
        pager.waitForLoads(0.002);
    }
    EXPECT_EQ(pager.getStatistics().switches, 1u) << frames;
    lookAtFrames(pager, pageBytes);
    EXPECT_EQ(model.versions(0, grid), std::set<int>{2});
}

TEST_F(VirtualPagerSwitchTest, manyUpdatesInARowEndWithTheLastOne)
{
    VirtualPager pager(smallPager(150));
    show(pager, store, 0, 4, 4, 6, 6);
    for (int version = 2; version < 16; ++version)
    {
        source.update(store, version);
        pager.invalidate(0);
        for (int i = 0; i < version; ++i)
        {
            pager.advance(++frame);
            model.apply(pager.takeUploads(0, 5 * pageBytes));
            EXPECT_EQ(model.versions(0, grid).size(), 1u);
        }
    }
    lookAtFrames(pager, 5 * pageBytes);
    EXPECT_EQ(model.versions(0, grid), std::set<int>{15});
}

TEST_F(VirtualPagerSwitchTest, aCommitOfAnotherProcessIsSeenByTheWatch)
{
    VirtualPagerSettings settings = smallPager(200);
    settings.watchSeconds = 0.02;
    VirtualPager pager(settings);
    show(pager, store, 0, 4, 4, 6, 6);
    source.update(store, 3);
    for (int i = 0; i < 30000 && model.versions(0, grid) != std::set<int>{3}; ++i)
    {
        pager.advance(++frame);
        model.apply(pager.takeUploads(0, 5 * pageBytes));
        EXPECT_EQ(model.versions(0, grid).size(), 1u);
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    EXPECT_EQ(model.versions(0, grid), std::set<int>{3});

    // And one whose file takes the place of the old one.
    source.build(folder.file("other.tiles"), 4);
    fs::rename(folder.file("other.tiles"), store);
    for (int i = 0; i < 30000 && model.versions(0, grid) != std::set<int>{4}; ++i)
    {
        pager.advance(++frame);
        model.apply(pager.takeUploads(0, 5 * pageBytes));
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    EXPECT_EQ(model.versions(0, grid), std::set<int>{4});
}

TEST_F(VirtualPagerSwitchTest, bothContextsSwitchEachAtOnce)
{
    VirtualPager pager(smallPager(200));
    pager.addTexture(store);
    pager.report(0, needsOf(grid, 0, 0, 4, 4, 6, 6));
    ContextModel second;
    for (int round = 0; round < 2; ++round)
    {
        for (int i = 0; i < 30000 && (i < 3 || !pager.isAtRest()); ++i)
        {
            pager.advance(++frame);
            model.apply(pager.takeUploads(0, 5 * pageBytes));
            second.apply(pager.takeUploads(1, 2 * pageBytes));
            EXPECT_LE(model.versions(0, grid).size(), 1u);
            EXPECT_LE(second.versions(0, grid).size(), 1u);
            pager.waitForLoads(0.01);
        }
        EXPECT_EQ(model.versions(0, grid), std::set<int>{1 + round});
        EXPECT_EQ(second.versions(0, grid), std::set<int>{1 + round});
        EXPECT_TRUE(second.holds({0, 0, 9, 9}));
        source.update(store, 2 + round);
        pager.invalidate(0);
    }
}

} // namespace osgPagedTexture
