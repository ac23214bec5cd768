// SPDX-License-Identifier: MIT
#include <osgLabels/TexCoordFit.h>

#include <osg/TriangleIndexFunctor>

#include <algorithm>
#include <cmath>
#include <limits>

namespace osgLabels
{

namespace
{

/// Sums over triangles what lengths their texture coordinates have.
struct Lengths
{
    const osg::Vec3Array* points = nullptr;
    const osg::Vec2Array* coordinates = nullptr;
    glm::dvec2 low{std::numeric_limits<double>::max()};
    glm::dvec2 high{-std::numeric_limits<double>::max()};
    glm::dvec2 sum{0.0};
    glm::dvec3 middle{0.0};
    glm::dvec3 least{std::numeric_limits<double>::max()};
    glm::dvec3 most{-std::numeric_limits<double>::max()};
    glm::dvec3 along[2] = {};    ///< What a unit of s and t is in space,
    double alongSquared[2] = {}; ///< and its square.
    double area = 0.0;

    void operator()(unsigned int a, unsigned int b, unsigned int c)
    {
        const std::size_t count = std::min(points->size(), coordinates->size());
        if (a >= count || b >= count || c >= count)
            return;
        const glm::dvec3 ab = point(b) - point(a), ac = point(c) - point(a);
        const glm::dvec2 st = coordinate(b) - coordinate(a), uv = coordinate(c) - coordinate(a);
        const double twice = glm::length(glm::cross(ab, ac));
        const double turned = st.x * uv.y - st.y * uv.x;
        const glm::dvec3 units[] = {(uv.y * ab - st.y * ac) / turned,
                                    (st.x * ac - uv.x * ab) / turned};
        const glm::dvec2 lengths(glm::length(units[0]), glm::length(units[1]));
        if (!(twice > 0.0) || !std::isfinite(lengths.x + lengths.y))
            return;
        for (const unsigned int corner : {a, b, c})
        {
            low = glm::min(low, coordinate(corner));
            high = glm::max(high, coordinate(corner));
            least = glm::min(least, point(corner));
            most = glm::max(most, point(corner));
            middle += twice / 3.0 * point(corner);
        }
        for (int i = 0; i < 2; ++i)
        {
            along[i] += twice * units[i];
            alongSquared[i] += twice * glm::dot(units[i], units[i]);
        }
        sum += twice * lengths;
        area += twice;
    }

    /// Whether units of s or t differ by more than some percent.
    bool isBent() const
    {
        const auto varies = [this](int i) {
            return alongSquared[i] * area - glm::dot(along[i], along[i]) >
                   1e-3 * alongSquared[i] * area;
        };
        return varies(0) || varies(1);
    }
    glm::dvec3 point(unsigned int i) const
    {
        const osg::Vec3& p = (*points)[i];
        return {p.x(), p.y(), p.z()};
    }
    glm::dvec2 coordinate(unsigned int i) const
    {
        const osg::Vec2& p = (*coordinates)[i];
        return {p.x(), p.y()};
    }
};

} // namespace

FittedShape fitTexCoords(const osg::Geometry& geometry, unsigned int unit)
{
    osg::TriangleIndexFunctor<Lengths> lengths;
    lengths.points = dynamic_cast<const osg::Vec3Array*>(geometry.getVertexArray());
    lengths.coordinates = unit < geometry.getNumTexCoordArrays()
                              ? dynamic_cast<const osg::Vec2Array*>(geometry.getTexCoordArray(unit))
                              : nullptr;
    if (!lengths.points || !lengths.coordinates ||
        lengths.coordinates->size() < lengths.points->size())
        return {};
    for (unsigned int i = 0; i != geometry.getNumPrimitiveSets(); ++i)
        geometry.getPrimitiveSet(i)->accept(lengths);
    if (!(lengths.area > 0.0))
        return {};
    const glm::dvec2 unitLength = lengths.sum / lengths.area;
    FittedShape shape;
    shape.shape = Shape::TexCoord;
    shape.rotation = glm::dquat(0.0, unitLength.x, unitLength.y, 0.0);
    shape.origin = glm::dvec3(0.5 * (lengths.low + lengths.high), 0.0);
    shape.size = glm::dvec3(0.5 * (lengths.high - lengths.low) * unitLength, 0.0);
    shape.bent = lengths.isBent();
    if (!shape.bent)
        return shape;
    const glm::dvec3 middle = lengths.middle / lengths.area, extent = lengths.most - lengths.least;
    shape.rotation.z = middle.x;
    shape.rotation.w = middle.y;
    shape.origin.z = middle.z;
    // A quarter of the middle one of three lengths.
    double sorted[] = {extent.x, extent.y, extent.z};
    std::sort(std::begin(sorted), std::end(sorted));
    shape.size.z = 0.25 * sorted[1];
    return shape;
}

} // namespace osgLabels
