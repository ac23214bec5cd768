// SPDX-License-Identifier: MIT
#include <osgPagedTexture/SurfaceOf.h>

#include <osgPagedTexture/ArrayPoint.h>

#include <osg/TriangleIndexFunctor>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace osgPagedTexture
{

namespace
{

constexpr double LeftOut = 1.0 / 256.0; ///< Of the area.

/// Takes triangles and keeps how areas are spread over densities, in steps of an eighth of a
/// power of two.
class TriangleSums
{
public:
    static constexpr int StepsPerPower = 8;
    static constexpr int Powers = 64; ///< From 2^-32 on.

    const osg::Array* places = nullptr;
    const osg::Array* coordinates = nullptr;

    void operator()(unsigned int a, unsigned int b, unsigned int c)
    {
        const unsigned int count =
            std::min(places->getNumElements(), coordinates->getNumElements());
        if (std::max({a, b, c}) >= count)
            return;
        const glm::dvec3 p = pointOf(*places, a);
        const glm::dvec3 normal = glm::cross(pointOf(*places, b) - p, pointOf(*places, c) - p);
        const double area = 0.5 * glm::length(normal);
        if (!(area > 0.0) || !std::isfinite(area))
            return;
        const glm::dvec3 q = pointOf(*coordinates, a);
        const double uv =
            0.5 *
            std::abs(glm::cross(pointOf(*coordinates, b) - q, pointOf(*coordinates, c) - q).z);
        _area += area;
        addNormal(normal / (2.0 * area));
        const double step = (std::log2(uv / area) + Powers / 2.0) * StepsPerPower;
        if (std::isnan(step) || step < 0.0)
            _below += area;
        else
            _areas[std::min(int(step), Powers * StepsPerPower - 1)] += area;
    }

    /// The lower end of the step where the share that is left out ends; 0 where that has no
    /// density worth a step.
    double density() const
    {
        double sum = _below;
        if (!(_area > 0.0) || sum > LeftOut * _area)
            return 0.0;
        for (int step = 0; step < int(_areas.size()); ++step)
        {
            sum += _areas[step];
            if (sum > LeftOut * _area)
                return std::exp2(double(step) / StepsPerPower - Powers / 2.0);
        }
        return 0.0;
    }

    const glm::dvec3& axis() const { return _axis; }
    double spread() const { return std::acos(std::min(1.0, _leastCosine)); }

private:
    void addNormal(const glm::dvec3& normal)
    {
        if (glm::length(_axis) < 0.5)
            _axis = normal;
        _leastCosine = std::min(_leastCosine, std::abs(glm::dot(normal, _axis)));
    }

    std::array<double, std::size_t(Powers) * StepsPerPower> _areas{};
    double _area = 0.0;
    double _below = 0.0;
    glm::dvec3 _axis{0.0};
    double _leastCosine = 1.0;
};

/// osg::TriangleIndexFunctor makes its own object of the class that it is given.
struct TriangleTaker
{
    TriangleSums* sums = nullptr;
    void operator()(unsigned int a, unsigned int b, unsigned int c) const { (*sums)(a, b, c); }
};

} // namespace

TexelSurface surfaceOf(const osg::Drawable& drawable, unsigned int unit)
{
    TexelSurface surface;
    const osg::BoundingBox& box = drawable.getBoundingBox();
    if (!box.valid())
    {
        surface.low.x = 1.0; // Not known.
        return surface;
    }
    surface.low = {box.xMin(), box.yMin(), box.zMin()};
    surface.high = {box.xMax(), box.yMax(), box.zMax()};
    const osg::Geometry* geometry = drawable.asGeometry();
    if (!geometry)
        return surface;
    const osg::Array* coordinates = geometry->getTexCoordArray(unit);
    if (!coordinates)
        coordinates = geometry->getTexCoordArray(0);
    if (!isReadable(geometry->getVertexArray(), true) || !isReadable(coordinates, false))
        return surface;
    TriangleSums sums;
    sums.places = geometry->getVertexArray();
    sums.coordinates = coordinates;
    osg::TriangleIndexFunctor<TriangleTaker> triangles;
    triangles.sums = &sums;
    geometry->accept(triangles);
    surface.uvDensity = sums.density();
    surface.axis = sums.axis();
    surface.spread = sums.spread();
    return surface;
}

} // namespace osgPagedTexture
