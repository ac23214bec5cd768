// SPDX-License-Identifier: MIT
#include <osgPagedTexture/PageSelection.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

using namespace osgPagedTexture;

namespace
{

const std::vector<int> OneTexture{10};

std::vector<PageNeed> block(int level, int x, int y, int columns, int rows)
{
    std::vector<PageNeed> needs;
    for (int i = 0; i < columns * rows; ++i)
    {
        needs.push_back({{0, level, x + i % columns, y + i / columns}, 5});
    }
    return needs;
}

std::set<PageKey> pagesOf(const PageSelection& selection)
{
    std::set<PageKey> pages;
    for (const PageNeed& need : selection.getPages())
    {
        pages.insert(need.page);
    }
    return pages;
}

} // namespace

TEST(PageSelectionTest, whatFitsIsChosenWithAllThatCoversIt)
{
    PageSelection selection;
    selection.choose(block(0, 100, 100, 2, 2), OneTexture, 100);
    EXPECT_EQ(selection.getBias(), 0);
    EXPECT_EQ(selection.getPages().size(), 4u + 10);
    EXPECT_EQ(selection.getPages().front().page.level, 10);
    EXPECT_EQ(selection.getPages().front().pixels, 20u);
    EXPECT_EQ(selection.getPages().back().page.level, 0);
}

TEST(PageSelectionTest, moreThanFitsIsCoarserByOneBiasForAll)
{
    PageSelection selection;
    std::vector<PageNeed> needs = block(0, 0, 0, 16, 16);
    const std::vector<PageNeed> far = block(3, 60, 60, 8, 8);
    needs.insert(needs.end(), far.begin(), far.end());
    selection.choose(needs, OneTexture, 150);
    EXPECT_EQ(selection.getBias(), 1);
    const std::set<PageKey> pages = pagesOf(selection);
    EXPECT_EQ(pages.count({0, 1, 7, 7}), 1u);
    EXPECT_EQ(pages.count({0, 0, 15, 15}), 0u);
    EXPECT_EQ(pages.count({0, 4, 33, 33}), 1u);
    EXPECT_EQ(pages.count({0, 3, 63, 63}), 0u);
}

TEST(PageSelectionTest, neverMoreThanThereIsRoomForAndEachWithItsParent)
{
    std::mt19937 random(5);
    PageSelection selection;
    for (int round = 0; round < 300; ++round)
    {
        std::vector<PageNeed> needs;
        for (int i = int(random() % 5); i >= 0; --i)
        {
            const int level = int(random() % 5);
            const auto place = [&] { return int(random() % ((1024u >> level) - 30)); };
            const std::vector<PageNeed> more =
                block(level, place(), place(), 1 + int(random() % 30), 1 + int(random() % 30));
            needs.insert(needs.end(), more.begin(), more.end());
        }
        const int room = 1 + int(random() % 300);
        selection.choose(needs, OneTexture, room);
        const std::set<PageKey> pages = pagesOf(selection);
        ASSERT_LE(pages.size(), std::size_t(room));
        ASSERT_EQ(pages.size(), selection.getPages().size());
        ASSERT_EQ(pages.count({0, 10, 0, 0}), 1u);
        for (const PageKey& page : pages)
        {
            ASSERT_TRUE(page.level == 10 || pages.count(page.ancestor()) == 1);
        }
    }
}

TEST(PageSelectionTest, needsAtTheLimitDoNotMakeItSwing)
{
    // 100 to 104 pages of level 0 asked for in turn, where 144 with the coarser ones fit.
    PageSelection selection;
    int changes = 0;
    int bias = 0;
    for (int i = 0; i < 200; ++i)
    {
        std::vector<PageNeed> needs = block(0, 0, 0, 10, 10);
        const std::vector<PageNeed> more = block(0, 200, 0, i % 5 + 1, 1);
        needs.insert(needs.end(), more.begin(), more.end());
        selection.choose(needs, OneTexture, 155);
        changes += selection.getBias() != bias;
        bias = selection.getBias();
    }
    EXPECT_LE(changes, 1);
    selection.choose(block(0, 0, 0, 4, 4), OneTexture, 155);
    EXPECT_EQ(selection.getBias(), 0);
}

TEST(PageSelectionTest, whereNotEvenTheCoarsestPagesFitThoseInViewDo)
{
    PageSelection selection;
    std::vector<PageNeed> needs;
    for (std::uint32_t texture = 0; texture < 20; ++texture)
    {
        needs.push_back({{texture, 5, 0, 0}, texture == 7 || texture == 12 ? 100u : 0u});
    }
    selection.choose(needs, std::vector<int>(20, 5), 2);
    EXPECT_EQ(pagesOf(selection), (std::set<PageKey>{{7, 5, 0, 0}, {12, 5, 0, 0}}));
}

TEST(PageMemoryTest, aPageThatAReportMissesIsNotUnneededYet)
{
    PageMemory memory(3);
    std::vector<PageNeed> all = block(0, 0, 0, 4, 4);
    memory.add(all);
    all.pop_back();
    memory.add(all);
    memory.add(all);
    EXPECT_EQ(memory.getNeeds().size(), 16u);
    memory.add(all);
    EXPECT_EQ(memory.getNeeds().size(), 15u);
}

TEST(PageMemoryTest, aJumpForgetsWhatWasBefore)
{
    PageMemory memory(100);
    memory.add(block(0, 0, 0, 4, 4));
    memory.add(block(0, 1, 0, 4, 4));
    EXPECT_EQ(memory.getNeeds().size(), 20u);
    memory.add(block(0, 100, 0, 4, 4));
    EXPECT_EQ(memory.getNeeds().size(), 16u);
    memory.add({});
    EXPECT_EQ(memory.getNeeds().size(), 16u);
}

TEST(VirtualPagesTest, equalPagesOfAFeedbackPictureAreCounted)
{
    const PageKey a{0, 1, 2, 3}, b{0, 0, 2, 3}, c{1, 0, 0, 0};
    const std::vector<PageNeed> needs = countPages({a, b, a, c, a, b});
    ASSERT_EQ(needs.size(), 3u);
    EXPECT_EQ(needs[0].page, a);
    EXPECT_EQ(needs[0].pixels, 3u);
    EXPECT_EQ(needs[1].pixels, 2u);
    EXPECT_EQ(needs[2].page, c);
}
