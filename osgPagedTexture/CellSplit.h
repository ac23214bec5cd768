// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/Export.h>
#include <osgPagedTexture/PhotoSurface.h>
#include <osgPagedTexture/WrapCells.h>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace osgPagedTexture
{

/// A point of a triangle: where it is on the texture's plane, and how much of each corner it is.
struct SplitPoint
{
    glm::dvec2 coordinate;
    glm::dvec3 weights;
};

/// What of a triangle lies in one cell of the texture's plane: a convex polygon, turned as the
/// triangle is.
struct CellPart
{
    std::int64_t cellS = 0;
    std::int64_t cellT = 0;
    std::vector<SplitPoint> points;
};

/// Cuts a triangle along the borders of cells. Triangles that share an edge with the same
/// coordinates cut it at the same points, to the last bit. No part where there are more than
/// `mostCells` cells. Coordinates are finite.
OSGPAGEDTEXTURE_EXPORT std::vector<CellPart> splitAtCells(const std::array<glm::dvec2, 3>& corners,
                                                          PhotoWrap wrapS, PhotoWrap wrapT,
                                                          std::int64_t mostCells);

} // namespace osgPagedTexture
