// SPDX-License-Identifier: MIT
#include <osgPagedTexture/PlaceWelder.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <cmath>
#include <cstring>

namespace osgPagedTexture
{

std::size_t PlaceWelder::Hash::operator()(const Cell& cell) const
{
    std::uint64_t hash = 0;
    for (const std::int64_t number : {cell.x, cell.y, cell.z})
    {
        hash = (hash ^ static_cast<std::uint64_t>(number)) * 0x9E3779B97F4A7C15u;
        hash ^= hash >> 32;
    }
    return static_cast<std::size_t>(hash);
}

PlaceWelder::Cell PlaceWelder::cellOf(const glm::dvec3& place) const
{
    if (_cell > 0.0)
    {
        const glm::dvec3 cell = glm::clamp(glm::floor(place / _cell), -9e18, 9e18);
        return {std::int64_t(cell.x), std::int64_t(cell.y), std::int64_t(cell.z)};
    }
    Cell bits;
    const glm::dvec3 positive = place + 0.0; // -0 is 0.
    std::memcpy(&bits, &positive, sizeof bits);
    return bits;
}

const std::uint32_t* PlaceWelder::find(const Cell& cell, const glm::dvec3& place) const
{
    const auto found = _cells.find(cell);
    if (found == _cells.end())
        return nullptr;
    for (const std::uint32_t& number : found->second)
        if (glm::distance(_places[number], place) <= _tolerance)
            return &number;
    return nullptr;
}

std::uint32_t PlaceWelder::add(const glm::dvec3& place)
{
    const Cell low = cellOf(place - _tolerance), high = cellOf(place + _tolerance);
    const Cell own = cellOf(place);
    if (const std::uint32_t* number = find(own, place))
        return *number;
    if (_cell > 0.0)
        for (std::int64_t z = low.z; z <= high.z; ++z)
            for (std::int64_t y = low.y; y <= high.y; ++y)
                for (std::int64_t x = low.x; x <= high.x; ++x)
                    if (const std::uint32_t* number = find({x, y, z}, place))
                        return *number;
    const auto number = static_cast<std::uint32_t>(_places.size());
    _places.push_back(place);
    _cells[own].push_back(number);
    return number;
}

} // namespace osgPagedTexture
