// SPDX-License-Identifier: MIT
#include "SilhouetteMeshes.h"

#include <osgShadowVolume/EdgeMeshBuilder.h>
#include <osgShadowVolume/Silhouette.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

using namespace osgShadowVolume;

namespace
{

constexpr double Pi = 3.14159265358979323846;

using Surface = std::function<glm::dvec3(int, int)>;
using Random = std::mt19937;

double uniform(Random& random, double low, double high)
{
    return std::uniform_real_distribution<double>(low, high)(random);
}

/// A grid of 2 * columns * rows triangles over the surface, moved by the case's offset.
void addGrid(HardCase& hard, int columns, int rows, const glm::dvec3& offset,
             const Surface& surface)
{
    const auto at = [&](int i, int j) { return glm::vec3(surface(i, j) + offset); };
    for (int i = 0; i < columns; ++i)
        for (int j = 0; j < rows; ++j)
        {
            hard.triangles.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
            hard.triangles.push_back({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
        }
}

/// Turns by odd angles, so that coordinates in a plane are rounded.
glm::dvec3 turn(const glm::dvec3& p)
{
    const double c = std::cos(0.7), s = std::sin(0.7), d = std::cos(0.3), t = std::sin(0.3);
    const glm::dvec3 q(c * p.x - s * p.y, s * p.x + c * p.y, p.z);
    return {q.x, d * q.y - t * q.z, t * q.y + d * q.z};
}

void addLight(HardCase& hard, const glm::dvec3& position)
{
    hard.lights.push_back(glm::dvec4(glm::vec3(position), 1.0));
}

HardCase wall(const glm::dvec3& offset, Random& random)
{
    HardCase hard{"wall", {}, {}};
    addGrid(hard, 60, 60, offset, [](int i, int j) { return turn({i / 3.0, 0.0, j / 3.0}); });
    for (int k = 0; k < 20; ++k)
        addLight(hard, turn({uniform(random, -20, 40), 0.0, uniform(random, -20, 40)}) + offset);
    hard.lights.push_back(glm::dvec4(turn({0.6, 0.0, 0.8}), 0.0));
    return hard;
}

HardCase box(const glm::dvec3& offset, Random& random)
{
    HardCase hard{"box", {}, {}};
    for (int axis = 0; axis < 3; ++axis)
        for (const double side : {0.0, 10.0})
            addGrid(hard, 60, 60, offset,
                    [=](int i, int j)
                    {
                        glm::dvec3 p;
                        p[axis] = side;
                        p[(axis + 1) % 3] = i / 6.0;
                        p[(axis + 2) % 3] = j / 6.0;
                        return turn(p);
                    });
    for (int k = 0; k < 20; ++k)
        addLight(hard, turn({10.0, uniform(random, -10, 20), uniform(random, -10, 20)}) + offset);
    return hard;
}

HardCase slivers(const glm::dvec3& offset, Random& random)
{
    HardCase hard{"slivers", {}, {}};
    const auto point = [&] {
        return glm::dvec3(uniform(random, 0, 100), uniform(random, 0, 100),
                          uniform(random, 0, 100));
    };
    for (int k = 0; k < 20000; ++k)
    {
        const glm::dvec3 a = point(), b = point(), middle = glm::mix(a, b, uniform(random, 0, 1));
        const std::array<glm::vec3, 4> corners{a + offset, b + offset,
                                               middle + 1e-6 * point() + offset,
                                               middle - 1e-6 * point() + offset};
        for (int left = 0; left < 4; ++left)
            hard.triangles.push_back(
                {corners[(left + 1) % 4], corners[(left + 2) % 4], corners[(left + 3) % 4]});
    }
    for (int k = 0; k < 10; ++k)
        addLight(hard, point() + offset);
    return hard;
}

HardCase sphere(const glm::dvec3& offset, Random& random)
{
    HardCase hard{"sphere", {}, {}};
    addGrid(hard, 200, 200, offset,
            [](int i, int j)
            {
                // The same angle for both ends of the seam.
                const double a = Pi * j / 200, b = 2 * Pi * (i % 200) / 200;
                return 10.0 * glm::dvec3(std::sin(a) * std::cos(b), std::sin(a) * std::sin(b),
                                         std::cos(a));
            });
    for (int k = 0; k < 10; ++k)
        addLight(hard, glm::dvec3(uniform(random, 0, 40), uniform(random, 0, 40),
                                  uniform(random, 0, 40)) +
                           offset);
    return hard;
}

HardCase terrain(const glm::dvec3& offset, Random& random)
{
    HardCase hard{"terrain", {}, {}};
    addGrid(hard, 200, 200, offset,
            [](int i, int j)
            {
                const double x = i / 2.0, y = j / 2.0;
                return glm::dvec3(x, y,
                                  std::sin(x * 0.37) * std::cos(y * 0.23) +
                                      0.1 * std::sin(7.1 * x + 5.3 * y));
            });
    for (int k = 0; k < 10; ++k)
    {
        const double a = uniform(random, 0, 2 * Pi);
        addLight(hard, glm::dvec3(50 + 3e4 * std::cos(a), 50 + 3e4 * std::sin(a),
                                  uniform(random, 0, 2e3)) +
                           offset);
    }
    return hard;
}

} // namespace

EdgeMesh HardCase::build() const
{
    EdgeMeshBuilder builder;
    builder.reserve(triangles.size());
    for (const Triangle& t : triangles)
        builder.addTriangle(t[0], t[1], t[2]);
    return builder.build();
}

std::vector<HardCase> hardCases(double offset)
{
    Random random(7);
    const glm::dvec3 move(offset, 0.7 * offset, -0.3 * offset);
    return {wall(move, random), box(move, random), slivers(move, random), sphere(move, random),
            terrain(move, random)};
}

HardCase grazingTriangles(std::size_t count)
{
    HardCase hard{"grazing", {}, {glm::dvec4(3.0, 5.0, 7.0, 1.0)}};
    const glm::dvec3 light(hard.lights[0]);
    Random random(11);
    const auto direction = [&]
    {
        return glm::normalize(
            glm::dvec3(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1)));
    };
    while (hard.triangles.size() < count)
    {
        // A plane through the light, and a strip in it whose corners leave it by some roundings.
        const glm::dvec3 u = direction(), v = direction(), normal = glm::cross(u, v);
        glm::vec3 a = light + 10.0 * u, b = light + 9.0 * u + v;
        for (int k = 0; k < 50; ++k)
        {
            const glm::vec3 c = light + uniform(random, -20, 20) * u +
                                uniform(random, -20, 20) * v +
                                uniform(random, -3e-6, 3e-6) * normal;
            hard.triangles.push_back({a, b, c});
            a = b;
            b = c;
        }
    }
    hard.triangles.resize(count);
    return hard;
}

HardCase book(unsigned int count)
{
    HardCase hard{"book of " + std::to_string(count), {}, {}};
    for (unsigned int i = 0; i < count; ++i)
    {
        const double angle = 2 * Pi * i / count;
        hard.triangles.push_back({glm::vec3(0, 0, -1), glm::vec3(0, 0, 1),
                                  glm::vec3(std::cos(angle), std::sin(angle), 0.1 * (i % 7))});
    }
    hard.lights = {glm::dvec4(5, 3, 2, 1), glm::dvec4(1, 0.2, 0.1, 0), glm::dvec4(0, 0, 4, 1),
                   glm::dvec4(0.5, 0, 0.2, 1)};
    return hard;
}

HardCase moebiusStrip(unsigned int steps)
{
    HardCase hard{"Moebius strip", {}, {}};
    const auto at = [&](unsigned int i, double side)
    {
        if (i == steps)
        {
            i = 0;
            side = -side;
        }
        const double angle = 2 * Pi * i / steps, radius = 3.0 + side * std::cos(angle / 2);
        return glm::vec3(radius * std::cos(angle), radius * std::sin(angle),
                         side * std::sin(angle / 2));
    };
    for (unsigned int i = 0; i < steps; ++i)
    {
        hard.triangles.push_back({at(i, -1), at(i + 1, -1), at(i, 1)});
        hard.triangles.push_back({at(i + 1, -1), at(i + 1, 1), at(i, 1)});
    }
    hard.lights = {glm::dvec4(5, 3, 2, 1), glm::dvec4(0, 0, 1, 0), glm::dvec4(0, 0, 0, 1),
                   glm::dvec4(3, 0, 0, 1)};
    return hard;
}

std::size_t openVertices(const EdgeMesh& mesh, const MeshLight& light)
{
    std::vector<int> sums(mesh.vertices.size());
    for (const EdgeMesh::Group& group : mesh.groups)
        for (std::size_t at = 0; at != group.indices.size(); at += 2 + group.opposites)
        {
            const std::uint32_t* record = group.indices.data() + at;
            const int count = multiplicity(mesh, record, group.opposites, light);
            sums[record[0]] += count;
            sums[record[1]] -= count;
        }
    return sums.size() - std::size_t(std::count(sums.begin(), sums.end(), 0));
}
