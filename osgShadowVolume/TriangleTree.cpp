// SPDX-License-Identifier: MIT
#include <osgShadowVolume/TriangleTree.h>

#include <algorithm>
#include <cmath>

namespace osgShadowVolume
{

namespace
{

constexpr std::size_t MaxInLeaf = 4;

bool isFinite(const TriangleTree::Triangle& triangle)
{
    return std::all_of(triangle.begin(), triangle.end(),
                       [](const glm::dvec3& p)
                       { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); });
}

/// Whether the ray from the origin meets the box before `end`. Rounding is made up for by a share
/// of the distances, far more than it can be.
bool meets(const glm::dvec3& low, const glm::dvec3& high, const glm::dvec3& from,
           const glm::dvec3& direction, double end)
{
    double nearest = 0.0;
    for (int axis = 0; axis < 3; ++axis)
    {
        if (direction[axis] == 0.0)
        {
            if (from[axis] < low[axis] || from[axis] > high[axis])
                return false;
            continue;
        }
        const double a = (low[axis] - from[axis]) / direction[axis];
        const double b = (high[axis] - from[axis]) / direction[axis];
        nearest = std::max(nearest, std::min(a, b) * (1.0 - 1e-12));
        end = std::min(end, std::max(a, b) * (1.0 + 1e-12));
    }
    return nearest <= end;
}

bool crosses(const TriangleTree::Triangle& triangle, const glm::dvec3& from,
             const glm::dvec3& direction, double tolerance, double end)
{
    const glm::dvec3 a = triangle[0] - from, b = triangle[1] - from, c = triangle[2] - from;
    // Volumes over each edge: exactly opposite for the two triangles at an edge.
    const double ab = glm::dot(direction, glm::cross(a, b));
    const double bc = glm::dot(direction, glm::cross(b, c));
    const double ca = glm::dot(direction, glm::cross(c, a));
    if (!((ab >= 0.0 && bc >= 0.0 && ca >= 0.0) || (ab <= 0.0 && bc <= 0.0 && ca <= 0.0)))
        return false;
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const double size = glm::length(normal);
    const double slope = glm::dot(normal, direction);
    if (size == 0.0 || slope == 0.0)
        return false;
    const double height = glm::dot(normal, a); // of `from` below the plane, times size
    if (std::abs(height) <= tolerance * size)
        return false;
    if (std::isfinite(end) && std::abs(height - slope * end) <= tolerance * size)
        return false;
    const double t = height / slope;
    return t > 0.0 && t < end;
}

} // namespace

TriangleTree::TriangleTree(std::vector<Triangle> triangles) : _triangles(std::move(triangles))
{
    _triangles.erase(std::remove_if(_triangles.begin(), _triangles.end(),
                                    [](const Triangle& triangle) { return !isFinite(triangle); }),
                     _triangles.end());
    if (!_triangles.empty())
        build(0, _triangles.size());
}

void TriangleTree::build(std::size_t begin, std::size_t end)
{
    const std::size_t index = _boxes.size();
    _boxes.emplace_back();
    Box box, middles;
    const auto middleOf = [](const Triangle& t) { return t[0] + t[1] + t[2]; };
    for (std::size_t i = begin; i < end; ++i)
    {
        for (const glm::dvec3& p : _triangles[i])
        {
            box.low = glm::min(box.low, p);
            box.high = glm::max(box.high, p);
        }
        middles.low = glm::min(middles.low, middleOf(_triangles[i]));
        middles.high = glm::max(middles.high, middleOf(_triangles[i]));
    }
    if (end - begin <= MaxInLeaf)
    {
        box.first = static_cast<std::uint32_t>(begin);
        box.count = static_cast<std::uint32_t>(end - begin);
        _boxes[index] = box;
        return;
    }
    const glm::dvec3 extent = middles.high - middles.low;
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0
                     : extent.y >= extent.z                       ? 1
                                                                  : 2;
    const std::size_t middle = begin + (end - begin) / 2;
    const auto at = [this](std::size_t i) { return _triangles.begin() + std::ptrdiff_t(i); };
    std::nth_element(at(begin), at(middle), at(end),
                     [&](const Triangle& a, const Triangle& b)
                     { return middleOf(a)[axis] < middleOf(b)[axis]; });
    build(begin, middle);
    box.first = static_cast<std::uint32_t>(_boxes.size());
    _boxes[index] = box;
    build(middle, end);
}

bool TriangleTree::blocks(const glm::dvec3& from, const glm::dvec3& direction, double tolerance,
                          double end) const
{
    if (_boxes.empty())
        return false;
    std::uint32_t stack[64]; // halves of 2^32 triangles at most
    std::size_t size = 0;
    stack[size++] = 0;
    while (size > 0)
    {
        const std::uint32_t index = stack[--size];
        const Box& box = _boxes[index];
        if (!meets(box.low, box.high, from, direction, end))
            continue;
        for (std::uint32_t i = box.first; i < box.first + box.count; ++i)
            if (crosses(_triangles[i], from, direction, tolerance, end))
                return true;
        if (box.count == 0)
        {
            stack[size++] = box.first;
            stack[size++] = index + 1;
        }
    }
    return false;
}

double TriangleTree::getDiagonal() const
{
    return _boxes.empty() ? 0.0 : glm::length(_boxes[0].high - _boxes[0].low);
}

} // namespace osgShadowVolume
