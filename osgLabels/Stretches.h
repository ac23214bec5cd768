// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace osgLabels
{

/// Pairs of numbers that grow together, kept as the stretches in which both grow by one: few, where
/// most numbers have a partner. Look-ups take logarithmic time.
class Stretches
{
public:
    /// Both numbers are greater than any before.
    void add(std::uint32_t left, std::uint32_t right)
    {
        if (!_all.empty() && left == _all.back().left + _all.back().count &&
            right == _all.back().right + _all.back().count)
            ++_all.back().count;
        else
            _all.push_back({left, right, 1});
    }
    void clear() { _all.clear(); }

    /// The partner of a number, if it has one.
    std::optional<std::uint32_t> rightOf(std::uint32_t left) const
    {
        const Stretch* stretch = find(left, &Stretch::left);
        return stretch ? std::make_optional(stretch->right + (left - stretch->left)) : std::nullopt;
    }
    std::optional<std::uint32_t> leftOf(std::uint32_t right) const
    {
        const Stretch* stretch = find(right, &Stretch::right);
        return stretch ? std::make_optional(stretch->left + (right - stretch->right))
                       : std::nullopt;
    }
    /// How many numbers from `left` on have partners that follow each other; 0 where it has none.
    std::uint32_t countFrom(std::uint32_t left) const
    {
        const Stretch* stretch = find(left, &Stretch::left);
        return stretch ? stretch->count - (left - stretch->left) : 0;
    }

    std::size_t size() const { return _all.size(); }

private:
    struct Stretch
    {
        std::uint32_t left, right, count;
    };

    const Stretch* find(std::uint32_t number, std::uint32_t Stretch::*side) const
    {
        const auto after =
            std::upper_bound(_all.begin(), _all.end(), number,
                             [side](std::uint32_t n, const Stretch& s) { return n < s.*side; });
        if (after == _all.begin() || number - after[-1].*side >= after[-1].count)
            return nullptr;
        return &after[-1];
    }

    std::vector<Stretch> _all;
};

} // namespace osgLabels
