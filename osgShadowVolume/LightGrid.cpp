// SPDX-License-Identifier: MIT
#include <osgShadowVolume/LightGrid.h>

#include <algorithm>
#include <cmath>

namespace osgShadowVolume
{

namespace
{

constexpr int maxCellsPerAxis = 256;

/// About two cells a light, shared out along the axes by the box's extents.
glm::ivec3 sizeFor(std::size_t lights, const glm::dvec3& extent)
{
    const double longest = std::max({extent.x, extent.y, extent.z});
    if (!(longest > 0.0))
        return glm::ivec3(1);
    // Flat boxes (a floor) spend their cells on the axes that have extent.
    const glm::dvec3 shape = glm::max(extent / longest, glm::dvec3(1.0 / maxCellsPerAxis));
    const double along = std::cbrt(2.0 * double(lights) / (shape.x * shape.y * shape.z));
    glm::ivec3 size;
    for (int axis = 0; axis < 3; ++axis)
        size[axis] = int(std::clamp(std::round(along * shape[axis]), 1.0, double(maxCellsPerAxis)));
    return size;
}

struct CellRange
{
    glm::ivec3 first, last;
    std::size_t count() const
    {
        const glm::ivec3 n = last - first + 1;
        return n.x > 0 ? std::size_t(n.x) * n.y * n.z : 0;
    }
};

/// A box cut into cells.
struct Cells
{
    glm::dvec3 origin, cell;
    glm::ivec3 size;

    Cells(const glm::dvec3& boxMin, const glm::dvec3& extent, const glm::ivec3& cells)
        : origin(boxMin), cell(glm::max(extent / glm::dvec3(cells), glm::dvec3(1e-30))), size(cells)
    {
    }

    std::size_t count() const { return std::size_t(size.x) * size.y * size.z; }

    /// How far the box goes on along a direction, from a point.
    double depthOf(const glm::dvec3& point, const glm::dvec3& direction) const
    {
        const glm::dvec3 low = origin - point, high = low + cell * glm::dvec3(size);
        return glm::dot(glm::max(low * direction, high * direction), glm::dvec3(1.0));
    }

    /// The cells that a box around what the light may light touches: a sphere, or the cone of a
    /// spot as far as it lies in front of the box's end.
    CellRange rangeOf(const EyeLight& light, double reach) const
    {
        glm::dvec3 low = light.position - reach, high = light.position + reach;
        if (light.type == EyeLight::Spot && light.spotCutoffDegrees < 85.0f)
        {
            const double length = std::min(reach, depthOf(light.position, light.spotDirection));
            if (!(length > 0.0))
                return CellRange{glm::ivec3(0), glm::ivec3(-1)};
            const glm::dvec3 end = light.position + length * light.spotDirection;
            const double radius = length * std::tan(glm::radians(double(light.spotCutoffDegrees)));
            const glm::dvec3 around =
                radius * glm::sqrt(glm::max(1.0 - light.spotDirection * light.spotDirection,
                                            glm::dvec3(0.0)));
            low = glm::max(low, glm::min(light.position, end - around));
            high = glm::min(high, glm::max(light.position, end + around));
        }
        // Half a millionth of the box more, for a fragment that rounds into the next cell.
        const glm::dvec3 margin = 5e-7 * cell * glm::dvec3(size);
        const glm::dvec3 top = glm::dvec3(size - 1);
        return CellRange{glm::ivec3(glm::clamp(glm::floor((low - margin - origin) / cell),
                                               glm::dvec3(0.0), top)),
                         glm::ivec3(glm::clamp(glm::floor((high + margin - origin) / cell),
                                               glm::dvec3(0.0), top))};
    }

    /// Whether the light is better listed once for all cells.
    bool isEverywhere(const EyeLight& light, double reach) const
    {
        return rangeOf(light, reach).count() * 2 > count();
    }

    template <class F> void forEachReached(const EyeLight& light, double reach, F f) const
    {
        // A little more than half the diagonal, for a fragment that rounds into the next cell.
        const double radius = 0.5 * glm::length(cell) * 1.0001;
        const CellRange range = rangeOf(light, reach);
        for (int z = range.first.z; z <= range.last.z; ++z)
            for (int y = range.first.y; y <= range.last.y; ++y)
                for (int x = range.first.x; x <= range.last.x; ++x)
                {
                    const glm::dvec3 center = origin + (glm::dvec3(x, y, z) + 0.5) * cell;
                    if (reaches(light, reach, center, radius))
                        f(std::size_t(x) + size.x * (std::size_t(y) + std::size_t(size.y) * z));
                }
    }
};

/// Cells for the lights: fewer where each light reaches many, so that lists and time stay bounded.
Cells cellsFor(const std::vector<EyeLight>& all, const std::vector<double>& reach,
               const std::vector<std::uint32_t>& lights, const glm::dvec3& boxMin,
               const glm::dvec3& extent, double maxPairs)
{
    glm::ivec3 size = sizeFor(lights.size(), extent);
    for (;;)
    {
        const Cells cells(boxMin, extent, size);
        double pairs = 0.0;
        for (std::uint32_t light : lights)
            if (!cells.isEverywhere(all[light], reach[light]))
                pairs += double(cells.rangeOf(all[light], reach[light]).count());
        if (pairs <= maxPairs)
            return cells;
        const double shrink = std::min(0.8, std::cbrt(maxPairs / pairs));
        size = glm::max(glm::ivec3(1), glm::ivec3(glm::dvec3(size) * shrink));
    }
}

} // namespace

LightGrid::LightGrid(const std::vector<EyeLight>& all, const std::vector<double>& reach,
                     const std::vector<std::uint32_t>& lights, const glm::dvec3& boxMin,
                     const glm::dvec3& boxMax, double maxPairs)
{
    const Cells cells = cellsFor(all, reach, lights, boxMin, boxMax - boxMin, maxPairs);
    _origin = cells.origin;
    _cell = cells.cell;
    _size = cells.size;

    // Twice the same walk: count, then fill, so that the lists lie in one array.
    std::vector<std::uint32_t> local;
    for (std::uint32_t light : lights)
        (cells.isEverywhere(all[light], reach[light]) ? _everywhere : local).push_back(light);
    _offsets.assign(cells.count() + 1, 0);
    for (std::uint32_t light : local)
        cells.forEachReached(all[light], reach[light],
                             [&](std::size_t cell) { ++_offsets[cell + 1]; });
    for (std::size_t cell = 0; cell < cells.count(); ++cell)
        _offsets[cell + 1] += _offsets[cell];
    _indices.resize(_offsets.back());
    std::vector<std::uint32_t> next(_offsets.begin(), _offsets.end() - 1);
    for (std::uint32_t light : local)
        cells.forEachReached(all[light], reach[light],
                             [&](std::size_t cell) { _indices[next[cell]++] = light; });
}

std::size_t LightGrid::cellOf(const glm::dvec3& point) const
{
    const glm::dvec3 at =
        glm::clamp(glm::floor((point - _origin) / _cell), glm::dvec3(0.0), glm::dvec3(_size - 1));
    return std::size_t(at.x) +
           _size.x * (std::size_t(at.y) + std::size_t(_size.y) * std::size_t(at.z));
}

} // namespace osgShadowVolume
