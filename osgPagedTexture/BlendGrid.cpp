// SPDX-License-Identifier: MIT
#include <osgPagedTexture/BlendGrid.h>

#include <algorithm>
#include <cmath>

namespace osgPagedTexture
{

CellMap::CellMap(int width, int height, int cellSide)
    : cell(cellSide), columns((width + cellSide - 1) / cellSide),
      rows((height + cellSide - 1) / cellSide), used(std::size_t(columns) * std::size_t(rows))
{
}

void CellMap::add(const Pixels& mask)
{
    for (int y = 0; y < mask.height; ++y)
    {
        const std::uint8_t* row = mask.row(y);
        for (int x = 0; x < mask.width; ++x)
            if (row[x] != 0)
                at(x / cell, y / cell) = 1;
    }
}

glm::ivec2 CellMap::cellAt(const glm::dvec2& place) const
{
    return {std::clamp(int(std::floor(place.x / cell)), 0, columns - 1),
            std::clamp(int(std::floor(place.y / cell)), 0, rows - 1)};
}

CellMap CellMap::coarser() const
{
    CellMap map(columns, rows, 2);
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x)
            map.at(x / 2, y / 2) |= at(x, y);
    map.cell = 2 * cell;
    return map;
}

BlendGrid::BlendGrid(std::vector<CellMap> maps) : _maps(std::move(maps))
{
    for (std::size_t photo = 0; photo < _maps.size(); ++photo)
    {
        const CellMap& map = _maps[photo];
        _numbers.emplace_back(std::size_t(map.columns + 1) * std::size_t(map.rows + 1), -1);
        for (int y = 0; y < map.rows; ++y)
            for (int x = 0; x < map.columns; ++x)
                for (int corner = 0; corner < 4 && map.at(x, y) != 0; ++corner)
                    number(photo, x + corner % 2, y + corner / 2) = 0;
        for (std::int64_t& each : _numbers.back())
            if (each == 0)
                each = static_cast<std::int64_t>(_count++);
    }
}

std::int64_t& BlendGrid::number(std::size_t photo, int x, int y)
{
    return _numbers[photo][std::size_t(y) * std::size_t(_maps[photo].columns + 1) + std::size_t(x)];
}

std::array<std::int64_t, 4> BlendGrid::cornersOf(std::size_t photo, int x, int y) const
{
    auto& grid = const_cast<BlendGrid&>(*this);
    return {grid.number(photo, x, y), grid.number(photo, x + 1, y), grid.number(photo, x, y + 1),
            grid.number(photo, x + 1, y + 1)};
}

bool BlendGrid::find(std::size_t photo, const glm::dvec2& place, CellCorners& corners) const
{
    const CellMap& map = _maps[photo];
    if (map.used.empty())
        return false;
    const glm::ivec2 cell = map.cellAt(place);
    if (map.at(cell.x, cell.y) == 0)
        return false;
    corners.values = cornersOf(photo, cell.x, cell.y);
    const double x = place.x / map.cell - cell.x, y = place.y / map.cell - cell.y;
    corners.shares = {(1.0 - x) * (1.0 - y), x * (1.0 - y), (1.0 - x) * y, x * y};
    return true;
}

std::vector<std::pair<std::int64_t, glm::dvec2>> BlendGrid::placesOf(std::size_t photo) const
{
    const CellMap& map = _maps[photo];
    std::vector<std::pair<std::int64_t, glm::dvec2>> places;
    for (std::size_t i = 0; i < _numbers[photo].size(); ++i)
        if (_numbers[photo][i] >= 0)
            places.emplace_back(_numbers[photo][i],
                                glm::dvec2(double(i % std::size_t(map.columns + 1)) * map.cell,
                                           double(i / std::size_t(map.columns + 1)) * map.cell));
    return places;
}

} // namespace osgPagedTexture
