// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/Pixels.h>

#include <glm/vec2.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace osgPagedTexture
{

/// Which cells of a photograph hold something of its mask.
struct CellMap
{
    int cell = 1; ///< Side in pixels.
    int columns = 0, rows = 0;
    std::vector<std::uint8_t> used;

    CellMap() = default;
    CellMap(int width, int height, int cellSide);
    void add(const Pixels& mask);
    /// The cell that a place in pixels from the bottom left corner is in, inside of the map.
    glm::ivec2 cellAt(const glm::dvec2& place) const;
    std::uint8_t& at(int x, int y)
    {
        return used[std::size_t(y) * std::size_t(columns) + std::size_t(x)];
    }
    std::uint8_t at(int x, int y) const { return const_cast<CellMap*>(this)->at(x, y); }

    /// Of cells twice as large.
    CellMap coarser() const;
};

/// Four values around a place, and their shares.
struct CellCorners
{
    std::array<std::int64_t, 4> values{};
    std::array<double, 4> shares{};
};

/// Numbers the corners of all used cells of all photographs.
class BlendGrid
{
public:
    explicit BlendGrid(std::vector<CellMap> maps);

    std::size_t getCount() const { return _count; }
    const std::vector<CellMap>& getMaps() const { return _maps; }
    /// The values at the corners of a used cell: left and right bottom, left and right top.
    std::array<std::int64_t, 4> cornersOf(std::size_t photo, int x, int y) const;
    /// False where the place is in no used cell.
    bool find(std::size_t photo, const glm::dvec2& place, CellCorners& corners) const;
    /// Where each value of a photograph lies, in pixels.
    std::vector<std::pair<std::int64_t, glm::dvec2>> placesOf(std::size_t photo) const;

private:
    std::int64_t& number(std::size_t photo, int x, int y);

    std::vector<CellMap> _maps;
    std::vector<std::vector<std::int64_t>> _numbers; ///< -1: none.
    std::size_t _count = 0;
};

} // namespace osgPagedTexture
