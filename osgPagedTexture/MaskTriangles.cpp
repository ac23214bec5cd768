// SPDX-License-Identifier: MIT
#include <osgPagedTexture/MaskTriangles.h>

#include <osgPagedTexture/WrapCells.h>

#include <glm/common.hpp>

#include <algorithm>

namespace osgPagedTexture
{

namespace
{

double cross(const glm::dvec2& a, const glm::dvec2& b)
{
    return a.x * b.y - a.y * b.x;
}

bool isInside(const std::array<glm::dvec2, 3>& corners, const glm::dvec2& point)
{
    double low = 0.0, high = 0.0;
    for (int i = 0; i < 3; ++i)
    {
        const double side = cross(corners[(i + 1) % 3] - corners[i], point - corners[i]);
        low = std::min(low, side);
        high = std::max(high, side);
    }
    return (low == 0.0) != (high == 0.0);
}

/// A triangle is convex: it covers a cell where it has its four corners.
bool coversCell(const std::array<glm::dvec2, 3>& corners, std::int64_t s, std::int64_t t)
{
    for (int corner = 0; corner < 4; ++corner)
        if (!isInside(corners, glm::dvec2(double(s + corner % 2), double(t + corner / 2))))
            return false;
    return true;
}

bool coversAnyCell(const std::array<glm::dvec2, 3>& corners, const WrapRun& s, const WrapRun& t)
{
    for (std::int64_t y = t.first; y <= t.last; ++y)
        for (std::int64_t x = s.first; x <= s.last; ++x)
            if (coversCell(corners, x, y))
                return true;
    return false;
}

bool isOutside(PhotoWrap wrap, std::int64_t cell)
{
    return wrap == PhotoWrap::Clamp && cell != 0;
}

/// Pixels of the edge's row or column where clamped, else all from `low` to `high`.
void spread(PhotoWrap wrap, std::int64_t cell, double pixels, double& low, double& high)
{
    if (isOutside(wrap, cell))
    {
        low = cell < 0 ? 0.0 : pixels - 1.0;
        high = low + 1.0;
        return;
    }
    const double a = wrapIntoPhoto(low, cell, wrap) * pixels;
    const double b = wrapIntoPhoto(high, cell, wrap) * pixels;
    low = std::min(a, b);
    high = std::max(a, b);
}

void clipToCell(std::vector<glm::dvec2>& polygon, int axis, PhotoWrap wrap, std::int64_t cell)
{
    if (!isOutside(wrap, cell) || cell > 0)
        clipPolygon(polygon, axis, double(cell), 1.0);
    if (!isOutside(wrap, cell) || cell < 0)
        clipPolygon(polygon, axis, double(cell + 1), -1.0);
}

} // namespace

void clipPolygon(std::vector<glm::dvec2>& polygon, int axis, double border, double sign)
{
    std::vector<glm::dvec2> kept;
    kept.reserve(polygon.size() + 1);
    for (std::size_t i = 0; i < polygon.size(); ++i)
    {
        const glm::dvec2& a = polygon[i];
        const glm::dvec2& b = polygon[(i + 1) % polygon.size()];
        const double da = sign * (a[axis] - border), db = sign * (b[axis] - border);
        if (da >= 0.0)
            kept.push_back(a);
        if ((da > 0.0 && db < 0.0) || (da < 0.0 && db > 0.0))
        {
            // From the lower end on, so that triangles that share an edge cut it at one point.
            const bool turned = std::pair(b.x, b.y) < std::pair(a.x, a.y);
            const glm::dvec2& from = turned ? b : a;
            const glm::dvec2& to = turned ? a : b;
            const double share = (border - from[axis]) / (to[axis] - from[axis]);
            glm::dvec2 cut = glm::mix(from, to, share);
            cut[axis] = border;
            kept.push_back(cut);
        }
    }
    polygon.swap(kept);
}

void MaskTriangles::addRectangle(double left, double bottom, double right, double top)
{
    const glm::dvec2 a(left, bottom), b(right, bottom), c(right, top), d(left, top);
    _take({a, b, c});
    _take({a, c, d});
}

void MaskTriangles::addClamped(const std::array<glm::dvec2, 3>& corners, std::int64_t cellS,
                               std::int64_t cellT, const PhotoSurface& surface)
{
    std::vector<glm::dvec2> polygon(corners.begin(), corners.end());
    clipToCell(polygon, 0, surface.wrapS, cellS);
    clipToCell(polygon, 1, surface.wrapT, cellT);
    if (polygon.empty())
        return;
    glm::dvec2 low = polygon[0], high = polygon[0];
    for (const glm::dvec2& point : polygon)
    {
        low = glm::min(low, point);
        high = glm::max(high, point);
    }
    spread(surface.wrapS, cellS, _width, low.x, high.x);
    spread(surface.wrapT, cellT, _height, low.y, high.y);
    addRectangle(low.x, low.y, high.x, high.y);
}

void MaskTriangles::add(const PhotoSurface& surface, std::size_t index)
{
    std::array<glm::dvec2, 3> corners;
    for (std::size_t i = 0; i < 3; ++i)
        corners[i] = glm::dvec2(surface.coordinates[3 * index + i]);
    const glm::dvec2 low = glm::min(glm::min(corners[0], corners[1]), corners[2]);
    const glm::dvec2 high = glm::max(glm::max(corners[0], corners[1]), corners[2]);
    const WrapRun s = wrapRunOf(low.x, high.x, surface.wrapS);
    const WrapRun t = wrapRunOf(low.y, high.y, surface.wrapT);
    const bool many = s.getCount() > MostWrapCells || t.getCount() > MostWrapCells ||
                      s.getCount() * t.getCount() > MostWrapCells;
    const bool repeats = surface.wrapS != PhotoWrap::Clamp && surface.wrapT != PhotoWrap::Clamp;
    if (many || (repeats && s.getCount() * t.getCount() > 8 && coversAnyCell(corners, s, t)))
    {
        ++_whole;
        addRectangle(0.0, 0.0, _width, _height);
        return;
    }
    for (std::int64_t cellT = t.first; cellT <= t.last; ++cellT)
    {
        for (std::int64_t cellS = s.first; cellS <= s.last; ++cellS)
        {
            if (isOutside(surface.wrapS, cellS) || isOutside(surface.wrapT, cellT))
            {
                addClamped(corners, cellS, cellT, surface);
                continue;
            }
            PixelTriangle moved;
            for (int i = 0; i < 3; ++i)
                moved[i] = {wrapIntoPhoto(corners[i].x, cellS, surface.wrapS) * _width,
                            wrapIntoPhoto(corners[i].y, cellT, surface.wrapT) * _height};
            _take(moved);
        }
    }
}

} // namespace osgPagedTexture
