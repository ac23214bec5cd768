// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

namespace osgPagedTexture
{

/// The last rows of a level that a walk down the picture has made, within some columns of it.
class LevelRows
{
public:
    /// Columns x to x + width - 1, rows from y on; the last `capacity` of them are held.
    LevelRows(std::int64_t x, std::int64_t width, std::int64_t y, std::int64_t capacity,
              int channels)
        : _x(x), _width(width), _end(y), _capacity(capacity), _channels(channels),
          _bytes(allocate(std::size_t(width) * std::size_t(capacity) * std::size_t(channels)))
    {
    }

    std::int64_t getX() const { return _x; }
    std::int64_t getWidth() const { return _width; }
    int getChannels() const { return _channels; }

    /// The first row that is not made yet.
    std::int64_t getEnd() const { return _end; }
    void setEnd(std::int64_t end) { _end = end; }

    std::uint8_t* row(std::int64_t y)
    {
        return _bytes.get() + std::size_t(y % _capacity) * rowBytes();
    }
    const std::uint8_t* row(std::int64_t y) const
    {
        return _bytes.get() + std::size_t(y % _capacity) * rowBytes();
    }
    /// The pixel in column `x` of the level.
    std::uint8_t* at(std::int64_t x, std::int64_t y)
    {
        return row(y) + std::size_t(x - _x) * _channels;
    }
    const std::uint8_t* at(std::int64_t x, std::int64_t y) const
    {
        return row(y) + std::size_t(x - _x) * _channels;
    }

private:
    using Bytes = std::unique_ptr<std::uint8_t[], void (*)(void*)>;

    /// Not zeroed, which one thread would do for all; in large pages of memory, since each row of a
    /// tile lies in another small one.
    static Bytes allocate(std::size_t count);

    std::size_t rowBytes() const { return std::size_t(_width) * std::size_t(_channels); }

    std::int64_t _x, _width, _end, _capacity;
    int _channels;
    Bytes _bytes;
};

} // namespace osgPagedTexture
