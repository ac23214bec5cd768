// SPDX-License-Identifier: MIT
#pragma once

#include <osgShadowVolume/Export.h>

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace osgShadowVolume
{

/// Triangles in a tree of boxes, to tell whether something stands between two points. Double
/// precision; two triangles with a common edge leave no gap between them.
class OSGSHADOWVOLUME_EXPORT TriangleTree
{
public:
    using Triangle = std::array<glm::dvec3, 3>;

    TriangleTree() = default;
    /// Triangles with a coordinate that is infinite or not a number are left out.
    explicit TriangleTree(std::vector<Triangle> triangles);

    /// Whether a triangle crosses the way from `from` along `direction`, before its end (infinity
    /// for none; 1 for from + direction). Seen from both sides. Triangles whose plane passes either
    /// end of the way within `tolerance` do not count: the surface on which a point lies, and that
    /// on which a lamp lies.
    bool blocks(const glm::dvec3& from, const glm::dvec3& direction, double tolerance,
                double end = 1.0) const;

    std::size_t getNumTriangles() const { return _triangles.size(); }
    /// Of the box around all triangles; 0 for none.
    double getDiagonal() const;

private:
    /// Inner nodes have their second child at `first` and the first one right behind them; leaves
    /// have `count` triangles from `first` on.
    struct Box
    {
        glm::dvec3 low{std::numeric_limits<double>::infinity()};
        glm::dvec3 high{-std::numeric_limits<double>::infinity()};
        std::uint32_t first = 0;
        std::uint32_t count = 0;
    };

    void build(std::size_t begin, std::size_t end);

    std::vector<Triangle> _triangles;
    std::vector<Box> _boxes;
};

} // namespace osgShadowVolume
