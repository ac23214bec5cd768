// SPDX-License-Identifier: MIT
#include "PlantMeshes.h"

#include <cmath>

namespace plant
{

namespace
{

constexpr float Pi = 3.14159265358979f;

class MeshBuilder
{
public:
    unsigned int vertex(const osg::Vec3& position, const osg::Vec3& normal)
    {
        _vertices->push_back(position);
        _normals->push_back(normal / normal.length());
        return static_cast<unsigned int>(_vertices->size() - 1);
    }

    void triangle(unsigned int a, unsigned int b, unsigned int c)
    {
        _indices->push_back(a);
        _indices->push_back(b);
        _indices->push_back(c);
    }

    /// Counterclockwise.
    void quad(const osg::Vec3& a, const osg::Vec3& b, const osg::Vec3& c, const osg::Vec3& d)
    {
        const osg::Vec3 normal = (b - a) ^ (d - a);
        const unsigned int first = vertex(a, normal);
        for (const osg::Vec3& corner : {b, c, d})
            vertex(corner, normal);
        triangle(first, first + 1, first + 2);
        triangle(first, first + 2, first + 3);
    }

    void box(const osg::Vec3& low, const osg::Vec3& high)
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

    /// A surface over a grid; `point(i, j)` gives position and normal. The grid closes in i if
    /// point(columns, j) is equal to point(0, j): positions are then the same to the last bit.
    template <class Point> void grid(int columns, int rows, const Point& point)
    {
        const unsigned int first = static_cast<unsigned int>(_vertices->size());
        for (int j = 0; j <= rows; ++j)
        {
            for (int i = 0; i <= columns; ++i)
            {
                const auto [position, normal] = point(i, j);
                vertex(position, normal);
            }
        }
        for (int j = 0; j < rows; ++j)
        {
            for (int i = 0; i < columns; ++i)
            {
                const unsigned int a = first + j * (columns + 1) + i, b = a + columns + 1;
                triangle(a, a + 1, b + 1);
                triangle(a, b + 1, b);
            }
        }
    }

    /// A flat end of radius 1 at z, that looks up or down.
    void disc(int sides, float z, bool up);

    osg::ref_ptr<osg::Geometry> finish() const
    {
        osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
        geometry->setVertexArray(_vertices);
        geometry->setNormalArray(_normals, osg::Array::BIND_PER_VERTEX);
        geometry->addPrimitiveSet(_indices);
        geometry->setUseVertexBufferObjects(true);
        geometry->setUseDisplayList(false);
        return geometry;
    }

private:
    osg::ref_ptr<osg::Vec3Array> _vertices = new osg::Vec3Array;
    osg::ref_ptr<osg::Vec3Array> _normals = new osg::Vec3Array;
    osg::ref_ptr<osg::DrawElementsUInt> _indices = new osg::DrawElementsUInt(GL_TRIANGLES);
};

/// On the unit circle; the last of n is the first one.
osg::Vec3 onCircle(int i, int n)
{
    const float angle = 2.0f * Pi * float(i % n) / float(n);
    return {std::cos(angle), std::sin(angle), 0.0f};
}

void MeshBuilder::disc(int sides, float z, bool up)
{
    const osg::Vec3 normal(0.0f, 0.0f, up ? 1.0f : -1.0f);
    const unsigned int center = vertex({0.0f, 0.0f, z}, normal);
    for (int i = 0; i <= sides; ++i)
        vertex(onCircle(i, sides) + osg::Vec3(0.0f, 0.0f, z), normal);
    for (unsigned int i = center + 1; i <= center + sides; ++i)
        triangle(center, up ? i : i + 1, up ? i + 1 : i);
}

void wall(MeshBuilder& mesh, int sides)
{
    mesh.grid(sides, 1,
              [sides](int i, int j)
              {
                  const osg::Vec3 out = onCircle(i, sides);
                  return std::make_pair(out + osg::Vec3(0.0f, 0.0f, float(j)), out);
              });
}

/// A tube of radius `tube` around the circle of radius 1 in z = 0, over `turn` of its whole.
void torus(MeshBuilder& mesh, int sides, int around, float tube, int turn)
{
    mesh.grid(around, sides,
              [=](int i, int j)
              {
                  const osg::Vec3 out = onCircle(i, around * turn);
                  const osg::Vec3 ring = onCircle(j, sides);
                  const osg::Vec3 normal = out * ring.x() + osg::Vec3(0.0f, 0.0f, ring.y());
                  return std::make_pair(out + normal * tube, normal);
              });
}

} // namespace

osg::ref_ptr<osg::Geometry> makeBox()
{
    MeshBuilder mesh;
    mesh.box({-0.5f, -0.5f, -0.5f}, {0.5f, 0.5f, 0.5f});
    return mesh.finish();
}

osg::ref_ptr<osg::Geometry> makeCylinder(int sides)
{
    MeshBuilder mesh;
    wall(mesh, sides);
    mesh.disc(sides, 0.0f, false);
    mesh.disc(sides, 1.0f, true);
    return mesh.finish();
}

osg::ref_ptr<osg::Geometry> makeVessel(int sides, float dome)
{
    MeshBuilder mesh;
    wall(mesh, sides);
    mesh.disc(sides, 0.0f, false);
    const int rows = sides / 4;
    mesh.grid(sides, rows,
              [=](int i, int j)
              {
                  const osg::Vec3 out = onCircle(i, sides);
                  const float up = j == rows ? 1.0f : std::sin(0.5f * Pi * float(j) / rows);
                  const float side = j == rows ? 0.0f : std::cos(0.5f * Pi * float(j) / rows);
                  return std::make_pair(out * side + osg::Vec3(0.0f, 0.0f, 1.0f + dome * up),
                                        out * (side * dome) + osg::Vec3(0.0f, 0.0f, up));
              });
    return mesh.finish();
}

osg::ref_ptr<osg::Geometry> makeElbow(int sides, float tube)
{
    MeshBuilder mesh;
    torus(mesh, sides, sides / 2, tube, 4);
    return mesh.finish();
}

osg::ref_ptr<osg::Geometry> makeWheel(int sides, float tube)
{
    MeshBuilder mesh;
    torus(mesh, sides, 2 * sides, tube, 1);
    const float half = 0.5f * tube;
    mesh.box({-1.0f, -half, -half}, {1.0f, half, half});
    mesh.box({-half, -1.0f, -half}, {half, 1.0f, half});
    return mesh.finish();
}

osg::ref_ptr<osg::Geometry> makeLadder(int rungs)
{
    MeshBuilder mesh;
    const auto plate = [&](float x0, float x1, float z0, float z1) {
        mesh.quad({x0, 0.0f, z0}, {x1, 0.0f, z0}, {x1, 0.0f, z1}, {x0, 0.0f, z1});
    };
    plate(-0.5f, -0.4f, 0.0f, 1.0f);
    plate(0.4f, 0.5f, 0.0f, 1.0f);
    for (int i = 0; i < rungs; ++i)
        plate(-0.4f, 0.4f, (float(i) + 0.4f) / rungs, (float(i) + 0.6f) / rungs);
    return mesh.finish();
}

} // namespace plant
