// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace osgLabels
{

/// Which words of a buffer have changed since they were last taken.
///
/// Memory stays bounded however many changes nobody takes: ranges are joined, near ones first.
class DirtyRanges
{
public:
    struct Range
    {
        std::size_t begin = 0, end = 0;
    };

    /// Unchanged words between two ranges that one call may send along: a call costs more.
    static constexpr std::size_t Gap = 16;

    void add(std::size_t begin, std::size_t end)
    {
        if (begin == end)
            return;
        if (!_ranges.empty() && begin >= _ranges.back().begin && begin <= _ranges.back().end)
        {
            _ranges.back().end = std::max(_ranges.back().end, end);
            return;
        }
        _ranges.push_back({begin, end});
        if (_ranges.size() >= Limit)
            for (std::size_t gap = Gap; _ranges.size() > Limit / 2; gap *= 4)
                join(gap);
    }

    /// All ranges, sorted and joined; those that the caller leaves in it are kept.
    std::vector<Range>& joined()
    {
        join(Gap);
        return _ranges;
    }

    void clear() { _ranges.clear(); }
    bool isEmpty() const { return _ranges.empty(); }
    std::size_t getBytes() const { return _ranges.capacity() * sizeof(Range); }

private:
    static constexpr std::size_t Limit = 1 << 16;

    void join(std::size_t gap)
    {
        std::sort(_ranges.begin(), _ranges.end(),
                  [](const Range& a, const Range& b) { return a.begin < b.begin; });
        std::size_t last = 0;
        for (std::size_t i = 1; i < _ranges.size(); ++i)
            if (_ranges[i].begin <= _ranges[last].end + gap)
                _ranges[last].end = std::max(_ranges[last].end, _ranges[i].end);
            else
                _ranges[++last] = _ranges[i];
        if (!_ranges.empty())
            _ranges.resize(last + 1);
    }

    std::vector<Range> _ranges;
};

} // namespace osgLabels
