// SPDX-License-Identifier: MIT
#include <osgPagedTexture/CellSplit.h>

#include <glm/common.hpp>

#include <algorithm>
#include <tuple>

namespace osgPagedTexture
{

namespace
{

using Polygon = std::vector<SplitPoint>;

/// From the lower end on: from whichever side an edge is cut, the point is the same.
SplitPoint cutEdge(const SplitPoint& a, const SplitPoint& b, int axis, double border)
{
    const auto key = [](const SplitPoint& p) { return std::tie(p.coordinate.x, p.coordinate.y); };
    const SplitPoint& from = key(b) < key(a) ? b : a;
    const SplitPoint& to = key(b) < key(a) ? a : b;
    const double share =
        (border - from.coordinate[axis]) / (to.coordinate[axis] - from.coordinate[axis]);
    SplitPoint cut{glm::mix(from.coordinate, to.coordinate, share),
                   glm::mix(from.weights, to.weights, share)};
    cut.coordinate[axis] = border;
    return cut;
}

/// Takes what lies below a border out of a polygon.
Polygon takeBelow(Polygon& polygon, int axis, double border)
{
    Polygon below, above;
    for (std::size_t i = 0; i < polygon.size(); ++i)
    {
        const SplitPoint& a = polygon[i];
        const SplitPoint& b = polygon[(i + 1) % polygon.size()];
        const double da = a.coordinate[axis] - border, db = b.coordinate[axis] - border;
        if (da <= 0.0)
            below.push_back(a);
        if (da >= 0.0)
            above.push_back(a);
        if ((da < 0.0 && db > 0.0) || (da > 0.0 && db < 0.0))
        {
            below.push_back(cutEdge(a, b, axis, border));
            above.push_back(below.back());
        }
    }
    polygon.swap(above);
    return below;
}

/// Cuts from the lowest cell to the highest, so that all triangles cut an edge in one order.
template <class Take> void slice(Polygon polygon, int axis, const WrapRun& run, const Take& take)
{
    for (std::int64_t cell = run.first; cell < run.last; ++cell)
    {
        const Polygon below = takeBelow(polygon, axis, double(cell + 1));
        if (below.size() > 2)
            take(cell, below);
    }
    if (polygon.size() > 2)
        take(run.last, polygon);
}

} // namespace

std::vector<CellPart> splitAtCells(const std::array<glm::dvec2, 3>& corners, PhotoWrap wrapS,
                                   PhotoWrap wrapT, std::int64_t mostCells)
{
    const glm::dvec2 low = glm::min(glm::min(corners[0], corners[1]), corners[2]);
    const glm::dvec2 high = glm::max(glm::max(corners[0], corners[1]), corners[2]);
    const WrapRun s = wrapRunOf(low.x, high.x, wrapS), t = wrapRunOf(low.y, high.y, wrapT);
    if (s.getCount() > mostCells || t.getCount() > mostCells ||
        s.getCount() * t.getCount() > mostCells)
        return {};
    Polygon triangle(3);
    for (int i = 0; i < 3; ++i)
    {
        triangle[std::size_t(i)].coordinate = corners[std::size_t(i)];
        triangle[std::size_t(i)].weights = glm::dvec3(i == 0, i == 1, i == 2);
    }
    std::vector<CellPart> parts;
    slice(triangle, 0, s,
          [&](std::int64_t cellS, const Polygon& slab)
          {
              slice(slab, 1, t,
                    [&](std::int64_t cellT, const Polygon& part) {
                        parts.push_back({cellS, cellT, part});
                    });
          });
    return parts;
}

} // namespace osgPagedTexture
