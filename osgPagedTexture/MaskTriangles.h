// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/PhotoSurface.h>

#include <glm/vec2.hpp>

#include <array>
#include <functional>
#include <vector>

namespace osgPagedTexture
{

using PixelTriangle = std::array<glm::dvec2, 3>;

/// The triangles whose pixels a mask has, in pixels from the photograph's bottom left corner. What
/// lies outside of the photograph is no part of them.
class MaskTriangles
{
public:
    /// `take` is called for each; `width` and `height` are the photograph's.
    MaskTriangles(int width, int height, std::function<void(const PixelTriangle&)> take)
        : _width(width), _height(height), _take(std::move(take))
    {
    }

    /// Triangle `index` of a surface, once for each of the repeats that it reaches. Where edges are
    /// clamped, what lies outside counts for the row or column of the edge.
    void add(const PhotoSurface& surface, std::size_t index);

    /// Triangles that reach more than MostWrapCells repeats, or cover a whole one.
    std::size_t getWholeCount() const { return _whole; }

private:
    void addRectangle(double left, double bottom, double right, double top);
    void addClamped(const std::array<glm::dvec2, 3>& corners, std::int64_t cellS,
                    std::int64_t cellT, const PhotoSurface& surface);

    const double _width, _height;
    const std::function<void(const PixelTriangle&)> _take;
    std::size_t _whole = 0;
};

/// What of a polygon has `sign` * (point[axis] - border) of 0 or more.
void clipPolygon(std::vector<glm::dvec2>& polygon, int axis, double border, double sign);

} // namespace osgPagedTexture
