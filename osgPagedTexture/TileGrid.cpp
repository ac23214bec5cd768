// SPDX-License-Identifier: MIT
#include <osgPagedTexture/TileGrid.h>

#include <osgPagedTexture/TileStore.h>

#include <algorithm>

namespace osgPagedTexture
{

namespace
{

constexpr int MaxPayload = 65536;
constexpr std::int64_t MaxColumns = std::int64_t(1) << 29; // what the keys of a packed store hold

std::int64_t levelSide64(std::int64_t side, int level)
{
    return (side + (std::int64_t(1) << level) - 1) >> level;
}

std::int64_t divideUp(std::int64_t value, std::int64_t divisor)
{
    return (value + divisor - 1) / divisor;
}

std::int64_t divideDown(std::int64_t value, std::int64_t divisor)
{
    return value >= 0 ? value / divisor : -divideUp(-value, divisor);
}

[[noreturn]] void refuse(const std::string& what)
{
    throw TileStoreError(TileStoreError::Kind::Refused, "osgPagedTexture::TileGrid: " + what);
}

void checkShape(std::int64_t width, std::int64_t height, int tileSide, int border)
{
    if (width < 1 || height < 1 || width > TileGrid::MaxSide || height > TileGrid::MaxSide)
    {
        refuse("a picture of " + std::to_string(width) + " x " + std::to_string(height) +
               " pixels cannot be tiled; its sides must be in 1..2^40");
    }
    const std::int64_t payload = std::int64_t(tileSide) - 2 * std::int64_t(border);
    if (border < 0 || payload < 1 || payload > MaxPayload || border > MaxPayload)
    {
        refuse("tiles of " + std::to_string(tileSide) + " pixels with a border of " +
               std::to_string(border) +
               " have no room; make the tiles larger or the border smaller");
    }
    if (divideUp(std::max(width, height), payload) > MaxColumns)
    {
        refuse("a picture of " + std::to_string(width) + " x " + std::to_string(height) +
               " pixels has more than 2^29 tiles in a row; make the tiles larger");
    }
}

int levelsDownTo(std::int64_t last, std::int64_t width, std::int64_t height)
{
    int level = 0;
    while (levelSide64(std::max(width, height), level) > last)
    {
        ++level;
    }
    return level + 1;
}

} // namespace

TileGrid::TileGrid(std::int64_t width, std::int64_t height, int tileSide, int border, Edge edge)
    : _width(width), _height(height), _payload(0), _border(border), _edge(edge), _levels(1)
{
    checkShape(width, height, tileSide, border);
    _payload = tileSide - 2 * border;
    _levels = levelsDownTo(edge == Edge::Padded ? _payload : 1, width, height);
}

std::int64_t TileGrid::getWidth(int level) const
{
    return levelSide64(_width, level);
}

std::int64_t TileGrid::getHeight(int level) const
{
    return levelSide64(_height, level);
}

std::int64_t TileGrid::getColumns(int level) const
{
    return divideUp(getWidth(level), _payload);
}

std::int64_t TileGrid::getRows(int level) const
{
    return divideUp(getHeight(level), _payload);
}

std::uint64_t TileGrid::getTileCount(int level) const
{
    return std::uint64_t(getColumns(level)) * std::uint64_t(getRows(level));
}

std::uint64_t TileGrid::getTileCount() const
{
    std::uint64_t tiles = 0;
    for (int level = 0; level < _levels; ++level)
    {
        tiles += getTileCount(level);
    }
    return tiles;
}

bool TileGrid::contains(const TileKey& key) const
{
    return key.level >= 0 && key.level < _levels && key.x >= 0 && key.y >= 0 &&
           key.x < getColumns(key.level) && key.y < getRows(key.level);
}

PixelRect TileGrid::getPixels(const TileKey& key) const
{
    const std::int64_t left = key.x * _payload - _border;
    const std::int64_t top = key.y * _payload - _border;
    if (_edge == Edge::Padded)
    {
        return {left, top, getTileSide(), getTileSide()};
    }
    const std::int64_t x = std::max<std::int64_t>(left, 0);
    const std::int64_t y = std::max<std::int64_t>(top, 0);
    return {x, y, std::min(left + getTileSide(), getWidth(key.level)) - x,
            std::min(top + getTileSide(), getHeight(key.level)) - y};
}

PixelRect TileGrid::getPayloadPixels(const TileKey& key) const
{
    const std::int64_t x = key.x * _payload;
    const std::int64_t y = key.y * _payload;
    return {x, y, std::min<std::int64_t>(_payload, getWidth(key.level) - x),
            std::min<std::int64_t>(_payload, getHeight(key.level) - y)};
}

TileRange TileGrid::getTouched(const PixelRect& pixels, int level) const
{
    const std::int64_t left = std::max<std::int64_t>(pixels.x, 0);
    const std::int64_t top = std::max<std::int64_t>(pixels.y, 0);
    const std::int64_t right = std::min(pixels.x + pixels.width, _width);
    const std::int64_t bottom = std::min(pixels.y + pixels.height, _height);
    TileRange range{level, 0, 0, -1, -1};
    if (left < right && top < bottom)
    {
        const auto first = [&](std::int64_t pixel)
        { return std::max<std::int64_t>(divideDown((pixel >> level) - _border, _payload), 0); };
        const auto last = [&](std::int64_t end, std::int64_t count)
        { return std::min((((end - 1) >> level) + _border) / _payload, count - 1); };
        range.x = first(left);
        range.y = first(top);
        range.lastX = last(right, getColumns(level));
        range.lastY = last(bottom, getRows(level));
    }
    return range;
}

std::int64_t TileGrid::getStep(const TileRow& row) const
{
    const std::int64_t bottom = std::min((row.y + 1) * _payload + _border, getHeight(row.level));
    return (std::min(bottom << row.level, _height) - 1) / _payload;
}

std::vector<TileRow> TileGrid::getRowsFinishedAt(std::int64_t step) const
{
    std::vector<TileRow> rows;
    for (int level = 0; level < _levels; ++level)
    {
        // Steps grow with y: halve the rows down to the first that is not finished earlier.
        std::int64_t first = 0;
        for (std::int64_t end = getRows(level); first < end;)
        {
            const std::int64_t middle = (first + end) / 2;
            getStep({level, middle}) < step ? void(first = middle + 1) : void(end = middle);
        }
        for (; first < getRows(level) && getStep({level, first}) == step; ++first)
        {
            rows.push_back({level, first});
        }
    }
    return rows;
}

bool TileGrid::operator==(const TileGrid& other) const
{
    return _width == other._width && _height == other._height && _payload == other._payload &&
           _border == other._border && _edge == other._edge;
}

} // namespace osgPagedTexture
