// SPDX-License-Identifier: MIT
#include <osgPagedTexture/PageTable.h>

#include <gtest/gtest.h>

#include <map>
#include <random>

using namespace osgPagedTexture;

namespace
{

/// Calls visit(page) for each page of all levels.
template <class Visit> void forEachPage(const TileGrid& grid, const Visit& visit)
{
    for (int level = 0; level < pageLevels(grid); ++level)
    {
        for (int y = 0; y < grid.getRows(level); ++y)
        {
            for (int x = 0; x < grid.getColumns(level); ++x)
            {
                visit(PageKey{0, level, x, y});
            }
        }
    }
}

/// What the table must say, found by going up from the page.
std::uint32_t expected(const std::map<PageKey, int>& mapped, int levels, PageKey page)
{
    for (; page.level < levels; page = page.ancestor())
    {
        const auto found = mapped.find(page);
        if (found != mapped.end())
        {
            return PageEntry::pack(found->second, page.level);
        }
    }
    return PageEntry::Empty;
}

} // namespace

TEST(PageTableTest, randomChangesLeaveEachPageWithTheNearestOneThatIsThere)
{
    std::mt19937 random(7);
    for (const TileGrid& grid : {TileGrid(300, 200, 10, 1), TileGrid(64, 512, 8, 0),
                                 TileGrid(8, 8, 8, 0), TileGrid(1000, 3, 12, 2)})
    {
        PageTable table(grid);
        std::map<PageKey, int> mapped;
        std::vector<PageKey> pages;
        forEachPage(grid, [&](const PageKey& page) { pages.push_back(page); });
        for (int step = 0; step < 600; ++step)
        {
            const PageKey page = pages[random() % pages.size()];
            const auto known = mapped.find(page);
            if (known == mapped.end() || random() % 3 == 0)
            {
                mapped[page] = step;
                table.map(page, step);
            }
            else
            {
                table.unmap(page, known->second + 5000); // of another slot: nothing
                table.unmap(page, known->second);
                mapped.erase(known);
            }
            if (step % 20 == 0)
            {
                forEachPage(
                    grid, [&](const PageKey& each)
                    { ASSERT_EQ(table.find(each), expected(mapped, pageLevels(grid), each)); });
            }
        }
    }
}

TEST(PageTableTest, theChangesToldBringACopyUpToDate)
{
    const TileGrid grid(1000, 700, 10, 1);
    std::mt19937 random(3);
    std::vector<PageKey> pages;
    forEachPage(grid, [&](const PageKey& page) { pages.push_back(page); });
    PageTable table(grid);
    std::vector<std::uint32_t> copy;
    std::uint32_t version = ~0u;
    std::map<PageKey, int> mapped;
    for (int step = 0; step < 1000; ++step)
    {
        for (int i = int(random() % 40); i >= 0; --i)
        {
            const PageKey page = pages[random() % pages.size()];
            if (mapped.count(page) != 0)
            {
                table.unmap(page, mapped[page]);
                mapped.erase(page);
            }
            else
            {
                mapped[page] = step;
                table.map(page, step);
            }
        }
        if (version != table.getLayoutVersion())
        {
            version = table.getLayoutVersion();
            copy.assign(table.getEntries().size(), 0xDEADBEEF);
        }
        const int width = table.getLayout().width;
        for (const TableRect& rect : table.takeChanges())
        {
            for (int y = rect.y; y < rect.y + rect.height; ++y)
            {
                const auto from = table.getEntries().begin() + y * width + rect.x;
                std::copy(from, from + rect.width, copy.begin() + y * width + rect.x);
            }
        }
        ASSERT_EQ(copy, table.getEntries());
        EXPECT_TRUE(table.takeChanges().empty());
    }
}

TEST(PageTableTest, changedPagesFarFromEachOtherAreAFewEntriesToUpload)
{
    const TileGrid grid(100000, 100000, 100, 0);
    PageTable table(grid);
    table.map({0, 9, 1, 1}, 3);
    table.map({0, 0, 700, 700}, 4);
    table.takeChanges();
    table.map({0, 0, 10, 10}, 5);
    table.map({0, 0, 900, 900}, 6);
    std::int64_t entries = 0;
    for (const TableRect& rect : table.takeChanges())
    {
        entries += std::int64_t(rect.width) * rect.height;
    }
    EXPECT_EQ(entries, 2);
}

TEST(PageTableTest, levelsLieBesideEachOther)
{
    const TileGrid grid(1000, 700, 10, 1);
    PageTable table(grid);
    table.map({0, 0, 5, 5}, 1);
    const PageTableLayout& layout = table.getLayout();
    ASSERT_EQ(layout.finest, 0);
    ASSERT_EQ(layout.coarsest(), pageLevels(grid) - 1);
    std::vector<int> uses(std::size_t(layout.width) * layout.height);
    for (const PageTableLayout::Level& level : layout.levels)
    {
        for (int y = 0; y < level.rows; ++y)
        {
            for (int x = 0; x < level.columns; ++x)
            {
                ASSERT_EQ(uses.at(std::size_t(level.y + y) * layout.width + level.x + x)++, 0);
            }
        }
    }
}

TEST(PageTableTest, levelsFinerThanAllowedAreNeverHeld)
{
    const TileGrid grid(1000, 700, 10, 1);
    PageTable table(grid, 2);
    table.map({0, 2, 3, 3}, 1);
    table.map({0, 1, 6, 6}, 2);
    EXPECT_EQ(table.getLayout().finest, 2);
    EXPECT_EQ(table.find({0, 0, 13, 13}), PageEntry::pack(1, 2));
    table.clear();
    EXPECT_EQ(table.getLayout().finest, pageLevels(grid) - 1);
    EXPECT_EQ(table.find({0, 0, 13, 13}), PageEntry::Empty);
}
