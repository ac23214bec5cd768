// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/PhotoSurface.h>

#include <array>
#include <cstdint>

namespace osgPagedTexture
{

/// Where a triangle reaches along one axis of the texture's plane: a run of unit cells. For Clamp
/// they are -1 (before the photograph), 0 (it) and 1 (behind it).
struct WrapRun
{
    std::int64_t first = 0;
    std::int64_t last = -1;
    std::int64_t getCount() const { return last - first + 1; }
};

/// Cells that coordinates from `low` to `high`, finite, have a part in; at least one. A coordinate
/// on the border of two cells is in the one where others of the triangle are.
WrapRun wrapRunOf(double low, double high, PhotoWrap wrap);

/// A coordinate of a cell as one of the photograph, 0 to 1 inside of the cell. Exact where it can
/// be told from its neighbours.
double wrapIntoPhoto(double coordinate, std::int64_t cell, PhotoWrap wrap);

/// The pixel, from the left bottom corner, that a photograph of this size shows at a coordinate.
glm::dvec2 placeInPhoto(const glm::dvec2& coordinate, const PhotoSurface& surface,
                        const glm::dvec2& size);

/// The most cells of one triangle that are looked at one by one; a triangle that has more counts
/// for all of the photograph.
constexpr std::int64_t MostWrapCells = 4096;

} // namespace osgPagedTexture
