// SPDX-License-Identifier: MIT
#include "Parts.h"

#include <osg/Math>
#include <osg/Matrixd>

#include <cstdio>

using osg::Vec3d;
using osgLabels::Shape;

namespace
{

/// Turns z into `axis`.
osg::Quat alongZ(const Vec3d& axis)
{
    osg::Quat rotation;
    rotation.makeRotate(Vec3d(0.0, 0.0, 1.0), axis);
    return rotation;
}

Vec3d unit(Vec3d v)
{
    v.normalize();
    return v;
}

} // namespace

Parts::Parts(const RefinerySettings& settings, const AddPrimitive& add)
    : _add(add), _left(settings.objects), _engine(settings.seed)
{
}

double Parts::random(double low, double high)
{
    // std::uniform_real_distribution differs between standard libraries.
    return low + (high - low) * (_engine() / 4294967296.0);
}

int Parts::choice(int count)
{
    return int(_engine() % unsigned(count));
}

void Parts::put(Shape shape, const Vec3d& size, const Vec3d& position, const osg::Quat& rotation,
                const std::string& name)
{
    if (_left == 0)
        return;
    --_left;
    osgLabels::Primitive primitive;
    primitive.shape = shape;
    primitive.size = size;
    primitive.position = position;
    primitive.rotation = rotation;
    primitive.color = color;
    primitive.name = name;
    _add(primitive);
}

void Parts::box(const Vec3d& low, const Vec3d& high, const std::string& name)
{
    put(Shape::Box, (high - low) * 0.5, (low + high) * 0.5, osg::Quat(), name);
}

void Parts::bar(const Vec3d& a, const Vec3d& b, double width, const std::string& name)
{
    const double half = 0.5 * width;
    put(Shape::Box, {half, half, 0.5 * (b - a).length()}, (a + b) * 0.5, alongZ(b - a), name);
}

void Parts::cylinder(const Vec3d& a, const Vec3d& b, double radius, const std::string& name)
{
    put(Shape::Cylinder, {radius, radius, 0.5 * (b - a).length()}, (a + b) * 0.5, alongZ(b - a),
        name);
}

void Parts::sphere(const Vec3d& center, double radius, const std::string& name)
{
    put(Shape::Sphere, {radius, radius, radius}, center, osg::Quat(), name);
}

void Parts::dish(const Vec3d& base, const Vec3d& axis, double radius, double height,
                 const std::string& name)
{
    put(Shape::Dish, {radius, radius, height}, base, alongZ(axis), name);
}

void Parts::snout(const Vec3d& a, const Vec3d& b, double radiusA, double radiusB,
                  const std::string& name)
{
    put(Shape::Frustum, {radiusA, radiusB, 0.5 * (b - a).length()}, (a + b) * 0.5, alongZ(b - a),
        name);
}

void Parts::hopper(const Vec3d& top, double half, double height, const std::string& name)
{
    put(Shape::Pyramid, {half, half, 0.5 * height}, top - Vec3d(0.0, 0.0, 0.5 * height),
        osg::Quat(osg::PI, Vec3d(1.0, 0.0, 0.0)), name);
}

void Parts::ring(const Vec3d& center, const Vec3d& axis, double radius, double tube,
                 const std::string& name)
{
    put(Shape::Torus, {radius, tube, 2.0 * osg::PI}, center, alongZ(axis), name);
}

void Parts::ground(const Vec3d& center, double halfX, double halfY)
{
    put(Shape::Quad, {halfX, halfY, 0.0}, center, osg::Quat(), {});
}

/// From the direction `in` to `out`, which are perpendicular: a quarter of a ring.
void Parts::elbow(const Vec3d& corner, const Vec3d& in, const Vec3d& out, double bend,
                  double radius, const std::string& name)
{
    const Vec3d x = -out, y = in, z = x ^ y;
    const osg::Matrixd frame(x.x(), x.y(), x.z(), 0.0, y.x(), y.y(), y.z(), 0.0, z.x(), z.y(),
                             z.z(), 0.0, 0.0, 0.0, 0.0, 1.0);
    put(Shape::Torus, {bend, radius, 0.5 * osg::PI}, corner - in * bend + out * bend,
        frame.getRotate(), name);
}

void Parts::route(const std::vector<Vec3d>& points, double radius, const std::string& line)
{
    const double bend = 3.0 * radius;
    unsigned int spool = 0;
    const auto next = [&]
    {
        char text[8];
        std::snprintf(text, sizeof text, "/%02u", ++spool);
        return line + text;
    };
    for (std::size_t i = 0; i + 1 < points.size(); ++i)
    {
        const Vec3d along = unit(points[i + 1] - points[i]);
        const bool first = i == 0, last = i + 2 == points.size();
        cylinder(points[i] + along * (first ? 0.0 : bend),
                 points[i + 1] - along * (last ? 0.0 : bend), radius, next());
        if (!last)
            elbow(points[i + 1], along, unit(points[i + 2] - points[i + 1]), bend, radius, next());
    }
}
