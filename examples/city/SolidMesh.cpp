// SPDX-License-Identifier: MIT
#include "SolidMesh.h"

#include <algorithm>
#include <cmath>

using osg::Vec2;
using osg::Vec3;

namespace
{

constexpr float Bay = 3.2f, Storey = 3.0f; ///< Metres from window to window.

/// Sun in the south-east, so that walls differ under a headlight, too.
float sunlight(const Vec3& normal)
{
    const Vec3 sun(0.48f, -0.6f, 0.64f);
    return 0.72f + 0.2f * std::max(normal * sun, -0.6f);
}

float windowsIn(float length, float each)
{
    return std::max(1.0f, std::round(length / each));
}

} // namespace

const Vec2 SolidMesh::Blank(0.03f, 0.03f);

SolidMesh::SolidMesh()
    : _vertices(new osg::Vec3Array), _normals(new osg::Vec3Array(osg::Array::BIND_PER_VERTEX)),
      _colors(new osg::Vec4ubArray(osg::Array::BIND_PER_VERTEX)), _texCoords(new osg::Vec2Array),
      _triangles(new osg::DrawElementsUInt(GL_TRIANGLES))
{
    _colors->setNormalize(true);
}

void SolidMesh::face(const std::vector<Vec3>& corners, const Vec3& color, const Vec2& windows)
{
    const auto first = static_cast<unsigned int>(_vertices->size());
    Vec3 normal = (corners[1] - corners[0]) ^ (corners[2] - corners[0]);
    normal.normalize();
    const Vec3 shade = color * (255.0f * sunlight(normal));
    const bool isBlank = windows.x() == 0.0f;
    for (std::size_t i = 0; i < corners.size(); ++i)
    {
        _vertices->push_back(corners[i]);
        _normals->push_back(normal);
        _colors->push_back(osg::Vec4ub(static_cast<unsigned char>(std::min(shade.x(), 255.0f)),
                                       static_cast<unsigned char>(std::min(shade.y(), 255.0f)),
                                       static_cast<unsigned char>(std::min(shade.z(), 255.0f)),
                                       255));
        _texCoords->push_back(
            isBlank ? Blank
                    : Vec2(i == 1 || i == 2 ? windows.x() : 0.0f, i >= 2 ? windows.y() : 0.0f));
    }
    for (unsigned int i = 2; i < corners.size(); ++i)
        for (const unsigned int corner : {0u, i - 1, i})
            _triangles->push_back(first + corner);
}

void SolidMesh::wall(const Vec3& from, const Vec3& to, float top, const Vec3& color,
                     bool hasWindows)
{
    const Vec2 windows(windowsIn((to - from).length(), Bay), windowsIn(top - from.z(), Storey));
    face({from, to, {to.x(), to.y(), top}, {from.x(), from.y(), top}}, color,
         hasWindows ? windows : Vec2());
}

void SolidMesh::box(const Vec3& low, const Vec3& high, const Vec3& walls, const Vec3& roof,
                    bool hasWindows)
{
    const Vec3 a(low), b(high.x(), low.y(), low.z()), c(high.x(), high.y(), low.z()),
        d(low.x(), high.y(), low.z());
    const Vec3 up(0.0f, 0.0f, high.z() - low.z());
    for (const auto& [from, to] : {std::pair(a, b), {b, c}, {c, d}, {d, a}})
        wall(from, to, high.z(), walls, hasWindows);
    face({a + up, b + up, c + up, d + up}, roof);
    face({a, d, c, b}, walls);
}

void SolidMesh::prism(const std::vector<float>& xs, const std::vector<float>& ys,
                      const std::vector<bool>& filled, float low, float high, const Vec3& walls,
                      const Vec3& roof)
{
    const int columns = int(xs.size()) - 1, rows = int(ys.size()) - 1;
    const auto isFilled = [&](int x, int y)
    { return x >= 0 && y >= 0 && x < columns && y < rows && filled[std::size_t(y * columns + x)]; };
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x)
        {
            if (!isFilled(x, y))
                continue;
            const Vec3 a(xs[x], ys[y], low), b(xs[x + 1], ys[y], low), c(xs[x + 1], ys[y + 1], low),
                d(xs[x], ys[y + 1], low), up(0.0f, 0.0f, high - low);
            if (!isFilled(x, y - 1))
                wall(a, b, high, walls, true);
            if (!isFilled(x + 1, y))
                wall(b, c, high, walls, true);
            if (!isFilled(x, y + 1))
                wall(c, d, high, walls, true);
            if (!isFilled(x - 1, y))
                wall(d, a, high, walls, true);
            face({a + up, b + up, c + up, d + up}, roof);
            face({a, d, c, b}, walls);
        }
}

void SolidMesh::gabled(const Vec3& low, const Vec3& high, float ridge, const Vec3& walls,
                       const Vec3& roof)
{
    const Vec3 a(low), b(high.x(), low.y(), low.z()), c(high.x(), high.y(), low.z()),
        d(low.x(), high.y(), low.z());
    for (const auto& [from, to] : {std::pair(a, b), {b, c}, {c, d}, {d, a}})
        wall(from, to, high.z(), walls, true);
    const Vec3 up(0.0f, 0.0f, high.z() - low.z());
    const Vec3 west(low.x(), 0.5f * (low.y() + high.y()), ridge), east(high.x(), west.y(), ridge);
    face({b + up, c + up, east}, walls);
    face({d + up, a + up, west}, walls);
    face({a + up, b + up, east, west}, roof);
    face({c + up, d + up, west, east}, roof);
    face({a, d, c, b}, walls);
}

void SolidMesh::turned(const std::vector<Vec2>& radiusAndHeight, int sides, const Vec3& color)
{
    const auto corner = [&](std::size_t ring, int side)
    {
        // The last one is the first one to the last bit.
        const double angle = 2.0 * osg::PI * (side % sides) / sides;
        const float radius = radiusAndHeight[ring].x();
        return Vec3(radius * float(std::cos(angle)), radius * float(std::sin(angle)),
                    radiusAndHeight[ring].y());
    };
    std::vector<Vec3> bottom, top;
    for (int side = 0; side < sides; ++side)
    {
        bottom.push_back(corner(0, sides - side));
        top.push_back(corner(radiusAndHeight.size() - 1, side));
        for (std::size_t ring = 0; ring + 1 < radiusAndHeight.size(); ++ring)
        {
            const Vec3 a = corner(ring, side), b = corner(ring, side + 1),
                       c = corner(ring + 1, side + 1), d = corner(ring + 1, side);
            if (a == b)
                face({a, c, d}, color);
            else if (c == d)
                face({a, b, c}, color);
            else
                face({a, b, c, d}, color);
        }
    }
    if (radiusAndHeight.front().x() > 0.0f)
        face(bottom, color);
    if (radiusAndHeight.back().x() > 0.0f)
        face(top, color);
}

osg::BoundingBox SolidMesh::getBox() const
{
    osg::BoundingBox box;
    for (const Vec3& vertex : *_vertices)
        box.expandBy(vertex);
    return box;
}

osg::ref_ptr<osg::Geometry> SolidMesh::make() const
{
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setUseVertexBufferObjects(true);
    geometry->setUseDisplayList(false);
    geometry->setVertexArray(_vertices);
    geometry->setNormalArray(_normals);
    geometry->setColorArray(_colors);
    geometry->setTexCoordArray(0, _texCoords);
    geometry->addPrimitiveSet(_triangles);
    return geometry;
}
