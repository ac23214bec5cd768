// SPDX-License-Identifier: MIT
#include <osgPagedTexture/PageCache.h>
#include <osgPagedTexture/PageSlots.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

using namespace osgPagedTexture;

namespace
{

PageVersion pageOf(int number, std::uint32_t generation = 1)
{
    return {{0, 0, number, 0}, generation};
}

LoadedPage loadedOf(std::size_t bytes)
{
    return {std::make_shared<const PageTexels>(bytes), {}};
}

} // namespace

TEST(PageSlotsTest, thePageThatWasNeededLongestAgoGoesFirst)
{
    PageSlots slots(3);
    const int a = slots.take(pageOf(1), 1);
    const int b = slots.take(pageOf(2), 1);
    slots.take(pageOf(3), 2);
    slots.need(a, 3);
    EXPECT_EQ(slots.take(pageOf(4), 3), b);
    EXPECT_EQ(slots.find(pageOf(2)), PageSlots::None);
    EXPECT_EQ(slots.find(pageOf(4)), b);
}

TEST(PageSlotsTest, whatIsNeededNowIsNotGivenAway)
{
    PageSlots slots(2);
    slots.take(pageOf(1), 5);
    slots.take(pageOf(2), 5);
    EXPECT_EQ(slots.take(pageOf(3), 5), PageSlots::None);
    EXPECT_EQ(slots.countRoom(5), 0);
    EXPECT_EQ(slots.countRoom(6), 2);
    EXPECT_NE(slots.take(pageOf(3), 6), PageSlots::None);
}

TEST(PageSlotsTest, randomUseNeverGivesASlotToTwo)
{
    std::mt19937 random(1);
    PageSlots slots(17);
    std::vector<std::uint64_t> needed(17);
    for (std::uint64_t time = 1; time < 20000; ++time)
    {
        const PageVersion page = pageOf(int(random() % 40));
        const int slot = slots.find(page);
        if (slot == PageSlots::None)
        {
            const bool isFull = slots.getUsedCount() == slots.getCount();
            const auto oldest = std::min_element(needed.begin(), needed.end()) - needed.begin();
            const int taken = slots.take(page, time);
            ASSERT_NE(taken, PageSlots::None);
            if (isFull)
            {
                ASSERT_EQ(taken, oldest);
            }
            needed[std::size_t(taken)] = time;
        }
        else if (random() % 8 == 0)
        {
            slots.free(slot);
            needed[std::size_t(slot)] = 0;
        }
        else
        {
            slots.need(slot, time);
            needed[std::size_t(slot)] = time;
        }
        int used = 0;
        for (int i = 0; i < slots.getCount(); ++i)
        {
            used += slots.isUsed(i);
            ASSERT_TRUE(!slots.isUsed(i) || slots.find(slots.getPage(i)) == i);
        }
        ASSERT_EQ(used, slots.getUsedCount());
    }
}

TEST(PageSlotsTest, aRenamedPageIsFoundByItsNewNameAlone)
{
    PageSlots slots(2);
    const int slot = slots.take(pageOf(1, 1), 1);
    slots.rename(slot, pageOf(1, 2));
    EXPECT_EQ(slots.find(pageOf(1, 1)), PageSlots::None);
    EXPECT_EQ(slots.find(pageOf(1, 2)), slot);
}

TEST(PageCacheTest, thePageUsedLongestAgoGoesFirstAndTheBytesAreKept)
{
    PageCache cache(300);
    cache.put(pageOf(1), loadedOf(100));
    cache.put(pageOf(2), loadedOf(100));
    cache.put(pageOf(3), loadedOf(100));
    EXPECT_TRUE(cache.find(pageOf(1)));
    cache.put(pageOf(4), loadedOf(100));
    EXPECT_FALSE(cache.look(pageOf(2)));
    EXPECT_TRUE(cache.look(pageOf(1)));
    EXPECT_EQ(cache.getStatistics().bytes, 300u);
    cache.put(pageOf(5), loadedOf(301));
    EXPECT_FALSE(cache.look(pageOf(5)));
    EXPECT_EQ(cache.getStatistics().pages, 3u);
}

TEST(PageCacheTest, renamingReplacesWhatHasTheName)
{
    PageCache cache(1000);
    cache.put(pageOf(1, 1), loadedOf(100));
    cache.put(pageOf(1, 2), loadedOf(50));
    cache.put(pageOf(2, 1), loadedOf(100));
    cache.put(pageOf(3, 1), loadedOf(100));
    cache.renameAll(
        [](PageVersion& page)
        {
            page.generation = 2;
            return page.page.x != 3;
        });
    EXPECT_EQ(cache.getStatistics().pages, 2u);
    EXPECT_TRUE(cache.look(pageOf(1, 2)));
    EXPECT_TRUE(cache.look(pageOf(2, 2)));
    EXPECT_FALSE(cache.look(pageOf(2, 1)));
    EXPECT_FALSE(cache.look(pageOf(3, 2)));
    EXPECT_EQ(cache.getStatistics().bytes,
              cache.look(pageOf(1, 2))->texels->size() + cache.look(pageOf(2, 2))->texels->size());
}
