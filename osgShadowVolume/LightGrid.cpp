// SPDX-License-Identifier: MIT
#include <osgShadowVolume/LightGrid.h>

#include <algorithm>
#include <cmath>

namespace osgShadowVolume
{

namespace
{

constexpr int maxCellsPerAxis = 64;

/// About two cells a light, shared out along the axes by the box's extents.
glm::ivec3 sizeFor(std::size_t lights, const glm::dvec3& extent)
{
    const double longest = std::max({extent.x, extent.y, extent.z});
    if (!(longest > 0.0))
        return glm::ivec3(1);
    // Flat boxes (a floor) spend their cells on the axes that have extent.
    const glm::dvec3 shape = glm::max(extent / longest, glm::dvec3(1.0 / maxCellsPerAxis));
    const double along =
        std::cbrt(2.0 * double(lights) / (shape.x * shape.y * shape.z));
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
        return std::size_t(n.x) * n.y * n.z;
    }
};

} // namespace

LightGrid::LightGrid(const std::vector<EyeLight>& all, const std::vector<double>& reach,
                     const std::vector<std::uint32_t>& lights, const glm::dvec3& boxMin,
                     const glm::dvec3& boxMax)
    : _origin(boxMin), _size(sizeFor(lights.size(), boxMax - boxMin))
{
    const glm::dvec3 extent = boxMax - boxMin;
    _cell = glm::max(extent / glm::dvec3(_size), glm::dvec3(1e-30));
    const std::size_t cells = std::size_t(_size.x) * _size.y * _size.z;
    const double cellRadius = 0.5 * glm::length(_cell);

    const auto rangeOf = [&](std::uint32_t light) {
        const glm::dvec3 low = (all[light].position - reach[light] - _origin) / _cell;
        const glm::dvec3 high = (all[light].position + reach[light] - _origin) / _cell;
        const glm::dvec3 top = glm::dvec3(_size - 1);
        return CellRange{glm::ivec3(glm::clamp(glm::floor(low), glm::dvec3(0.0), top)),
                         glm::ivec3(glm::clamp(glm::floor(high), glm::dvec3(0.0), top))};
    };
    const auto forEachCell = [&](std::uint32_t light, auto f) {
        const CellRange range = rangeOf(light);
        for (int z = range.first.z; z <= range.last.z; ++z)
            for (int y = range.first.y; y <= range.last.y; ++y)
                for (int x = range.first.x; x <= range.last.x; ++x)
                {
                    const glm::dvec3 center = _origin + (glm::dvec3(x, y, z) + 0.5) * _cell;
                    if (reaches(all[light], reach[light], center, cellRadius * 1.0001))
                        f(std::size_t(x) + _size.x * (std::size_t(y) + std::size_t(_size.y) * z));
                }
    };

    // Twice the same walk: count, then fill, so that the lists lie in one array.
    std::vector<std::uint32_t> local;
    for (std::uint32_t light : lights)
        if (!std::isfinite(reach[light]) || rangeOf(light).count() * 2 > cells)
            _everywhere.push_back(light);
        else
            local.push_back(light);
    _offsets.assign(cells + 1, 0);
    for (std::uint32_t light : local)
        forEachCell(light, [&](std::size_t cell) { ++_offsets[cell + 1]; });
    for (std::size_t cell = 0; cell < cells; ++cell)
        _offsets[cell + 1] += _offsets[cell];
    _indices.resize(_offsets.back());
    std::vector<std::uint32_t> next(_offsets.begin(), _offsets.end() - 1);
    for (std::uint32_t light : local)
        forEachCell(light, [&](std::size_t cell) { _indices[next[cell]++] = light; });
}

std::size_t LightGrid::cellOf(const glm::dvec3& point) const
{
    const glm::dvec3 at = glm::clamp(glm::floor((point - _origin) / _cell), glm::dvec3(0.0),
                                     glm::dvec3(_size - 1));
    return std::size_t(at.x) + _size.x * (std::size_t(at.y) + std::size_t(_size.y) * std::size_t(at.z));
}

} // namespace osgShadowVolume
