// SPDX-License-Identifier: MIT
#include <osgPagedTexture/PageTable.h>

#include <algorithm>
#include <utility>

namespace osgPagedTexture
{

namespace
{

constexpr std::size_t MaxRects = 32;
constexpr std::int64_t RectCost = 256; ///< An upload call's, in entries.

std::int64_t areaOf(const TableRect& rect)
{
    return std::int64_t(rect.width) * rect.height;
}

TableRect unite(const TableRect& one, const TableRect& other)
{
    const int x = std::min(one.x, other.x);
    const int y = std::min(one.y, other.y);
    return {x, y, std::max(one.x + one.width, other.x + other.width) - x,
            std::max(one.y + one.height, other.y + other.height) - y};
}

} // namespace

PageTable::PageTable(const TileGrid& grid, int finestAllowed)
    : _grid(grid), _levels(pageLevels(grid)), _finestAllowed(std::min(finestAllowed, _levels - 1))
{
    clear();
}

void PageTable::clear()
{
    arrange(_levels - 1);
    _entries.assign(1, PageEntry::Empty);
}

void PageTable::arrange(int finest)
{
    _layout = {};
    _layout.finest = finest;
    int right = 0;
    int below = 0;
    for (int level = finest; level < _levels; ++level)
    {
        PageTableLayout::Level place{right, below, int(_grid.getColumns(level)),
                                     int(_grid.getRows(level))};
        _layout.levels.push_back(place);
        _layout.width = std::max(_layout.width, place.x + place.columns);
        _layout.height = std::max(_layout.height, place.y + place.rows);
        right = _layout.levels.front().columns;
        below = level == finest ? 0 : below + place.rows;
    }
    ++_layoutVersion;
    _allChanged = true;
    _changes.clear();
}

void PageTable::deepen(int finest)
{
    const PageTableLayout before = _layout;
    const std::vector<std::uint32_t> old = std::move(_entries);
    arrange(finest);
    _entries.assign(std::size_t(_layout.width) * _layout.height, PageEntry::Empty);
    for (int level = _layout.coarsest(); level >= finest; --level)
    {
        const PageTableLayout::Level& place = _layout.at(level);
        for (int y = 0; y < place.rows; ++y)
        {
            std::uint32_t* row = &entryAt(level, 0, y);
            if (level >= before.finest)
            {
                const PageTableLayout::Level& from = before.at(level);
                const auto first = std::size_t(from.y + y) * before.width + from.x;
                std::copy_n(old.data() + first, place.columns, row);
                continue;
            }
            const std::uint32_t* parents = &entryAt(level + 1, 0, y / 2);
            for (int x = 0; x < place.columns; ++x)
            {
                row[x] = parents[x / 2];
            }
        }
    }
}

bool PageTable::contains(const PageKey& page) const
{
    return page.level >= 0 && page.level < _levels && page.x >= 0 && page.y >= 0 &&
           page.x < _grid.getColumns(page.level) && page.y < _grid.getRows(page.level);
}

std::uint32_t& PageTable::entryAt(int level, int x, int y)
{
    const PageTableLayout::Level& place = _layout.at(level);
    return _entries[std::size_t(place.y + y) * _layout.width + place.x + x];
}

/// Calls change(entry) for the page and all that it covers.
template <class Change> void PageTable::forCovered(const PageKey& page, const Change& change)
{
    for (int level = page.level; level >= _layout.finest; --level)
    {
        const PageTableLayout::Level& place = _layout.at(level);
        const int finer = page.level - level;
        const int left = page.x << finer;
        const int top = page.y << finer;
        const int right = std::min((page.x + 1) << finer, place.columns);
        const int bottom = std::min((page.y + 1) << finer, place.rows);
        for (int y = top; y < bottom; ++y)
        {
            std::uint32_t* row = &entryAt(level, 0, y);
            std::for_each(row + left, row + right, change);
        }
        touch({place.x + left, place.y + top, right - left, bottom - top});
    }
}

void PageTable::map(const PageKey& page, int slot)
{
    if (!contains(page) || page.level < _finestAllowed)
    {
        return;
    }
    if (page.level < _layout.finest)
    {
        deepen(page.level);
    }
    const std::uint32_t entry = PageEntry::pack(slot, page.level);
    forCovered(page,
               [&](std::uint32_t& old)
               {
                   if (PageEntry::levelOf(old) >= page.level)
                   {
                       old = entry;
                   }
               });
}

void PageTable::unmap(const PageKey& page, int slot)
{
    const std::uint32_t entry = PageEntry::pack(slot, page.level);
    if (!contains(page) || find(page) != entry)
    {
        return;
    }
    const std::uint32_t parent =
        page.level + 1 < _levels ? find(page.ancestor()) : PageEntry::Empty;
    forCovered(page,
               [&](std::uint32_t& old)
               {
                   if (old == entry)
                   {
                       old = parent;
                   }
               });
}

std::uint32_t PageTable::find(const PageKey& page) const
{
    if (!contains(page))
    {
        return PageEntry::Empty;
    }
    const PageKey held = page.ancestor(std::max(0, _layout.finest - page.level));
    const PageTableLayout::Level& place = _layout.at(held.level);
    return _entries[std::size_t(place.y + held.y) * _layout.width + place.x + held.x];
}

void PageTable::touch(const TableRect& rect)
{
    if (_allChanged)
    {
        return;
    }
    for (TableRect& change : _changes)
    {
        const TableRect both = unite(change, rect);
        if (areaOf(both) <= areaOf(change) + areaOf(rect) + RectCost)
        {
            change = both;
            return;
        }
    }
    _changes.push_back(rect);
    if (_changes.size() > MaxRects)
    {
        for (const TableRect& change : _changes)
        {
            _changes.front() = unite(_changes.front(), change);
        }
        _changes.resize(1);
    }
}

std::vector<TableRect> PageTable::takeChanges()
{
    if (_allChanged)
    {
        _allChanged = false;
        _changes.clear();
        return {{0, 0, _layout.width, _layout.height}};
    }
    return std::exchange(_changes, {});
}

} // namespace osgPagedTexture
