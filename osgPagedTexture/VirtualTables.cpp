// SPDX-License-Identifier: MIT
#include <osgPagedTexture/VirtualTables.h>

#include <osg/State>

#include <algorithm>
#include <cstring>

namespace osgPagedTexture
{

namespace
{

constexpr int leastWidth = 256; ///< Holds the header of a texture, and slots in few rows.
constexpr float longAgo = -1e9f;

int roundUp(int value, int step)
{
    return (value + step - 1) / step * step;
}

std::uint32_t bitsOf(float value)
{
    std::uint32_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    return bits;
}

} // namespace

VirtualTables::VirtualTables(int slots) : _slots(slots), _times(std::size_t(slots), longAgo) {}

void VirtualTables::add(std::uint32_t texture, const TileGrid& grid)
{
    _tables[texture].grid = grid;
    _isArranged = false;
}

void VirtualTables::apply(const TablePatch& patch)
{
    const auto found = _tables.find(patch.texture);
    if (found == _tables.end())
        return;
    Table& table = found->second;
    if (patch.layout && (!table.layout || table.layout->width != patch.layout->width ||
                         table.layout->height != patch.layout->height))
        _isArranged = false;
    if (patch.layout)
        table.layout = patch.layout;
    if (!_isArranged)
        arrange();
    if (patch.layout)
        writeHeader(patch.texture, table);
    for (int y = 0; y < patch.rect.height; ++y)
        std::copy_n(patch.entries.data() + std::size_t(y) * std::size_t(patch.rect.width),
                    patch.rect.width, rowAt(table.row + patch.rect.y + y) + patch.rect.x);
    touch(table.row + patch.rect.y, patch.rect.height);
}

int VirtualTables::finestOf(std::uint32_t texture) const
{
    const Table& table = _tables.at(texture);
    return table.layout ? table.layout->finest : pageLevels(table.grid) - 1;
}

std::uint32_t VirtualTables::coarsestOf(std::uint32_t texture) const
{
    const auto found = _tables.find(texture);
    if (found == _tables.end() || !found->second.layout || !_isArranged)
        return PageEntry::Empty;
    const PageTableLayout::Level& last = found->second.layout->levels.back();
    const int row = found->second.row + last.y;
    return _words[std::size_t(row) * std::size_t(_width) + std::size_t(last.x)];
}

void VirtualTables::setTime(int slot, float seconds)
{
    _times[std::size_t(slot)] = seconds;
    if (!_isArranged)
        return;
    const int row = _timeRow + slot / _width;
    rowAt(row)[slot % _width] = bitsOf(seconds);
    touch(row, 1);
}

/// Gives each table its rows, and keeps what it holds.
void VirtualTables::arrange()
{
    const int oldWidth = _width;
    const std::vector<std::uint32_t> old = std::move(_words);
    std::map<std::uint32_t, int> oldRows;
    _width = leastWidth;
    int rows = 0;
    for (const auto& [number, table] : _tables)
    {
        oldRows[number] = table.row;
        _width = std::max(_width, table.layout ? table.layout->width : 0);
        rows = std::max(rows, int(number) + 1);
    }
    _timeRow = roundUp(rows, 16);
    rows = _timeRow + (_slots + _width - 1) / _width;
    for (auto& [number, table] : _tables)
    {
        table.row = rows;
        rows += table.layout ? table.layout->height : 0;
    }
    _height = roundUp(rows, 64);
    _words.assign(std::size_t(_width) * std::size_t(_height), PageEntry::Empty);
    for (auto& [number, table] : _tables)
    {
        writeHeader(number, table);
        const int height = table.layout && oldRows[number] ? table.layout->height : 0;
        for (int y = 0; y < height; ++y)
        {
            const std::size_t from = std::size_t(oldRows[number] + y) * std::size_t(oldWidth);
            const int width = std::min(table.layout->width, oldWidth);
            if (from + std::size_t(width) <= old.size())
                std::copy_n(old.data() + from, width, rowAt(table.row + y));
        }
    }
    for (int slot = 0; slot < _slots; ++slot)
        rowAt(_timeRow + slot / _width)[slot % _width] = bitsOf(_times[std::size_t(slot)]);
    _isArranged = true;
    touch(0, _height);
}

void VirtualTables::writeHeader(std::uint32_t number, const Table& table)
{
    std::uint32_t* header = rowAt(int(number));
    // Before anything is known, a level whose only entry is one of the row's own, which is Empty.
    static const PageTableLayout nothing{
        1, 1, 0, {PageTableLayout::Level{leastWidth - 1, 0, 1, 1}}};
    PageTableLayout layout = table.layout ? *table.layout : nothing;
    const int row = table.layout ? table.row : int(number);
    if (!table.layout)
        layout.finest = pageLevels(table.grid) - 1;
    header[0] = std::uint32_t(table.grid.getWidth());
    header[1] = std::uint32_t(table.grid.getHeight());
    header[2] = std::uint32_t(table.grid.getPayload()) | std::uint32_t(table.grid.getBorder())
                                                             << 24;
    header[3] = std::uint32_t(layout.finest) | std::uint32_t(layout.coarsest()) << 8;
    for (std::size_t i = 0; i < layout.levels.size(); ++i)
        header[4 + i] = std::uint32_t(layout.levels[i].x) | std::uint32_t(layout.levels[i].y + row)
                                                                << 16;
    touch(int(number), 1);
}

void VirtualTables::touch(int row, int rows)
{
    if (_lastTouched < _firstTouched)
    {
        _firstTouched = row;
        _lastTouched = row + rows - 1;
        return;
    }
    _firstTouched = std::min(_firstTouched, row);
    _lastTouched = std::max(_lastTouched, row + rows - 1);
}

void VirtualTables::upload(osg::State& state)
{
    if (!_isArranged)
        arrange();
    if (!_texture || _texture->getTextureWidth() != _width ||
        _texture->getTextureHeight() != _height)
    {
        constexpr GLenum r32ui = 0x8236, redInteger = 0x8D94;
        _texture =
            new UploadTexture({r32ui, redInteger, GL_UNSIGNED_INT, false, false}, _width, _height);
        touch(0, _height);
    }
    if (_lastTouched < _firstTouched)
        return;
    const int rows = _lastTouched - _firstTouched + 1;
    _texture->upload(state, 0, _firstTouched, _width, rows, rowAt(_firstTouched),
                     std::size_t(rows) * std::size_t(_width) * 4);
    _firstTouched = 0;
    _lastTouched = -1;
}

} // namespace osgPagedTexture
