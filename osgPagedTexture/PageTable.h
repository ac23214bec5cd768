// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/VirtualPages.h>

#include <cstdint>
#include <vector>

namespace osgPagedTexture
{

/// Where the levels of a page table lie in one two-dimensional array: the finest one at the origin,
/// the coarser ones in a column at its right.
///
///     +-----------+------+
///     | finest    | +1   |
///     |           +---+--+
///     |           |+2 |
///     +-----------+---+
struct PageTableLayout
{
    struct Level
    {
        int x = 0; ///< Of its page 0, 0 in the array.
        int y = 0;
        int columns = 0;
        int rows = 0;
    };
    int width = 0; ///< Entries in a row of the array.
    int height = 0;
    int finest = 0;            ///< Pages of finer levels have the entry of their ancestor here.
    std::vector<Level> levels; ///< levels[i] is level finest + i; the last one is a single page.

    int coarsest() const { return finest + int(levels.size()) - 1; }
    const Level& at(int level) const { return levels[std::size_t(level - finest)]; }
};

/// Entries of a page table's array that have changed.
struct TableRect
{
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;
};

/// Says for each page of a texture, on all levels, where its content is: its own slot, or that of
/// the nearest coarser page that is there. It has no more levels than what is there needs. Not for
/// several threads at once.
class OSGPAGEDTEXTURE_EXPORT PageTable
{
public:
    /// A table that has nothing yet, of one entry. `finestAllowed`: no finer level is ever held.
    explicit PageTable(const TileGrid& grid, int finestAllowed = 0);

    /// The page, not finer than the finest allowed, is in the slot from now on. All pages that it
    /// covers, and that had nothing finer, are found there too.
    void map(const PageKey& page, int slot);

    /// The page is no longer in that slot: what it covers is found where its parent is. Does
    /// nothing where the page is in another slot.
    void unmap(const PageKey& page, int slot);

    /// Takes all away, and the finer levels with them.
    void clear();

    /// The entry of a page of any level.
    std::uint32_t find(const PageKey& page) const;

    /// Whether the page itself is there.
    bool holds(const PageKey& page) const { return PageEntry::levelOf(find(page)) == page.level; }

    const PageTableLayout& getLayout() const { return _layout; }

    /// layout.width * layout.height entries, by rows.
    const std::vector<std::uint32_t>& getEntries() const { return _entries; }

    /// What has changed since the last call. After a change of the layout it is the whole array.
    std::vector<TableRect> takeChanges();

    /// Grows when the layout changes: the array then has other sides.
    std::uint32_t getLayoutVersion() const { return _layoutVersion; }

private:
    void arrange(int finest);
    void deepen(int finest);
    template <class Change> void forCovered(const PageKey& page, const Change& change);
    void touch(const TableRect& rect);
    bool contains(const PageKey& page) const;
    std::uint32_t& entryAt(int level, int x, int y);

    TileGrid _grid;
    int _levels;
    int _finestAllowed;
    PageTableLayout _layout;
    std::vector<std::uint32_t> _entries;
    std::vector<TableRect> _changes;
    bool _allChanged = true;
    std::uint32_t _layoutVersion = 0;
};

} // namespace osgPagedTexture
