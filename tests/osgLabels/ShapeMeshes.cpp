// SPDX-License-Identifier: MIT
#include "ShapeMeshes.h"

#include <glm/gtc/constants.hpp>

#include <cmath>

using osgLabels::Shape;

std::vector<glm::vec3> ShapeMesh::vertices() const
{
    std::vector<glm::vec3> floats;
    for (const glm::dvec3& point : points)
        floats.emplace_back(point);
    return floats;
}

void ShapeMesh::move(const glm::dquat& rotation, const glm::dvec3& to)
{
    for (glm::dvec3& point : points)
        point = rotation * point + to;
    truth.rotation = truth.rotation * glm::inverse(rotation);
    truth.origin = rotation * truth.origin + to;
}

namespace shapemesh
{

namespace
{

ShapeMesh made(Shape shape, const glm::dvec3& size)
{
    ShapeMesh mesh;
    mesh.truth.shape = shape;
    mesh.truth.size = size;
    return mesh;
}

void addQuad(ShapeMesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d)
{
    mesh.indices.insert(mesh.indices.end(), {a, b, c, a, c, d});
}

/// A grid of (columns + 1) x (rows + 1) points and its triangles, column by column.
template <class At> void addGrid(ShapeMesh& mesh, int columns, int rows, const At& at)
{
    const auto first = std::uint32_t(mesh.points.size());
    for (int i = 0; i <= columns; ++i)
        for (int k = 0; k <= rows; ++k)
            mesh.points.push_back(at(double(i) / columns, double(k) / rows));
    const auto index = [&](int i, int k) { return first + std::uint32_t(i * (rows + 1) + k); };
    for (int i = 0; i != columns; ++i)
        for (int k = 0; k != rows; ++k)
            addQuad(mesh, index(i, k), index(i + 1, k), index(i + 1, k + 1), index(i, k + 1));
}

/// A disc of corners at(0..1), at(1) being at(0).
template <class At>
void addDisc(ShapeMesh& mesh, int corners, Ends ends, const glm::dvec3& middle, const At& at)
{
    if (ends == Open)
        return;
    const auto first = std::uint32_t(mesh.points.size());
    for (int i = 0; i != corners; ++i)
        mesh.points.push_back(at(double(i) / corners));
    if (ends == FanCapped)
        mesh.points.push_back(middle);
    const auto count = std::uint32_t(corners);
    for (std::uint32_t i = 0; i != count; ++i)
        if (ends == FanCapped)
            mesh.indices.insert(mesh.indices.end(),
                                {first + i, first + (i + 1) % count, first + count});
        else if (i + 2 < count)
            mesh.indices.insert(mesh.indices.end(), {first, first + i + 1, first + i + 2});
}

glm::dvec3 polar(double radius, double turn, double z)
{
    return {radius * std::cos(turn), radius * std::sin(turn), z};
}

constexpr double TwoPi = glm::two_pi<double>();

} // namespace

ShapeMesh box(const glm::dvec3& half, bool sharedVertices)
{
    ShapeMesh mesh = made(Shape::Box, half);
    if (sharedVertices)
    {
        for (int i = 0; i != 8; ++i)
            mesh.points.push_back(half *
                                  glm::dvec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
        addQuad(mesh, 0, 2, 3, 1);
        addQuad(mesh, 4, 5, 7, 6);
        addQuad(mesh, 0, 1, 5, 4);
        addQuad(mesh, 2, 6, 7, 3);
        addQuad(mesh, 0, 4, 6, 2);
        addQuad(mesh, 1, 3, 7, 5);
        return mesh;
    }
    for (int axis = 0; axis != 3; ++axis)
        for (const double side : {-1.0, 1.0})
            addGrid(mesh, 1, 1,
                    [&](double u, double v)
                    {
                        glm::dvec3 p;
                        p[axis] = side;
                        p[(axis + 1) % 3] = side * (2.0 * u - 1.0);
                        p[(axis + 2) % 3] = 2.0 * v - 1.0;
                        return p * half;
                    });
    return mesh;
}

ShapeMesh quad(double x, double y, int cells)
{
    ShapeMesh mesh = made(Shape::Quad, {x, y, 0.0});
    addGrid(mesh, cells, cells,
            [&](double u, double v)
            { return glm::dvec3((2.0 * u - 1.0) * x, (2.0 * v - 1.0) * y, 0.0); });
    return mesh;
}

ShapeMesh frustum(double low, double high, double half, int around, int along, Ends ends)
{
    ShapeMesh mesh = low == high ? made(Shape::Cylinder, {low, low, half})
                                 : made(Shape::Frustum, {low, high, half});
    addGrid(mesh, around, along,
            [&](double u, double v)
            { return polar(low + (high - low) * v, TwoPi * u, half * (2.0 * v - 1.0)); });
    if (low > 0.0)
        addDisc(mesh, around, ends, {0, 0, -half},
                [&](double u) { return polar(low, -TwoPi * u, -half); });
    if (high > 0.0)
        addDisc(mesh, around, ends, {0, 0, half},
                [&](double u) { return polar(high, TwoPi * u, half); });
    return mesh;
}

ShapeMesh sphere(double radius, int around, int along)
{
    ShapeMesh mesh = made(Shape::Sphere, glm::dvec3(radius));
    addGrid(mesh, around, along,
            [&](double u, double v)
            {
                const double latitude = (v - 0.5) * glm::pi<double>();
                return polar(radius * std::cos(latitude), TwoPi * u, radius * std::sin(latitude));
            });
    return mesh;
}

ShapeMesh dish(double radius, double height, int around, int along, Ends base)
{
    ShapeMesh mesh = made(Shape::Dish, {radius, radius, height});
    addGrid(mesh, around, along,
            [&](double u, double v)
            {
                const double latitude = 0.5 * v * glm::pi<double>();
                return polar(radius * std::cos(latitude), TwoPi * u, height * std::sin(latitude));
            });
    addDisc(mesh, around, base, {0, 0, 0},
            [&](double u) { return polar(radius, -TwoPi * u, 0.0); });
    return mesh;
}

ShapeMesh pyramid(const glm::dvec3& half, bool base)
{
    ShapeMesh mesh = made(Shape::Pyramid, half);
    mesh.points = {{-half.x, -half.y, -half.z},
                   {half.x, -half.y, -half.z},
                   {half.x, half.y, -half.z},
                   {-half.x, half.y, -half.z},
                   {0, 0, half.z}};
    mesh.indices = {0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4};
    if (base)
        addQuad(mesh, 0, 3, 2, 1);
    return mesh;
}

ShapeMesh torus(double ring, double tube, double angle, int along, int around, Ends ends)
{
    ShapeMesh mesh = made(Shape::Torus, {ring, tube, angle});
    const auto at = [&](double u, double v)
    { return polar(ring + tube * std::cos(TwoPi * v), angle * u, tube * std::sin(TwoPi * v)); };
    addGrid(mesh, along, around, at);
    if (angle < 6.28)
    {
        addDisc(mesh, around, ends, polar(ring, 0, 0), [&](double v) { return at(0.0, v); });
        addDisc(mesh, around, ends, polar(ring, angle, 0), [&](double v) { return at(1.0, -v); });
    }
    return mesh;
}

ShapeMesh extrusion(const std::vector<glm::dvec2>& profile, double half)
{
    glm::dvec2 low = profile[0], high = profile[0];
    for (const glm::dvec2& corner : profile)
    {
        low = glm::min(low, corner);
        high = glm::max(high, corner);
    }
    ShapeMesh mesh = made(Shape::Extrusion, glm::dvec3(0.5 * (high - low), half));
    mesh.truth.origin = glm::dvec3(0.5 * (high + low), 0.0);
    const std::size_t count = profile.size();
    for (std::size_t i = 0; i != count; ++i)
    {
        const auto first = std::uint32_t(mesh.points.size());
        for (const double z : {-half, half})
            for (const std::size_t k : {i, (i + 1) % count})
                mesh.points.emplace_back(profile[k], z);
        addQuad(mesh, first, first + 1, first + 3, first + 2);
    }
    return mesh;
}

} // namespace shapemesh
