// SPDX-License-Identifier: MIT
#include <osgLabels/ObjectFit.h>

#include <osgLabels/TexCoordFit.h>

#include <cmath>

namespace osgLabels
{

namespace
{

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

ObjectRecord recordOf(const osg::Drawable& drawable, const osg::Matrixd* scale, int texCoord,
                      std::uint32_t identifier)
{
    if (const osg::Geometry* geometry = scale ? drawable.asGeometry() : nullptr)
        return recordOf(*geometry, *scale, texCoord, identifier);
    if (const osg::Geometry* geometry = texCoord < 0 ? nullptr : drawable.asGeometry())
    {
        const FittedShape fit = fitTexCoords(*geometry, unsigned(texCoord));
        if (fit.shape != Shape::None)
            return fit.record(identifier);
    }
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
    return recordOf(*copy, nullptr, texCoord, identifier);
}

} // namespace osgLabels
