// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/Export.h>

#include <glm/vec2.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace osgLabels
{

/// Of the picture, pixels; `low` is below `high` on both axes.
struct Rectangle
{
    glm::vec2 low{0.0f}, high{0.0f};

    /// Edges that touch do not overlap.
    bool overlaps(const Rectangle& other) const
    {
        return low.x < other.high.x && other.low.x < high.x && low.y < other.high.y &&
               other.low.y < high.y;
    }
};

/// Rectangles by place: 64 x 64 cells over a picture, so that a row's occupied cells are one
/// word. A rectangle of the whole picture looks at 64 words.
class OSGLABELS_EXPORT RectangleGrid
{
public:
    /// Forgets all. `size` of the picture in pixels, both above 0.
    void reset(const glm::vec2& size);

    /// `index` is what any() is given. What lies outside of the picture counts for its nearest
    /// cells.
    void add(const Rectangle& rectangle, std::uint32_t index);

    /// Whether `test` is true for the index of any rectangle that overlaps this one. It may be
    /// asked several times for one.
    template <class Test> bool any(const Rectangle& rectangle, Test test) const
    {
        const Cells cells = cellsOf(rectangle);
        const std::uint64_t mask = maskOf(cells);
        for (unsigned int row = cells.low[1]; row <= cells.high[1]; ++row)
        {
            if (!(_rows[row] & mask))
                continue;
            for (unsigned int column = cells.low[0]; column <= cells.high[0]; ++column)
                for (std::uint32_t i = _heads[row * Size + column]; i != None; i = _items[i].next)
                    if (_items[i].rectangle.overlaps(rectangle) && test(_items[i].index))
                        return true;
        }
        return false;
    }

private:
    static constexpr unsigned int Size = 64;
    static constexpr std::uint32_t None = 0xFFFFFFFFu;

    struct Item
    {
        Rectangle rectangle;
        std::uint32_t index, next;
    };
    struct Cells
    {
        unsigned int low[2], high[2];
    };

    Cells cellsOf(const Rectangle& rectangle) const;
    static std::uint64_t maskOf(const Cells& cells)
    {
        return (~std::uint64_t(0) >> (Size - 1 - (cells.high[0] - cells.low[0]))) << cells.low[0];
    }

    glm::vec2 _scale{1.0f}; ///< Cells a pixel.
    std::array<std::uint64_t, Size> _rows{};
    std::array<std::uint32_t, Size * Size> _heads{};
    std::vector<Item> _items;
};

} // namespace osgLabels
