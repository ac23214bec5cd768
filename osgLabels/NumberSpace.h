// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/FreeSpace.h>

#include <mutex>

namespace osgLabels
{

/// Numbers from 1 on that several owners share. Thread safe.
class NumberSpace
{
public:
    /// The first of `count` numbers that follow each other.
    std::uint32_t take(std::uint32_t count)
    {
        std::lock_guard<std::mutex> lock(_mutex);
        if (const auto hole = _free.take(count))
            return *hole;
        return extend(count);
    }
    /// One that is greater than all before.
    std::uint32_t takeNext()
    {
        std::lock_guard<std::mutex> lock(_mutex);
        return extend(1);
    }
    void give(std::uint32_t first, std::uint32_t count)
    {
        std::lock_guard<std::mutex> lock(_mutex);
        if (first + count == _end)
            _end = first;
        else if (count)
            _free.give(first, count);
    }
    /// All numbers are under it.
    std::uint32_t getEnd() const
    {
        std::lock_guard<std::mutex> lock(_mutex);
        return _end;
    }

private:
    std::uint32_t extend(std::uint32_t count)
    {
        const std::uint32_t first = _end;
        _end += count;
        return first;
    }

    mutable std::mutex _mutex;
    FreeSpace _free;
    std::uint32_t _end = 1;
};

} // namespace osgLabels
