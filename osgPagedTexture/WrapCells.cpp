// SPDX-License-Identifier: MIT
#include <osgPagedTexture/WrapCells.h>

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>

namespace osgPagedTexture
{

namespace
{

/// Cells beyond are as many as make no difference; sums of them don't overflow.
constexpr double FarCell = 1e15;

std::int64_t cellBelow(double coordinate)
{
    return static_cast<std::int64_t>(std::clamp(std::floor(coordinate), -FarCell, FarCell));
}

} // namespace

WrapRun wrapRunOf(double low, double high, PhotoWrap wrap)
{
    if (wrap == PhotoWrap::Clamp)
    {
        WrapRun run{low < 0.0 ? -1 : 0, high > 1.0 ? 1 : 0};
        if (high < 0.0)
            run.last = -1;
        if (low > 1.0)
            run.first = 1;
        return run;
    }
    WrapRun run{cellBelow(low), cellBelow(high)};
    if (run.last > run.first && double(run.last) == high)
        --run.last;
    return run;
}

double wrapIntoPhoto(double coordinate, std::int64_t cell, PhotoWrap wrap)
{
    switch (wrap)
    {
    case PhotoWrap::Repeat:
        return coordinate - double(cell);
    case PhotoWrap::Mirror:
        return cell % 2 == 0 ? coordinate - double(cell) : double(cell + 1) - coordinate;
    default:
        return coordinate;
    }
}

glm::dvec2 placeInPhoto(const glm::dvec2& coordinate, const PhotoSurface& surface,
                        const glm::dvec2& size)
{
    const WrapRun s = wrapRunOf(coordinate.x, coordinate.x, surface.wrapS);
    const WrapRun t = wrapRunOf(coordinate.y, coordinate.y, surface.wrapT);
    return glm::clamp(glm::dvec2(wrapIntoPhoto(coordinate.x, s.first, surface.wrapS),
                                 wrapIntoPhoto(coordinate.y, t.first, surface.wrapT)),
                      0.0, 1.0) *
           size;
}

} // namespace osgPagedTexture
