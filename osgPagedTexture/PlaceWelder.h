// SPDX-License-Identifier: MIT
#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <unordered_map>
#include <vector>

namespace osgPagedTexture
{

/// Gives places numbers; those not farther apart than a tolerance have one. Places are compared
/// with the first one of a number.
class PlaceWelder
{
public:
    explicit PlaceWelder(double tolerance) : _tolerance(tolerance), _cell(4.0 * tolerance) {}

    std::uint32_t add(const glm::dvec3& place);

private:
    struct Cell
    {
        std::int64_t x, y, z;
        bool operator==(const Cell& other) const
        {
            return x == other.x && y == other.y && z == other.z;
        }
    };
    struct Hash
    {
        std::size_t operator()(const Cell& cell) const;
    };
    Cell cellOf(const glm::dvec3& place) const;
    const std::uint32_t* find(const Cell& cell, const glm::dvec3& place) const;

    const double _tolerance, _cell;
    std::vector<glm::dvec3> _places;
    std::unordered_map<Cell, std::vector<std::uint32_t>, Hash> _cells;
};

} // namespace osgPagedTexture
