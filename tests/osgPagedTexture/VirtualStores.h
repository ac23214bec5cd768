// SPDX-License-Identifier: MIT
// Stores whose tiles say which they are by their colour, and a physical texture with page tables as
// a graphics context would have it, whose content can be checked.
#pragma once

#include <osgPagedTexture/TilePack.h>
#include <osgPagedTexture/VirtualPager.h>
#include <support/TemporaryFolder.h>

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>
#include <vector>

namespace osgPagedTexture
{

/// Level, x, y and version of up to 256 pages a side.
inline TileColor colorOf(const PageKey& page, int version)
{
    return {std::uint8_t(page.level * 16 + version), std::uint8_t(page.x), std::uint8_t(page.y),
            std::uint8_t(255 - page.texture)};
}

struct ColorStore
{
    std::int64_t width = 300;
    std::int64_t height = 200;
    int side = 10;
    int border = 1;
    std::uint32_t texture = 0;

    TileStoreSettings settings() const
    {
        TileStoreSettings settings;
        settings.grid = TileGrid(width, height, side, border);
        settings.format = "png";
        return settings;
    }

    /// Puts all tiles, or those that show some pixels of level 0.
    void put(TileWriter& writer, int version, const PixelRect* changed = nullptr) const
    {
        const TileGrid grid = settings().grid;
        for (int level = 0; level < grid.getLevels(); ++level)
        {
            for (int y = 0; y < grid.getRows(level); ++y)
            {
                for (int x = 0; x < grid.getColumns(level); ++x)
                {
                    const PageKey page{texture, level, x, y};
                    if (!changed || touches(grid, page, *changed))
                    {
                        writer.put(page.tile(), TileData::uniform(colorOf(page, version)));
                    }
                }
            }
        }
    }

    void build(const std::string& path, int version) const
    {
        TilePackWriter::Options options;
        options.durable = false;
        TilePackWriter writer(path, settings(), options);
        put(writer, version);
        writer.commit();
    }

    void update(const std::string& path, int version, const PixelRect* changed = nullptr) const
    {
        TilePackWriter::Options options;
        options.durable = false;
        TilePackWriter writer(path, options);
        put(writer, version, changed);
        writer.commit();
    }
};

/// What a graphics context has after it has done what it was told.
class ContextModel
{
public:
    void apply(const PageUploads& uploads)
    {
        for (const PageUpload& upload : uploads.pages)
        {
            TileColor& color = _slots[upload.slot];
            std::copy_n(upload.texels->begin(), color.size(), color.begin());
        }
        for (const TablePatch& patch : uploads.tables)
        {
            Table& table = _tables[patch.texture];
            if (patch.layout)
            {
                table.layout = *patch.layout;
                table.entries.assign(std::size_t(table.layout.width) * table.layout.height,
                                     0xDEADBEEF);
            }
            for (int y = 0; y < patch.rect.height; ++y)
            {
                for (int x = 0; x < patch.rect.width; ++x)
                {
                    table.entries.at(std::size_t(patch.rect.y + y) * table.layout.width +
                                     patch.rect.x + x) =
                        patch.entries.at(std::size_t(y) * patch.rect.width + x);
                }
            }
        }
    }

    std::uint32_t entryOf(const PageKey& page) const
    {
        const Table& table = _tables.at(page.texture);
        const PageKey held = page.ancestor(std::max(0, table.layout.finest - page.level));
        const PageTableLayout::Level& place = table.layout.at(held.level);
        return table.entries.at(std::size_t(place.y + held.y) * table.layout.width + place.x +
                                held.x);
    }

    /// Looks at what the tables say of each page of a texture. Returns the versions that are shown
    /// of pages that have any of the pixels of level 0, or of all.
    std::set<int> versions(std::uint32_t texture, const TileGrid& grid,
                           const PixelRect* changed = nullptr) const
    {
        std::set<int> found;
        for (int level = 0; level < pageLevels(grid); ++level)
        {
            for (int y = 0; y < grid.getRows(level); ++y)
            {
                for (int x = 0; x < grid.getColumns(level); ++x)
                {
                    const PageKey page{texture, level, x, y};
                    const std::uint32_t entry = entryOf(page);
                    if (entry == PageEntry::Empty)
                    {
                        continue;
                    }
                    const PageKey there = page.ancestor(PageEntry::levelOf(entry) - level);
                    const TileColor color = _slots.at(PageEntry::slotOf(entry));
                    const int version = color[0] % 16;
                    EXPECT_EQ(color, colorOf(there, version))
                        << "page " << x << ", " << y << " of level " << level;
                    if (!changed || touches(grid, there, *changed))
                    {
                        found.insert(version);
                    }
                }
            }
        }
        return found;
    }

    bool holds(const PageKey& page) const
    {
        return PageEntry::levelOf(entryOf(page)) == page.level;
    }

    const PageTableLayout& getLayout(std::uint32_t texture) const
    {
        return _tables.at(texture).layout;
    }

private:
    struct Table
    {
        PageTableLayout layout;
        std::vector<std::uint32_t> entries;
    };
    std::map<int, TileColor> _slots;
    std::map<std::uint32_t, Table> _tables;
};

/// Frames of one context until the pager is at rest; the number of frames.
inline int settle(VirtualPager& pager, ContextModel& model, unsigned int& frame,
                  std::uint64_t uploadBytes = std::uint64_t(1) << 20, int maxFrames = 20000)
{
    for (int i = 1; i <= maxFrames; ++i)
    {
        pager.advance(++frame);
        model.apply(pager.takeUploads(0, uploadBytes));
        if (pager.isAtRest())
        {
            return i;
        }
        pager.waitForLoads(0.01);
    }
    ADD_FAILURE() << "not at rest after " << maxFrames << " frames";
    return maxFrames;
}

/// The pages of a level in a rectangle of pages.
inline std::vector<PageNeed> needsOf(const TileGrid& grid, std::uint32_t texture, int level, int x,
                                     int y, int columns, int rows)
{
    std::vector<PageNeed> needs;
    for (int row = y; row < y + rows && row < grid.getRows(level); ++row)
    {
        for (int column = x; column < x + columns && column < grid.getColumns(level); ++column)
        {
            needs.push_back({{texture, level, column, row}, 10});
        }
    }
    return needs;
}

inline VirtualPagerSettings smallPager(int slots)
{
    VirtualPagerSettings settings;
    settings.slots = slots;
    settings.format = BlockFormat::RGBA8;
    settings.threads = 2;
    settings.watchSeconds = 0.0;
    return settings;
}

/// A store of one version.
struct StoreTest : testing::Test
{
    StoreTest() { source.build(store, 1); }

    support::TemporaryFolder folder;
    ColorStore source;
    TileGrid grid = source.settings().grid;
    const std::string store = folder.file("store.tiles");
    const std::uint64_t pageBytes = 400;
};

/// And a context that shows it.
struct PagerTest : StoreTest
{
    /// Frames until a rectangle of pages of a level of a pager's first texture, of `path`, is
    /// there.
    void show(VirtualPager& pager, const std::string& path, int level, int x, int y, int columns,
              int rows)
    {
        pager.addTexture(path);
        pager.report(0, needsOf(grid, 0, level, x, y, columns, rows));
        settle(pager, model, frame);
    }

    ContextModel model;
    unsigned int frame = 0;
};

} // namespace osgPagedTexture
