// SPDX-License-Identifier: MIT
// Stores that are damaged, or taken away, while they are shown.
#include "PictureFiles.h"
#include "VirtualStores.h"

#include <osgPagedTexture/TileFolders.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <thread>

namespace osgPagedTexture
{

namespace fs = std::filesystem;

struct VirtualPagerFaultTest : PagerTest
{
    static int countLines(const std::vector<std::string>& lines, const std::string& part)
    {
        return int(std::count_if(lines.begin(), lines.end(),
                                 [&](const std::string& line)
                                 { return line.find(part) != std::string::npos; }));
    }
    void put(const PageKey& page, const TileData& tile)
    {
        TilePackWriter writer(store, {});
        writer.put(page.tile(), tile);
        writer.commit();
    }

    /// A folder of few tiles: each is a picture file.
    void writeFolder(int version)
    {
        source.width = source.height = 110;
        grid = source.settings().grid;
        const auto encode = [](const TileColor& color, int width, int height)
        {
            Pixels pixels(width, height, 3);
            for (std::size_t i = 0; i < pixels.bytes.size(); ++i)
            {
                pixels.bytes[i] = color[i % 3];
            }
            return encodePng(pixels);
        };
        TileFolderWriter writer(tiles, FolderLayout::LibVT, source.settings(), encode);
        source.put(writer, version);
        writer.commit();
    }

    const std::string tiles = folder.file("tiles");
};

TEST_F(VirtualPagerFaultTest, aDamagedTileLeavesTheCoarserPageAndIsNamedOnce)
{
    const PageKey damaged{0, 0, 5, 5};
    put(damaged, TileData::encoded("this is no picture"));
    VirtualPager pager(smallPager(200));
    pager.addTexture(store);
    for (int i = 0; i < 5; ++i)
    {
        pager.report(0, needsOf(grid, 0, 0, 4, 4, 4, 4));
        settle(pager, model, frame);
    }
    EXPECT_FALSE(model.holds(damaged));
    EXPECT_EQ(PageEntry::levelOf(model.entryOf(damaged)), 1);
    EXPECT_TRUE(model.holds({0, 0, 6, 5}));
    const std::vector<std::string> messages = pager.takeMessages();
    ASSERT_EQ(messages.size(), 1u);
    EXPECT_NE(messages[0].find(store), std::string::npos) << messages[0];
    EXPECT_NE(messages[0].find("tile 5, 5 of level 0"), std::string::npos) << messages[0];
    EXPECT_EQ(pager.getStatistics().failedPages, 1u);

    put(damaged, TileData::uniform(colorOf(damaged, 1)));
    pager.invalidate(0);
    settle(pager, model, frame);
    EXPECT_TRUE(model.holds(damaged));
    EXPECT_EQ(model.versions(0, grid), std::set<int>{1});
    EXPECT_EQ(pager.getStatistics().failedPages, 0u);
}

TEST_F(VirtualPagerFaultTest, aNewStateWhoseCoarsestPageIsDamagedIsNotShown)
{
    VirtualPager pager(smallPager(200));
    show(pager, store, 0, 4, 4, 4, 4);
    source.update(store, 2);
    put({0, pageLevels(grid) - 1, 0, 0}, TileData::encoded("this is no picture"));
    pager.invalidate(0);
    settle(pager, model, frame);
    EXPECT_EQ(model.versions(0, grid), std::set<int>{1});
    EXPECT_TRUE(model.holds({0, 0, 7, 7}));
    EXPECT_EQ(countLines(pager.takeMessages(), "what is shown stays"), 1);

    source.update(store, 3);
    pager.invalidate(0);
    settle(pager, model, frame);
    EXPECT_EQ(model.versions(0, grid), std::set<int>{3});
}

TEST_F(VirtualPagerFaultTest, aStoreThatIsDeletedGoesOnAndIsNamed)
{
    VirtualPagerSettings settings = smallPager(200);
    settings.watchSeconds = 0.01;
    VirtualPager pager(settings);
    show(pager, store, 0, 4, 4, 4, 4);
    fs::remove(store);
    std::vector<std::string> messages;
    for (int i = 0; i < 30000 && messages.empty(); ++i)
    {
        pager.advance(++frame);
        messages = pager.takeMessages();
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    ASSERT_EQ(messages.size(), 1u);
    EXPECT_NE(messages[0].find("what is shown stays"), std::string::npos) << messages[0];

    pager.report(0, needsOf(grid, 0, 0, 20, 4, 4, 4));
    settle(pager, model, frame);
    EXPECT_TRUE(model.holds({0, 0, 23, 7})) << "the file is open";
    EXPECT_EQ(model.versions(0, grid), std::set<int>{1});
}

TEST_F(VirtualPagerFaultTest, aStoreThatIsCutOffKeepsWhatIsThereAndNamesNotEveryTile)
{
    {
        // Encoded tiles, so that there is something to read at each place.
        TilePackWriter writer(store, {});
        for (int y = 0; y < grid.getRows(0); ++y)
        {
            for (int x = 0; x < grid.getColumns(0); ++x)
            {
                writer.put({0, x, y}, TileData::encoded(std::string(500, char('a' + x))));
            }
        }
        writer.commit();
    }
    VirtualPager pager(smallPager(200));
    show(pager, store, 1, 2, 2, 4, 4);
    fs::resize_file(store, 5000);
    pager.report(0, needsOf(grid, 0, 0, 4, 4, 8, 8));
    settle(pager, model, frame);
    EXPECT_TRUE(model.holds({0, 1, 3, 3}));
    EXPECT_EQ(model.versions(0, grid), std::set<int>{1});
    const std::vector<std::string> messages = pager.takeMessages();
    EXPECT_EQ(messages.size(), 9u);
    EXPECT_EQ(countLines(messages, "more tiles of"), 1);

    // A store in its place is read without being asked twice.
    source.build(folder.file("other.tiles"), 2);
    fs::rename(folder.file("other.tiles"), store);
    pager.invalidate(0);
    settle(pager, model, frame);
    EXPECT_EQ(model.versions(0, grid), std::set<int>{2});
    EXPECT_TRUE(model.holds({0, 0, 11, 11}));
}

TEST_F(VirtualPagerFaultTest, aStoreOfAnotherSizeIsNotShownInTheOldOnesPlace)
{
    VirtualPager pager(smallPager(200));
    show(pager, store, 0, 4, 4, 4, 4);
    ColorStore other = source;
    other.width = 100;
    other.build(folder.file("other.tiles"), 2);
    fs::rename(folder.file("other.tiles"), store);
    pager.invalidate(0);
    settle(pager, model, frame);
    EXPECT_EQ(model.versions(0, grid), std::set<int>{1});
    EXPECT_EQ(countLines(pager.takeMessages(), "another size"), 1);
}

TEST_F(VirtualPagerFaultTest, aFolderThatIsGoneDoesNotBecomeEmptyPages)
{
    writeFolder(1);
    VirtualPager pager(smallPager(200));
    show(pager, tiles, 1, 2, 2, 4, 4);
    EXPECT_TRUE(model.holds({0, 1, 5, 5}));
    EXPECT_EQ(model.versions(0, grid), std::set<int>{1});

    fs::remove_all(tiles);
    pager.report(0, needsOf(grid, 0, 0, 4, 4, 8, 8));
    settle(pager, model, frame);
    EXPECT_FALSE(model.holds({0, 0, 5, 5}));
    EXPECT_TRUE(model.holds({0, 1, 5, 5}));
    EXPECT_GE(countLines(pager.takeMessages(), "is gone"), 1);
}

TEST_F(VirtualPagerFaultTest, aFolderThatChangesIsNotMixedOnceItIsInvalid)
{
    writeFolder(1);
    VirtualPager pager(smallPager(200));
    show(pager, tiles, 0, 0, 0, 5, 5);
    writeFolder(2);
    pager.invalidate(0);
    for (int i = 0; i < 9; ++i)
    {
        pager.report(0, needsOf(grid, 0, 0, i, i, 5, 5));
        pager.advance(++frame);
        model.apply(pager.takeUploads(0, 1000));
        EXPECT_EQ(model.versions(0, grid).size(), 1u) << i;
        pager.waitForLoads(0.002);
    }
    settle(pager, model, frame);
    EXPECT_EQ(model.versions(0, grid), std::set<int>{2});
}

TEST_F(VirtualPagerFaultTest, aStoreThatIsNotThereIsRefusedWithItsName)
{
    VirtualPager pager(smallPager(10));
    try
    {
        pager.addTexture(folder.file("nowhere.tiles"));
        FAIL();
    }
    catch (const TileStoreError& error)
    {
        EXPECT_NE(std::string(error.what()).find("nowhere.tiles"), std::string::npos);
    }
}

} // namespace osgPagedTexture
