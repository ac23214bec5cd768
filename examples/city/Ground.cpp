// SPDX-License-Identifier: MIT
#include "Ground.h"

#include <osg/Geometry>

#include <algorithm>
#include <cmath>

using osg::Vec2d;
using osg::Vec3;

namespace
{

constexpr double Cell = 12.0; ///< Metres, of the terrain's mesh.

double smoothStep(double low, double high, double value)
{
    const double share = std::clamp((value - low) / (high - low), 0.0, 1.0);
    return share * share * (3.0 - 2.0 * share);
}

/// A grid of columns x rows vertices.
osg::ref_ptr<osg::Geode> makeSheet(osg::Vec3Array* vertices, osg::Vec3Array* normals,
                                   osg::Vec4ubArray* colors, unsigned int columns,
                                   unsigned int rows)
{
    osg::ref_ptr<osg::DrawElementsUInt> triangles = new osg::DrawElementsUInt(GL_TRIANGLES);
    for (unsigned int y = 0; y + 1 < rows; ++y)
        for (unsigned int x = 0; x + 1 < columns; ++x)
        {
            const unsigned int a = y * columns + x, b = a + 1, d = a + columns, c = d + 1;
            for (const unsigned int corner : {a, b, c, a, c, d})
                triangles->push_back(corner);
        }
    colors->setNormalize(true);
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setUseVertexBufferObjects(true);
    geometry->setUseDisplayList(false);
    geometry->setVertexArray(vertices);
    geometry->setNormalArray(normals, osg::Array::BIND_PER_VERTEX);
    geometry->setColorArray(colors, osg::Array::BIND_PER_VERTEX);
    geometry->addPrimitiveSet(triangles);
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(geometry);
    return geode;
}

osg::Vec4ub mixed(const Vec3& a, const Vec3& b, double share)
{
    const Vec3 color = (a * float(1.0 - share) + b * float(share)) * 255.0f;
    return {static_cast<unsigned char>(color.x()), static_cast<unsigned char>(color.y()),
            static_cast<unsigned char>(color.z()), 255};
}

} // namespace

double Ground::heightAt(double x, double y) const
{
    const double waves = 3.0 * std::sin(x / 140.0 + 0.4) + 3.0 * std::cos(y / 170.0);
    const double hills =
        34.0 + 26.0 * std::sin(x / 130.0 + 1.0) * std::cos(y / 110.0) + 9.0 * std::sin(x / 47.0);
    return waves + hills * smoothStep(_town, _town + 330.0, std::hypot(x, y));
}

double Ground::lowestIn(const Vec2d& low, const Vec2d& high) const
{
    return std::min({heightAt(low.x(), low.y()), heightAt(high.x(), low.y()),
                     heightAt(low.x(), high.y()), heightAt(high.x(), high.y()),
                     heightAt(0.5 * (low.x() + high.x()), 0.5 * (low.y() + high.y()))});
}

osg::ref_ptr<osg::Geode> Ground::makeTerrain() const
{
    const auto half = static_cast<int>(std::ceil(reach() / Cell));
    const auto side = static_cast<unsigned int>(2 * half + 1);
    osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array, normals = new osg::Vec3Array;
    osg::ref_ptr<osg::Vec4ubArray> colors = new osg::Vec4ubArray;
    const Vec3 pavement(0.58f, 0.57f, 0.54f), grass(0.42f, 0.54f, 0.29f),
        meadow(0.56f, 0.6f, 0.36f);
    for (int j = -half; j <= half; ++j)
        for (int i = -half; i <= half; ++i)
        {
            const double x = i * Cell, y = j * Cell, step = 0.5 * Cell;
            vertices->push_back(osg::Vec3d(x, y, heightAt(x, y)));
            Vec3 normal(float(heightAt(x - step, y) - heightAt(x + step, y)),
                        float(heightAt(x, y - step) - heightAt(x, y + step)), float(Cell));
            normal.normalize();
            normals->push_back(normal);
            const double patches = 0.5 + 0.5 * std::sin(0.031 * x) * std::sin(0.043 * y + 1.0);
            const double outside = smoothStep(0.35 * _town, 0.8 * _town, std::hypot(x, y));
            const osg::Vec4ub green = mixed(grass, meadow, patches);
            colors->push_back(
                mixed(pavement, Vec3(green.r(), green.g(), green.b()) / 255.0f, outside));
        }
    return makeSheet(vertices, normals, colors, side, side);
}

osg::ref_ptr<osg::Geode> Ground::makeStreet(const Vec2d& from, const Vec2d& to, double width) const
{
    const Vec2d along = to - from;
    const Vec2d across = Vec2d(-along.y(), along.x()) / along.length();
    const auto parts = static_cast<unsigned int>(std::ceil(along.length() / 6.0));
    // Pavements, and the lane between them.
    const double places[] = {-0.5, -0.36, -0.36, 0.36, 0.36, 0.5};
    osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array, normals = new osg::Vec3Array;
    osg::ref_ptr<osg::Vec4ubArray> colors = new osg::Vec4ubArray;
    for (unsigned int i = 0; i <= parts; ++i)
        for (std::size_t k = 0; k < 6; ++k)
        {
            const Vec2d place = from + along * (double(i) / parts) - across * (places[k] * width);
            vertices->push_back(
                osg::Vec3d(place.x(), place.y(), heightAt(place.x(), place.y()) + 0.3));
            normals->push_back(Vec3(0.0f, 0.0f, 1.0f));
            const bool isLane = k == 2 || k == 3;
            colors->push_back(isLane ? osg::Vec4ub(84, 85, 88, 255)
                                     : osg::Vec4ub(166, 163, 156, 255));
        }
    return makeSheet(vertices, normals, colors, 6, parts + 1);
}
