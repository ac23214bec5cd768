// SPDX-License-Identifier: MIT
#include "ExtremeMesh.h"

#include <osg/Geometry>

#include <cmath>

namespace
{

constexpr float Pi = 3.14159265f;

/// The last of n is the first one.
osg::Vec3 onCircle(unsigned int i, unsigned int n)
{
    const float angle = 2.0f * Pi * float(i % n) / float(n);
    return {std::cos(angle), std::sin(angle), 0.0f};
}

} // namespace

void ExtremeMesh::triangle(const osg::Vec3& a, const osg::Vec3& b, const osg::Vec3& c)
{
    corners.insert(corners.end(), {a, b, c});
}

void ExtremeMesh::quad(const osg::Vec3& a, const osg::Vec3& b, const osg::Vec3& c,
                       const osg::Vec3& d)
{
    triangle(a, b, c);
    triangle(a, c, d);
}

void ExtremeMesh::box(const osg::Vec3& low, const osg::Vec3& high)
{
    const auto corner = [&](int i)
    {
        return osg::Vec3(i & 1 ? high.x() : low.x(), i & 2 ? high.y() : low.y(),
                         i & 4 ? high.z() : low.z());
    };
    static const int faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                    {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    for (const auto& face : faces)
        quad(corner(face[0]), corner(face[1]), corner(face[2]), corner(face[3]));
}

void ExtremeMesh::sphere(const osg::Vec3& center, float radius, int segments)
{
    const int rows = segments / 2;
    const auto point = [&](int i, int j)
    {
        const float lift = Pi * float(j) / float(rows);
        const float side = j == 0 || j == rows ? 0.0f : std::sin(lift);
        osg::Vec3 p = onCircle(i, segments) * side;
        p.z() = -std::cos(lift);
        return center + p * radius;
    };
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < segments; ++i)
            quad(point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1));
}

void ExtremeMesh::plate(float half, float z)
{
    quad({-half, -half, z}, {half, -half, z}, {half, half, z}, {-half, half, z});
}

void ExtremeMesh::fan(unsigned int count)
{
    for (unsigned int i = 0; i < count; ++i)
        triangle({0.0f, 0.0f, 0.4f}, {0.0f, 0.0f, 1.8f},
                 onCircle(i, count) * 1.1f + osg::Vec3(0.0f, 0.0f, 1.0f));
}

void ExtremeMesh::sheet(int cells)
{
    const auto point = [&](int i, int j)
    {
        const float x = 2.0f * float(i) / float(cells) - 1.0f;
        const float y = 2.0f * float(j) / float(cells) - 1.0f;
        return osg::Vec3(x, y, 1.0f + 0.25f * std::sin(5.0f * x) * std::cos(4.0f * y));
    };
    for (int j = 0; j < cells; ++j)
        for (int i = 0; i < cells; ++i)
            quad(point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1));
}

void ExtremeMesh::moebius(int segments)
{
    const auto point = [&](int i, bool upper)
    {
        // After one turn the sides have changed places.
        const bool swapped = i == segments;
        const float turn = Pi * float(i % segments) / float(segments);
        const float side = upper != swapped ? 0.4f : -0.4f;
        const osg::Vec3 out = onCircle(i, segments);
        return out * (1.0f + side * std::cos(turn)) +
               osg::Vec3(0.0f, 0.0f, 1.0f + side * std::sin(turn));
    };
    for (int i = 0; i < segments; ++i)
        quad(point(i, false), point(i + 1, false), point(i + 1, true), point(i, true));
}

void ExtremeMesh::flip(std::size_t n)
{
    for (std::size_t i = 0; i < corners.size(); i += 3 * n)
        std::swap(corners[i], corners[i + 1]);
}

void ExtremeMesh::duplicate(std::size_t n)
{
    const std::size_t size = corners.size();
    for (std::size_t i = 0; i < size; i += 3 * n)
    {
        const osg::Vec3 a = corners[i], b = corners[i + 1], c = corners[i + 2];
        triangle(a, b, c);
    }
}

void ExtremeMesh::transform(const osg::Matrixd& matrix)
{
    for (osg::Vec3& corner : corners)
        corner = osg::Vec3(osg::Vec3d(corner) * matrix);
}

osg::ref_ptr<osg::Geode> ExtremeMesh::createNode() const
{
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setVertexArray(new osg::Vec3Array(corners.begin(), corners.end()));
    osg::ref_ptr<osg::Vec3Array> normals = new osg::Vec3Array(osg::Array::BIND_PER_VERTEX);
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3)
    {
        osg::Vec3d normal =
            osg::Vec3d(corners[i + 1] - corners[i]) ^ osg::Vec3d(corners[i + 2] - corners[i]);
        normal.normalize();
        normals->insert(normals->end(), 3, normal);
    }
    geometry->setNormalArray(normals);
    if (!corners.empty())
        geometry->addPrimitiveSet(
            new osg::DrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(corners.size())));
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(geometry);
    return geode;
}
