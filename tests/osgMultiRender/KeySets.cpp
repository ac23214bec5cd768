// SPDX-License-Identifier: MIT
#include "osgMultiRender/KeySets.h"

#include <algorithm>
#include <cmath>
#include <limits>

using osgMultiRender::KeyMode;

namespace
{

double bruteSegment(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& place)
{
    const glm::dvec3 along = b - a;
    const double square = glm::dot(along, along);
    const double share =
        square > 0.0 ? std::min(1.0, std::max(0.0, glm::dot(place - a, along) / square)) : 0.0;
    return glm::length(place - (a + share * along));
}

/// A walk, as a user would draw a path.
std::vector<glm::dvec3> makePath(std::mt19937& random, std::size_t count, double step)
{
    std::vector<glm::dvec3> points;
    glm::dvec3 at(0.0);
    for (std::size_t i = 0; i < count; ++i)
        points.push_back(at += randomIn(random, step));
    return points;
}

template <class F> std::vector<glm::dvec3> makePoints(std::size_t count, F point)
{
    std::vector<glm::dvec3> points;
    for (std::size_t i = 0; i < count; ++i)
        points.push_back(point(i));
    return points;
}

} // namespace

glm::dvec3 randomIn(std::mt19937& random, double radius)
{
    std::uniform_real_distribution<double> any(-radius, radius);
    const double x = any(random), y = any(random);
    return {x, y, any(random)};
}

glm::dvec3 KeySet::place(std::mt19937& random) const
{
    // Some at the points themselves, and close to them.
    const unsigned int kind = random() % 8;
    if (kind < 2 && !points.empty())
    {
        const glm::dvec3 point = points[random() % points.size()];
        if (glm::length(point - center) < 2.0 * radius)
            return kind == 0 ? point : point + randomIn(random, 1e-3 * radius);
    }
    return center + randomIn(random, radius);
}

std::vector<KeySet> makeKeySets(std::size_t count, unsigned int seed)
{
    std::mt19937 random(seed);
    const auto in = [&](double radius) { return randomIn(random, radius); };
    const double nan = std::numeric_limits<double>::quiet_NaN(),
                 infinity = std::numeric_limits<double>::infinity(),
                 turn = 6.283185307179586 / double(std::max<std::size_t>(count, 1));
    std::vector<KeySet> sets;
    sets.push_back({"random", makePoints(count, [&](std::size_t) { return in(1.0); })});
    sets.push_back({"path", makePath(random, count, 0.05)});
    sets.push_back({"equal", std::vector<glm::dvec3>(count, glm::dvec3(0.25, 0.5, -0.5))});
    sets.push_back({"lattice", makePoints(count,
                                          [](std::size_t i) {
                                              return glm::dvec3(double(i % 16), double(i / 16 % 16),
                                                                double(i / 256)) /
                                                     16.0;
                                          })});
    sets.push_back({"circle", makePoints(count,
                                         [&](std::size_t i) {
                                             return glm::dvec3(std::cos(turn * double(i)),
                                                               std::sin(turn * double(i)), 0.0);
                                         })});
    sets.push_back(
        {"line", makePoints(count, [&](std::size_t) { return glm::dvec3(in(1.0).x, 0, 0); })});
    sets.push_back({"clusters",
                    makePoints(count,
                               [&](std::size_t i)
                               {
                                   return i == 0
                                              ? glm::dvec3(1e7, 0.0, 0.0)
                                              : glm::dvec3(double(i % 5)) + in(i % 2 ? 1e-4 : 1e-2);
                               }),
                    glm::dvec3(2.0), 3.0});
    const glm::dvec3 far(1e7, -1e7, 1e7);
    sets.push_back(
        {"far", makePoints(count, [&](std::size_t) { return far + in(10.0); }), far, 10.0});
    sets.push_back(
        {"spread", makePoints(count, [&](std::size_t i) { return in(i % 3 ? 1e7 : 1.0); })});
    sets.push_back({"notNumbers", makePoints(count,
                                             [&](std::size_t i)
                                             {
                                                 return i % 3 == 0 ? glm::dvec3(0.0, nan, 0.0)
                                                        : i % 3 == 1
                                                            ? glm::dvec3(infinity, 0.0, 0.0)
                                                            : in(1.0);
                                             })});
    return sets;
}

double bruteDistance(const std::vector<glm::dvec3>& points, KeyMode mode, const glm::dvec3& place)
{
    std::vector<glm::dvec3> counted;
    for (const glm::dvec3& point : points)
        if (std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z))
            counted.push_back(point);
    double nearest = std::numeric_limits<double>::infinity();
    const std::size_t count = counted.size();
    for (std::size_t i = 0; i < count; ++i)
    {
        const bool isJoined =
            mode == KeyMode::PolylineLoop || (mode == KeyMode::Polyline && i + 1 < count);
        const glm::dvec3& next = isJoined ? counted[(i + 1) % count] : counted[i];
        nearest = std::min(nearest, bruteSegment(counted[i], next, place));
    }
    return nearest;
}
