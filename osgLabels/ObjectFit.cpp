// SPDX-License-Identifier: MIT
#include <osgLabels/ObjectFit.h>

#include <osg/TriangleIndexFunctor>

#include <glm/geometric.hpp>

#include <cmath>
#include <optional>

namespace osgLabels
{

namespace
{

/// Lengths on the surface against lengths in texture coordinates.
class TextureScale
{
public:
    const osg::Vec3Array* vertices = nullptr;
    const osg::Vec2Array* coordinates = nullptr;

    void operator()(unsigned int a, unsigned int b, unsigned int c)
    {
        const std::size_t size = std::min(vertices->size(), coordinates->size());
        if (a >= size || b >= size || c >= size)
            return;
        const osg::Vec2d s = toDouble((*coordinates)[b] - (*coordinates)[a]);
        const osg::Vec2d t = toDouble((*coordinates)[c] - (*coordinates)[a]);
        const double area = s.x() * t.y() - s.y() * t.x();
        if (area == 0.0 || !std::isfinite(area))
            return;
        const osg::Vec3d p = (*vertices)[b] - (*vertices)[a], q = (*vertices)[c] - (*vertices)[a];
        const osg::Vec3d alongU = (p * t.y() - q * s.y()) / area;
        const osg::Vec3d alongV = (q * s.x() - p * t.x()) / area;
        _sum += osg::Vec2d(alongU.length(), alongV.length()) * std::abs(area);
        _area += std::abs(area);
    }

    /// None where the coordinates span nothing.
    std::optional<osg::Vec2d> get() const
    {
        const osg::Vec2d scale = _sum / _area;
        if (!(_area > 0.0) || !std::isfinite(scale.length2()))
            return std::nullopt;
        return scale;
    }

private:
    static osg::Vec2d toDouble(const osg::Vec2& v) { return {v.x(), v.y()}; }

    osg::Vec2d _sum;
    double _area = 0.0;
};

std::optional<ObjectRecord> texturedRecord(const osg::Geometry& geometry, int unit,
                                           std::uint32_t identifier)
{
    osg::TriangleIndexFunctor<TextureScale> scale;
    scale.vertices = dynamic_cast<const osg::Vec3Array*>(geometry.getVertexArray());
    scale.coordinates = dynamic_cast<const osg::Vec2Array*>(geometry.getTexCoordArray(unit));
    if (!scale.vertices || !scale.coordinates || scale.coordinates->empty())
        return std::nullopt;
    geometry.accept(scale);
    const std::optional<osg::Vec2d> unitLengths = scale.get();
    if (!unitLengths)
        return std::nullopt;
    osg::BoundingBoxd box;
    for (const osg::Vec2& uv : *scale.coordinates)
        if (std::isfinite(uv.length2()))
            box.expandBy(uv.x(), uv.y(), 0.0);
    ObjectRecord record;
    record.rotation = glm::quat(0.0f, float(unitLengths->x()), float(unitLengths->y()), 0.0f);
    record.origin = {float(box.center().x()), float(box.center().y()), 0.0f};
    record.size = {float(0.5 * (box.xMax() - box.xMin()) * unitLengths->x()),
                   float(0.5 * (box.yMax() - box.yMin()) * unitLengths->y()), 0.0f};
    record.shape = std::uint32_t(Shape::TexCoord);
    record.identifier = identifier;
    return record;
}

/// The factor of a matrix that only moves, turns and scales evenly; 0 for others.
double similarityOf(const osg::Matrixd& m)
{
    const osg::Vec3d rows[3] = {
        {m(0, 0), m(0, 1), m(0, 2)}, {m(1, 0), m(1, 1), m(1, 2)}, {m(2, 0), m(2, 1), m(2, 2)}};
    const double factor = rows[0].length();
    // Floats of records hold 24 bits; a difference of 20 is not seen on any label.
    const double tolerance = 1e-6 * factor;
    const bool isEven = std::abs(rows[1].length() - factor) <= tolerance &&
                        std::abs(rows[2].length() - factor) <= tolerance &&
                        ((rows[0] ^ rows[1]) / factor - rows[2]).length() <= 4.0 * tolerance;
    return isEven && std::isfinite(factor) ? factor : 0.0;
}

FittedShape moved(FittedShape fit, const osg::Matrixd& matrix, double factor)
{
    const osg::Vec3d origin = osg::Vec3d(fit.origin.x, fit.origin.y, fit.origin.z) * matrix;
    const osg::Quat turn = matrix.getRotate();
    fit.origin = {origin.x(), origin.y(), origin.z()};
    fit.rotation =
        fit.rotation * glm::conjugate(glm::dquat(turn.w(), turn.x(), turn.y(), turn.z()));
    const double angle = fit.size.z;
    fit.size *= factor;
    if (fit.shape == Shape::Torus)
        fit.size.z = angle;
    return fit;
}

} // namespace

ObjectRecord recordOf(const osg::Drawable& drawable, int texCoord, std::uint32_t identifier)
{
    if (const osg::Geometry* geometry = texCoord < 0 ? nullptr : drawable.asGeometry())
        if (const auto record = texturedRecord(*geometry, texCoord, identifier))
            return *record;
    return fitDrawable(drawable).record(identifier);
}

ObjectRecord recordOf(const osg::Geometry& geometry, const osg::Matrixd& matrix, int texCoord,
                      std::uint32_t identifier)
{
    osg::ref_ptr<osg::Geometry> copy;
    const double factor = similarityOf(matrix);
    if (texCoord < 0 && factor > 0.0)
        return moved(fitDrawable(geometry), matrix, factor).record(identifier);
    copy = new osg::Geometry(geometry, osg::CopyOp::SHALLOW_COPY);
    const auto* from = dynamic_cast<const osg::Vec3Array*>(geometry.getVertexArray());
    if (from)
    {
        osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
        for (const osg::Vec3& v : *from)
            vertices->push_back(osg::Vec3(osg::Vec3d(v) * matrix));
        copy->setVertexArray(vertices);
    }
    return recordOf(*copy, texCoord, identifier);
}

} // namespace osgLabels
