// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/PrimitiveShape.h>

#include <cstdint>
#include <vector>

namespace osgLabels
{

/// The mesh of a shape before placePoint() gives it its size. Free of OSG.
struct UnitMesh
{
    std::vector<SurfacePoint> points;
    std::vector<std::uint16_t> triangles; ///< Counterclockwise from outside.
};

/// Sides of a circle, level by level; the first is the finest.
constexpr int LevelSides[] = {96, 48, 24, 12, 6, 4};
constexpr int NumLevels = sizeof LevelSides / sizeof *LevelSides;
/// What other visitors than cull see: intersections, shadows, statistics.
constexpr int VisitorLevel = 2;

/// Objects of one kind have one mesh, level by level. Only tori of one shape differ: a long turn
/// needs more segments along it, a thin tube fewer sides around it.
struct MeshKind
{
    Shape shape = Shape::None;
    std::uint8_t quarters = 4;    ///< Of a turn: 1, 2 or 4.
    std::uint8_t tubeDivisor = 1; ///< 1, 2 or 4 times fewer sides around the tube.

    std::uint32_t number() const
    {
        return std::uint32_t(shape) | std::uint32_t(quarters << 8) |
               std::uint32_t(tubeDivisor << 16);
    }
};

OSGLABELS_EXPORT MeshKind kindOf(const ObjectRecord& record);

/// The mesh of a kind with `sides` sides around; flat-faced shapes have one mesh. Closed, but for
/// the quad. Empty for what isPrimitive() refuses.
OSGLABELS_EXPORT UnitMesh makeUnitMesh(const MeshKind& kind, int sides);

/// Levels that differ: 1 for shapes with flat faces only.
OSGLABELS_EXPORT int levelsOf(Shape shape);

/// The coarsest level whose polygon stays within half a pixel of a circle of this radius in
/// pixels.
OSGLABELS_EXPORT int levelFor(float radiusPixels);

} // namespace osgLabels
