// SPDX-License-Identifier: MIT
#pragma once

#include <osgShadowVolume/LightReach.h>

#include <cstdint>
#include <vector>

namespace osgShadowVolume
{

/// A regular grid over a box; each cell lists the lights that reach it.
///
/// Free of OSG and GL. Lights and box are in one frame of the caller's choice. A fragment finds its
/// cell from its position alone, so one grid serves any projection. Lights that reach more than a
/// share of all cells are listed once for the whole grid.
class OSGSHADOWVOLUME_EXPORT LightGrid
{
public:
    /// Pairs of a light and a cell that a grid may list: 16 MB, and some tens of milliseconds to
    /// find them.
    static constexpr double MaxPairs = 4 << 20;

    /// `lights` are indices into `all`, `reach` is parallel to `all`. The box must be finite.
    LightGrid(const std::vector<EyeLight>& all, const std::vector<double>& reach,
              const std::vector<std::uint32_t>& lights, const glm::dvec3& boxMin,
              const glm::dvec3& boxMax, double maxPairs = MaxPairs);

    glm::dvec3 getOrigin() const { return _origin; }
    glm::dvec3 getCellSize() const { return _cell; }
    glm::ivec3 getSize() const { return _size; } ///< Cells along each axis, 1 to 256.

    /// Lights that every cell has.
    const std::vector<std::uint32_t>& getEverywhere() const { return _everywhere; }
    /// Cell (x, y, z) lists getIndices()[getOffsets()[i]] up to getOffsets()[i + 1], with
    /// i = x + size.x * (y + size.y * z).
    const std::vector<std::uint32_t>& getOffsets() const { return _offsets; }
    const std::vector<std::uint32_t>& getIndices() const { return _indices; }

    /// The cell that holds a point, clamped to the grid; what a fragment computes.
    std::size_t cellOf(const glm::dvec3& point) const;

private:
    glm::dvec3 _origin;
    glm::dvec3 _cell;
    glm::ivec3 _size;
    std::vector<std::uint32_t> _everywhere;
    std::vector<std::uint32_t> _offsets;
    std::vector<std::uint32_t> _indices;
};

} // namespace osgShadowVolume
