// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace osgLabels
{

/// Millions of short texts: one block of characters and four bytes a text.
class NameList
{
public:
    /// Appends a text; false, and an empty text instead, where the block would pass 4 GiB.
    bool add(std::string_view text)
    {
        const bool fits = _text.size() + text.size() <= std::numeric_limits<std::uint32_t>::max();
        if (fits)
            _text.append(text);
        _ends.push_back(std::uint32_t(_text.size()));
        return fits;
    }

    std::string_view operator[](std::size_t i) const
    {
        const std::uint32_t from = i ? _ends[i - 1] : 0;
        return std::string_view(_text).substr(from, _ends[i] - from);
    }

    std::size_t size() const { return _ends.size(); }
    void reserve(std::size_t texts, std::size_t bytes)
    {
        _ends.reserve(texts);
        _text.reserve(bytes);
    }
    std::size_t bytes() const
    {
        return _text.capacity() + _ends.capacity() * sizeof(std::uint32_t);
    }

    /// The whole block, and where each text ends in it.
    const std::string& block() const { return _text; }
    const std::vector<std::uint32_t>& ends() const { return _ends; }

    /// Takes both; false, and an empty list, where they don't fit each other.
    bool assign(std::string block, std::vector<std::uint32_t> ends)
    {
        bool fits = ends.empty() ? block.empty() : ends.back() == block.size();
        for (std::size_t i = 1; i < ends.size(); ++i)
            fits = fits && ends[i - 1] <= ends[i];
        _text = fits ? std::move(block) : std::string();
        _ends = fits ? std::move(ends) : std::vector<std::uint32_t>();
        return fits;
    }

private:
    std::string _text;
    std::vector<std::uint32_t> _ends;
};

} // namespace osgLabels
