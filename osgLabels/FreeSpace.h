// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace osgLabels
{

/// The holes of a range of units: taken by best fit, joined with their neighbours when given back.
class FreeSpace
{
public:
    /// The first unit of a hole cut to `size`; none where no hole is that large.
    std::optional<std::uint32_t> take(std::uint32_t size)
    {
        const auto best = _bySize.lower_bound({size, 0});
        if (best == _bySize.end())
            return std::nullopt;
        const auto [found, at] = *best;
        erase(_byOffset.find(at));
        if (found > size)
            insert(at + size, found - size);
        return at;
    }

    /// Makes [at, at + size), which must be in use, a hole.
    void give(std::uint32_t at, std::uint32_t size)
    {
        auto next = _byOffset.lower_bound(at);
        if (next != _byOffset.begin())
        {
            const auto before = std::prev(next);
            if (before->first + before->second == at)
            {
                at = before->first;
                size += before->second;
                erase(before);
            }
        }
        if (next != _byOffset.end() && at + size == next->first)
        {
            size += next->second;
            erase(next);
        }
        insert(at, size);
    }

    void clear()
    {
        _byOffset.clear();
        _bySize.clear();
        _total = 0;
    }

    std::uint64_t getTotal() const { return _total; }
    std::size_t getCount() const { return _byOffset.size(); }

private:
    using Holes = std::map<std::uint32_t, std::uint32_t>;

    void insert(std::uint32_t at, std::uint32_t size)
    {
        _byOffset.emplace(at, size);
        _bySize.emplace(size, at);
        _total += size;
    }
    void erase(Holes::iterator hole)
    {
        _bySize.erase({hole->second, hole->first});
        _total -= hole->second;
        _byOffset.erase(hole);
    }

    Holes _byOffset;
    std::set<std::pair<std::uint32_t, std::uint32_t>> _bySize;
    std::uint64_t _total = 0;
};

} // namespace osgLabels
