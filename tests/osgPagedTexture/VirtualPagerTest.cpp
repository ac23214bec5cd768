// SPDX-License-Identifier: MIT
#include "VirtualStores.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <random>

namespace osgPagedTexture
{

struct VirtualPagerTest : PagerTest
{
};

TEST_F(VirtualPagerTest, whatAViewAsksForIsThereWithTheCoarserPagesAboveIt)
{
    VirtualPager pager(smallPager(100));
    const std::uint32_t texture = pager.addTexture(store);
    pager.report(0, {{{texture, 0, 7, 5}, 3}});
    settle(pager, model, frame);

    PageKey page{texture, 0, 7, 5};
    for (; page.level < pageLevels(grid); page = page.ancestor())
    {
        EXPECT_TRUE(model.holds(page)) << page.level;
    }
    EXPECT_FALSE(model.holds({texture, 0, 8, 5}));
    EXPECT_EQ(model.versions(texture, grid), std::set<int>{1});
    EXPECT_EQ(pager.getStatistics().usedSlots, pageLevels(grid));
}

TEST_F(VirtualPagerTest, theCoarsestPageOfATextureIsThereBeforeAnyReport)
{
    VirtualPager pager(smallPager(4));
    const std::uint32_t texture = pager.addTexture(store);
    settle(pager, model, frame);

    EXPECT_TRUE(model.holds({texture, pageLevels(grid) - 1, 0, 0}));
    EXPECT_EQ(PageEntry::levelOf(model.entryOf({texture, 0, 36, 24})), pageLevels(grid) - 1);
}

TEST_F(VirtualPagerTest, aTableHasNoMoreLevelsThanWhatIsThereNeeds)
{
    VirtualPager pager(smallPager(100));
    const std::uint32_t texture = pager.addTexture(store);
    settle(pager, model, frame);
    EXPECT_EQ(model.getLayout(texture).levels.size(), 1u);

    pager.report(0, {{{texture, 3, 0, 0}, 1}});
    settle(pager, model, frame);
    EXPECT_EQ(model.getLayout(texture).finest, 3);
}

TEST_F(VirtualPagerTest, fourSlotsShowACoarserPictureAndStayStill)
{
    VirtualPager pager(smallPager(4));
    const std::uint32_t texture = pager.addTexture(store);
    for (int i = 0; i < 10; ++i)
    {
        pager.report(0, needsOf(grid, texture, 0, 0, 0, 38, 25));
        settle(pager, model, frame);
    }
    const std::uint64_t uploaded = pager.getStatistics().uploadedPages;
    for (int i = 0; i < 100; ++i)
    {
        pager.report(0, needsOf(grid, texture, 0, 0, 0, 38, 25));
        settle(pager, model, frame);
    }
    EXPECT_EQ(pager.getStatistics().uploadedPages, uploaded);
    EXPECT_GT(pager.getStatistics().bias, 0);
    EXPECT_LE(pager.getStatistics().usedSlots, 4);
    EXPECT_EQ(model.versions(texture, grid), std::set<int>{1});
}

TEST_F(VirtualPagerTest, feedbackThatSeesOtherPagesEachTimeMovesNothingWhereNotAllFits)
{
    std::mt19937 random(2);
    VirtualPager pager(smallPager(240));
    const std::uint32_t texture = pager.addTexture(store);
    const std::vector<PageNeed> all = needsOf(grid, texture, 0, 0, 0, 30, 20);
    std::uint64_t uploaded = 0;
    for (int i = 0; i < 400; ++i)
    {
        std::vector<PageNeed> seen;
        std::copy_if(all.begin(), all.end(), std::back_inserter(seen),
                     [&](const PageNeed&) { return random() % 2 == 0; });
        pager.report(0, seen);
        settle(pager, model, frame);
        uploaded = i < 100 ? pager.getStatistics().uploadedPages : uploaded;
    }
    EXPECT_EQ(pager.getStatistics().uploadedPages, uploaded);
    EXPECT_EQ(pager.getStatistics().bias, 1);
    EXPECT_EQ(model.versions(texture, grid), std::set<int>{1});
}

TEST_F(VirtualPagerTest, uploadsOfAFrameKeepToTheirBytes)
{
    VirtualPager pager(smallPager(400));
    const std::uint32_t texture = pager.addTexture(store);
    const std::uint64_t page = pager.getPageBytes();
    pager.report(0, needsOf(grid, texture, 0, 0, 0, 10, 10));
    std::size_t pages = 0;
    while (!pager.isAtRest() || pages == 0)
    {
        pager.advance(++frame);
        const PageUploads uploads = pager.takeUploads(0, 3 * page + 1);
        EXPECT_LE(uploads.pages.size(), 3u);
        pages += uploads.pages.size();
        model.apply(uploads);
        pager.waitForLoads(0.01);
    }
    EXPECT_GT(pages, 100u);
    EXPECT_TRUE(pager.takeUploads(0, 0).pages.empty());
}

TEST_F(VirtualPagerTest, pagesComeBackFromMemoryWithoutTheStore)
{
    VirtualPager pager(smallPager(30));
    const std::uint32_t texture = pager.addTexture(store);
    pager.report(0, needsOf(grid, texture, 0, 0, 0, 4, 4));
    settle(pager, model, frame);
    pager.report(0, needsOf(grid, texture, 0, 30, 18, 4, 4));
    settle(pager, model, frame);
    const VirtualPagerStatistics before = pager.getStatistics();

    pager.report(0, needsOf(grid, texture, 0, 0, 0, 4, 4));
    settle(pager, model, frame);
    const VirtualPagerStatistics after = pager.getStatistics();
    EXPECT_EQ(after.loadedPages, before.loadedPages);
    EXPECT_GT(after.uploadedPages, before.uploadedPages);
    EXPECT_EQ(after.cacheHits - before.cacheHits, after.uploadedPages - before.uploadedPages);
    EXPECT_TRUE(model.holds({texture, 0, 3, 3}));
    EXPECT_EQ(model.versions(texture, grid), std::set<int>{1});
}

TEST_F(VirtualPagerTest, aContextThatComesLaterGetsAllThatIsInView)
{
    VirtualPagerSettings settings = smallPager(100);
    settings.cacheBytes = 0; // what the first context has must be read again
    VirtualPager pager(settings);
    const std::uint32_t texture = pager.addTexture(store);
    pager.report(0, needsOf(grid, texture, 0, 4, 4, 8, 8));
    settle(pager, model, frame);
    EXPECT_FALSE(pager.getStatistics().missingPages);

    ContextModel second;
    second.apply(pager.takeUploads(7, 1));
    EXPECT_FALSE(pager.isAtRest());
    for (int i = 0; i < 30000 && !pager.isAtRest(); ++i)
    {
        pager.advance(++frame);
        model.apply(pager.takeUploads(0, 2000));
        second.apply(pager.takeUploads(7, 1000));
        pager.waitForLoads(0.01);
    }
    for (const PageNeed& need : needsOf(grid, texture, 0, 4, 4, 8, 8))
    {
        EXPECT_TRUE(model.holds(need.page));
        EXPECT_TRUE(second.holds(need.page));
    }
    EXPECT_EQ(second.versions(texture, grid), std::set<int>{1});
}

TEST_F(VirtualPagerTest, aContextThatIsNotDrawnHoldsUpNobody)
{
    VirtualPagerSettings settings = smallPager(100);
    settings.queueBytes = 1000;
    VirtualPager pager(settings);
    const std::uint32_t texture = pager.addTexture(store);
    pager.takeUploads(7, 1);
    pager.report(0, needsOf(grid, texture, 0, 4, 4, 8, 8));
    settle(pager, model, frame);
    EXPECT_TRUE(model.holds({texture, 0, 10, 10}));
}

TEST_F(VirtualPagerTest, severalTexturesAndViewsShareTheSlots)
{
    ColorStore other = source;
    other.texture = 1;
    other.build(folder.file("other.tiles"), 2);
    VirtualPager pager(smallPager(200));
    const std::uint32_t first = pager.addTexture(store);
    const std::uint32_t second = pager.addTexture(folder.file("other.tiles"));
    pager.report(0, needsOf(grid, first, 0, 0, 0, 5, 5));
    pager.report(1, needsOf(grid, second, 1, 2, 2, 5, 5));
    settle(pager, model, frame);
    EXPECT_TRUE(model.holds({first, 0, 4, 4}));
    EXPECT_TRUE(model.holds({second, 1, 6, 6}));
    EXPECT_EQ(model.versions(first, grid), std::set<int>{1});
    EXPECT_EQ(model.versions(second, grid), std::set<int>{2});

    pager.removeTexture(first);
    settle(pager, model, frame);
    EXPECT_EQ(model.versions(second, grid), std::set<int>{2});
    EXPECT_TRUE(model.holds({second, 1, 6, 6}));
    EXPECT_THROW(
        {
            ColorStore unlike;
            unlike.side = 12;
            unlike.build(folder.file("unlike.tiles"), 1);
            pager.addTexture(folder.file("unlike.tiles"));
        },
        TileStoreError);
}

TEST_F(VirtualPagerTest, nonsenseInReportsHarmsNothing)
{
    VirtualPager pager(smallPager(100));
    const std::uint32_t texture = pager.addTexture(store);
    pager.report(0, {{{texture, 200, 5, 5}, 1},
                     {{texture, -3, 1, 1}, 1},
                     {{texture, 0, -1, 4}, 1},
                     {{texture, 0, 1 << 30, 1 << 30}, 1},
                     {{texture + 9, 0, 1, 1}, 1}});
    settle(pager, model, frame);
    EXPECT_TRUE(model.holds({texture, 0, 1, 1}));
    EXPECT_EQ(pager.getStatistics().usedSlots, pageLevels(grid));
}

TEST_F(VirtualPagerTest, frozenPagesStay)
{
    VirtualPager pager(smallPager(20));
    const std::uint32_t texture = pager.addTexture(store);
    pager.report(0, needsOf(grid, texture, 0, 0, 0, 3, 3));
    settle(pager, model, frame);
    pager.setFrozen(true);
    pager.report(0, needsOf(grid, texture, 0, 20, 20, 3, 3));
    settle(pager, model, frame);
    EXPECT_FALSE(model.holds({texture, 0, 20, 20}));
    pager.setFrozen(false);
    settle(pager, model, frame);
    EXPECT_TRUE(model.holds({texture, 0, 20, 20}));
}

} // namespace osgPagedTexture
