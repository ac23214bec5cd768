// SPDX-License-Identifier: MIT
#include <osgLabels/UnitMesh.h>

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>

namespace osgLabels
{

namespace
{

using glm::vec3;

/// A point of the unit circle; the last of n is the first to the last bit.
vec3 onCircle(int i, int n)
{
    const float angle = 2.0f * glm::pi<float>() * float(i % n) / float(n);
    return {std::cos(angle), std::sin(angle), 0.0f};
}

class MeshBuilder
{
public:
    std::uint16_t point(const vec3& position, const vec3& normal)
    {
        mesh.points.push_back({position, normal});
        return std::uint16_t(mesh.points.size() - 1);
    }

    void triangle(int a, int b, int c)
    {
        for (int index : {a, b, c})
            mesh.triangles.push_back(std::uint16_t(index));
    }

    void quad(const vec3& a, const vec3& b, const vec3& c, const vec3& d)
    {
        const vec3 normal = glm::normalize(glm::cross(b - a, d - a));
        const int first = point(a, normal);
        for (const vec3& corner : {b, c, d})
            point(corner, normal);
        triangle(first, first + 1, first + 2);
        triangle(first, first + 2, first + 3);
    }

    /// `at(i, j)` gives a point; i goes to the right and j up, seen from outside.
    template <class At> void grid(int columns, int rows, const At& at)
    {
        const int first = int(mesh.points.size());
        for (int j = 0; j <= rows; ++j)
            for (int i = 0; i <= columns; ++i)
                mesh.points.push_back(at(i, j));
        for (int j = 0; j < rows; ++j)
        {
            for (int i = 0; i < columns; ++i)
            {
                const int a = first + j * (columns + 1) + i, b = a + columns + 1;
                triangle(a, a + 1, b + 1);
                triangle(a, b + 1, b);
            }
        }
    }

    /// A fan around a circle that `at(i)` gives, counterclockwise against `normal`.
    template <class At> void disc(int sides, const vec3& normal, const At& at)
    {
        const int first = int(mesh.points.size());
        for (int i = 0; i < sides; ++i)
            point(at(i), normal);
        for (int i = 1; i + 1 < sides; ++i)
            triangle(first, first + i, first + i + 1);
    }

    UnitMesh mesh;
};

void addBox(MeshBuilder& mesh)
{
    const auto corner = [](int i)
    { return vec3(i & 1 ? 1.0f : -1.0f, i & 2 ? 1.0f : -1.0f, i & 4 ? 1.0f : -1.0f); };
    static const int faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                    {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    for (const auto& face : faces)
        mesh.quad(corner(face[0]), corner(face[1]), corner(face[2]), corner(face[3]));
}

void addPyramid(MeshBuilder& mesh)
{
    const vec3 corners[] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}}, top(0, 0, 1);
    mesh.quad(corners[0], corners[3], corners[2], corners[1]);
    for (int i = 0; i < 4; ++i)
    {
        const vec3 &a = corners[i], &b = corners[(i + 1) % 4];
        const vec3 normal = glm::normalize(glm::cross(b - a, top - a));
        const int first = mesh.point(a, normal);
        mesh.point(b, normal);
        mesh.point(top, normal);
        mesh.triangle(first, first + 1, first + 2);
    }
}

/// Cylinders and frusta.
void addTube(MeshBuilder& mesh, int sides)
{
    const vec3 up(0.0f, 0.0f, 1.0f);
    mesh.grid(sides, 1,
              [=](int i, int j) -> SurfacePoint
              {
                  const vec3 out = onCircle(i, sides);
                  return {out + (j ? up : -up), out};
              });
    mesh.disc(sides, up, [=](int i) { return onCircle(i, sides) + up; });
    mesh.disc(sides, -up, [=](int i) { return onCircle(sides - i, sides) - up; });
}

/// From the height `low` (-1 or 0) of the unit sphere to its top.
void addDome(MeshBuilder& mesh, int sides, bool half)
{
    const int rows = half ? std::max(sides / 4, 2) : std::max(sides / 2, 3);
    mesh.grid(sides, rows,
              [=](int i, int j) -> SurfacePoint
              {
                  const float from = half ? 0.0f : -0.5f, share = float(j) / float(rows);
                  const float angle = glm::pi<float>() * (from + (half ? 0.5f : 1.0f) * share);
                  const bool pole = j == rows || (j == 0 && !half);
                  const vec3 side = onCircle(i, sides) * (pole ? 0.0f : std::cos(angle));
                  const vec3 position(side.x, side.y, std::sin(angle));
                  return {position, position};
              });
    if (half)
        mesh.disc(sides, vec3(0.0f, 0.0f, -1.0f),
                  [=](int i) { return onCircle(sides - i, sides); });
}

/// x: along the turn, 0 to 1; y and z: around the tube. See placePoint().
void addTorus(MeshBuilder& mesh, int sides, int segments)
{
    const auto ring = [sides](int i, float x)
    {
        const vec3 c = onCircle(i, sides);
        return vec3(x, c.x, c.y);
    };
    mesh.grid(segments, sides,
              [=](int i, int j) -> SurfacePoint {
                  return {ring(j, float(i) / float(segments)), ring(j, 0.0f)};
              });
    mesh.disc(sides, vec3(-1.0f, 0.0f, 0.0f), [=](int i) { return ring(i, 0.0f); });
    mesh.disc(sides, vec3(1.0f, 0.0f, 0.0f), [=](int i) { return ring(sides - i, 1.0f); });
}

} // namespace

MeshKind kindOf(const ObjectRecord& record)
{
    MeshKind kind;
    kind.shape = shapeOf(record);
    if (kind.shape != Shape::Torus)
        return kind;
    // A little more than a quarter still is one.
    const float turn = record.size.z / (1.02f * glm::half_pi<float>());
    kind.quarters = turn <= 1.0f ? 1 : turn <= 2.0f ? 2 : 4;
    // As the error of a polygon goes with the square of its sides.
    const float share = record.size.y / (record.size.x + record.size.y);
    kind.tubeDivisor = share > 0.3f ? 1 : share > 0.05f ? 2 : 4;
    return kind;
}

UnitMesh makeUnitMesh(const MeshKind& kind, int sides)
{
    MeshBuilder mesh;
    switch (kind.shape)
    {
    case Shape::Box:
    case Shape::Extrusion:
        addBox(mesh);
        break;
    case Shape::Cylinder:
    case Shape::Frustum:
        addTube(mesh, sides);
        break;
    case Shape::Sphere:
    case Shape::Dish:
        addDome(mesh, sides, kind.shape == Shape::Dish);
        break;
    case Shape::Pyramid:
        addPyramid(mesh);
        break;
    case Shape::Torus:
        addTorus(mesh, std::max(sides / kind.tubeDivisor, 4),
                 std::max(sides * kind.quarters / 4, 2));
        break;
    case Shape::Quad:
        mesh.quad({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0});
        break;
    default:
        break;
    }
    return mesh.mesh;
}

int levelsOf(Shape shape)
{
    switch (shape)
    {
    case Shape::Cylinder:
    case Shape::Frustum:
    case Shape::Sphere:
    case Shape::Dish:
    case Shape::Torus:
        return NumLevels;
    default:
        return 1;
    }
}

int levelFor(float radiusPixels)
{
    // The middle of a side lies r (1 - cos(pi / n)) inside of the circle, about r pi^2 / (2 n^2).
    for (int level = NumLevels - 1; level > 0; --level)
        if (float(LevelSides[level]) >= glm::pi<float>() * std::sqrt(radiusPixels))
            return level;
    return 0;
}

} // namespace osgLabels
