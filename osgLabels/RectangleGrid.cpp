// SPDX-License-Identifier: MIT
#include <osgLabels/RectangleGrid.h>

#include <algorithm>

namespace osgLabels
{

void RectangleGrid::reset(const glm::vec2& size)
{
    _scale = float(Size) / size;
    _rows.fill(0);
    _heads.fill(None);
    _items.clear();
}

void RectangleGrid::add(const Rectangle& rectangle, std::uint32_t index)
{
    const Cells cells = cellsOf(rectangle);
    const std::uint64_t mask = maskOf(cells);
    for (unsigned int row = cells.low[1]; row <= cells.high[1]; ++row)
    {
        _rows[row] |= mask;
        for (unsigned int column = cells.low[0]; column <= cells.high[0]; ++column)
        {
            std::uint32_t& head = _heads[row * Size + column];
            _items.push_back({rectangle, index, head});
            head = static_cast<std::uint32_t>(_items.size() - 1);
        }
    }
}

RectangleGrid::Cells RectangleGrid::cellsOf(const Rectangle& rectangle) const
{
    // Limited as floats: what is far outside fits no integer.
    const auto cellOf = [](float place)
    { return static_cast<unsigned int>(std::clamp(place, 0.0f, float(Size - 1))); };
    Cells cells;
    for (int axis = 0; axis < 2; ++axis)
    {
        cells.low[axis] = cellOf(rectangle.low[axis] * _scale[axis]);
        cells.high[axis] = cellOf(rectangle.high[axis] * _scale[axis]);
    }
    return cells;
}

} // namespace osgLabels
