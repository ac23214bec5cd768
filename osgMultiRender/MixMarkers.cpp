// SPDX-License-Identifier: MIT
#include <osgMultiRender/MixMarkers.h>

#include <osg/Depth>
#include <osg/Geometry>
#include <osg/LineWidth>
#include <osg/Material>
#include <osg/MatrixTransform>
#include <osg/Program>
#include <osg/ShapeDrawable>

#include <algorithm>
#include <cmath>

namespace osgMultiRender
{

namespace
{

const osg::Vec4 Red(0.9f, 0.08f, 0.05f, 1.0f);

bool counts(const osg::Vec3d& point)
{
    const auto isIn = [](double x) { return std::abs(x) <= KeyPoints::MaxCoordinate; };
    return isIn(point.x()) && isIn(point.y()) && isIn(point.z());
}

osg::ref_ptr<osg::Geometry> makeLine(const std::vector<osg::Vec3d>& points, const osg::Vec3d& from,
                                     KeyMode mode)
{
    osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    for (const osg::Vec3d& point : points)
        vertices->push_back(point - from);
    osg::ref_ptr<osg::Vec4Array> colors = new osg::Vec4Array;
    colors->push_back(Red);
    osg::ref_ptr<osg::Geometry> line = new osg::Geometry;
    line->setVertexArray(vertices);
    line->setColorArray(colors, osg::Array::BIND_OVERALL);
    line->addPrimitiveSet(
        new osg::DrawArrays(mode == KeyMode::PolylineLoop ? GL_LINE_LOOP : GL_LINE_STRIP, 0,
                            static_cast<GLsizei>(vertices->size())));
    line->getOrCreateStateSet()->setMode(GL_LIGHTING,
                                         osg::StateAttribute::OFF | osg::StateAttribute::OVERRIDE);
    line->getStateSet()->setAttribute(new osg::LineWidth(2.0f));
    return line;
}

} // namespace

osg::ref_ptr<osg::Node> makeMixMarkers(const std::vector<osg::Vec3d>& points, KeyMode mode,
                                       bool lines, float radius)
{
    std::vector<osg::Vec3d> counted;
    std::copy_if(points.begin(), points.end(), std::back_inserter(counted), counts);
    // Far from the origin vertices are relative to the first point.
    const osg::Vec3d from = counted.empty() ? osg::Vec3d() : counted.front();
    osg::ref_ptr<osg::MatrixTransform> markers =
        new osg::MatrixTransform(osg::Matrixd::translate(from));
    osg::ref_ptr<osg::TessellationHints> hints = new osg::TessellationHints;
    hints->setDetailRatio(0.5f);
    osg::ref_ptr<osg::ShapeDrawable> sphere =
        new osg::ShapeDrawable(new osg::Sphere(osg::Vec3(), radius), hints);
    sphere->setColor(Red);
    for (const osg::Vec3d& point : counted)
    {
        osg::ref_ptr<osg::MatrixTransform> place =
            new osg::MatrixTransform(osg::Matrixd::translate(point - from));
        place->addChild(sphere);
        markers->addChild(place);
    }
    if (lines && mode != KeyMode::Points && counted.size() > 1)
        markers->addChild(makeLine(counted, from, mode));
    osg::StateSet& stateSet = *markers->getOrCreateStateSet();
    stateSet.setAttribute(new osg::Program, osg::StateAttribute::OVERRIDE);
    // A little nearer: they often lie in the surface that was picked.
    stateSet.setAttribute(new osg::Depth(osg::Depth::LEQUAL, 0.0, 0.9999));
    stateSet.setTextureMode(0, GL_TEXTURE_2D,
                            osg::StateAttribute::OFF | osg::StateAttribute::OVERRIDE);
    return markers;
}

} // namespace osgMultiRender
