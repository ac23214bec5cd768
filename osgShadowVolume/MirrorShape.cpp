// SPDX-License-Identifier: MIT
#include <osgShadowVolume/MirrorShape.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace osgShadowVolume
{

namespace
{

constexpr double Flatness = 1e-4; ///< Of a surface's size.
constexpr double EdgeOn = 1e-6;   ///< Of the distance: less than a pixel of any view.

glm::dvec4 rowOf(const glm::dmat4& m, int row)
{
    return {m[0][row], m[1][row], m[2][row], m[3][row]};
}

double determinant(const glm::dvec4& a, const glm::dvec4& b, const glm::dvec4& c, int without)
{
    glm::dmat3 m;
    for (int i = 0, column = 0; i < 4; ++i)
        if (i != without)
            m[column++] = {a[i], b[i], c[i]};
    return glm::determinant(m);
}

/// Twice the area of each triangle along its normal; the largest, and the sum along that one.
struct Areas
{
    glm::dvec3 largest{0.0};
    std::size_t first = 0; ///< Point of the largest triangle.
    double signedSum = 0.0;
};

Areas areasOf(const std::vector<glm::dvec3>& points)
{
    const auto area = [&](std::size_t i)
    { return glm::cross(points[i + 1] - points[i], points[i + 2] - points[i]); };
    Areas areas;
    for (std::size_t i = 0; i + 2 < points.size(); i += 3)
    {
        const glm::dvec3 each = area(i);
        if (glm::dot(each, each) > glm::dot(areas.largest, areas.largest))
        {
            areas.largest = each;
            areas.first = i;
        }
    }
    for (std::size_t i = 0; i + 2 < points.size(); i += 3)
        areas.signedSum += glm::dot(area(i), areas.largest);
    return areas;
}

/// One step of Sutherland and Hodgman: what of a polygon has a value of at least 0.
template <class Value>
std::vector<glm::dvec4> clipped(const std::vector<glm::dvec4>& polygon, Value value)
{
    std::vector<glm::dvec4> result;
    for (std::size_t i = 0; i < polygon.size(); ++i)
    {
        const glm::dvec4 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        const double atA = value(a), atB = value(b);
        if (atA >= 0.0)
            result.push_back(a);
        if ((atA >= 0.0) != (atB >= 0.0))
            result.push_back(a + (b - a) * (atA / (atA - atB)));
    }
    return result;
}

} // namespace

MirrorShape MirrorShape::transformed(const glm::dmat4& matrix) const
{
    MirrorShape result;
    for (std::size_t i = 0; i < corners.size(); ++i)
        result.corners[i] = glm::dvec3(matrix * glm::dvec4(corners[i], 1.0));
    const double before = glm::distance(corners[0], corners[2]);
    const double after = glm::distance(result.corners[0], result.corners[2]);
    result.tolerance = before > 0.0 ? tolerance * after / before : 0.0;
    return result;
}

std::optional<MirrorShape> fitMirror(const std::vector<glm::dvec3>& triangles, std::string& error)
{
    const Areas areas = areasOf(triangles);
    const double size = glm::length(areas.largest);
    if (!(size > 0.0) || !std::isfinite(size))
    {
        error = "without area";
        return std::nullopt;
    }
    const glm::dvec3 normal = areas.largest / size * (areas.signedSum < 0.0 ? -1.0 : 1.0);
    const glm::dvec3 origin = triangles[areas.first];
    const glm::dvec3 u = glm::normalize(triangles[areas.first + 1] - origin);
    const glm::dvec3 v = glm::cross(normal, u);
    glm::dvec2 low(std::numeric_limits<double>::infinity()), high = -low;
    double off = 0.0, far = 0.0;
    for (const glm::dvec3& point : triangles)
    {
        const glm::dvec3 d = point - origin;
        const glm::dvec2 at(glm::dot(d, u), glm::dot(d, v));
        low = glm::min(low, at);
        high = glm::max(high, at);
        const double distance = std::abs(glm::dot(d, normal));
        if (!std::isfinite(distance)) // std::max would pass over a NaN
        {
            error = "not finite";
            return std::nullopt;
        }
        off = std::max(off, distance);
        for (int axis = 0; axis < 3; ++axis)
            far = std::max(far, std::abs(point[axis]));
    }
    MirrorShape shape;
    shape.tolerance =
        Flatness * glm::length(high - low) + 4.0 * std::numeric_limits<float>::epsilon() * far;
    if (!(off <= shape.tolerance))
    {
        error = "not planar";
        return std::nullopt;
    }
    shape.corners = {origin + u * low.x + v * low.y, origin + u * high.x + v * low.y,
                     origin + u * high.x + v * high.y, origin + u * low.x + v * high.y};
    return shape;
}

glm::dvec4 eyeOf(const glm::dmat4& projection)
{
    const glm::dvec4 x = rowOf(projection, 0), y = rowOf(projection, 1), w = rowOf(projection, 3);
    // The point that all three rows take to 0.
    glm::dvec4 eye(determinant(x, y, w, 0), -determinant(x, y, w, 1), determinant(x, y, w, 2),
                   -determinant(x, y, w, 3));
    const double length = glm::length(glm::dvec3(eye));
    if (std::abs(eye.w) > 1e-12 * length)
        return eye / eye.w;
    eye = glm::dvec4(glm::dvec3(eye) / length, 0.0);
    return glm::dot(rowOf(projection, 2), eye) > 0.0 ? -eye : eye;
}

std::optional<glm::dvec4> planeTowards(const MirrorShape& shape, const glm::dvec4& eye)
{
    const auto& c = shape.corners;
    const glm::dvec3 normal = glm::normalize(glm::cross(c[1] - c[0], c[3] - c[0]));
    const double offset = -glm::dot(normal, 0.5 * (c[0] + c[2]));
    const double side = glm::dot(normal, glm::dvec3(eye)) + offset * eye.w;
    double distance = eye.w == 0.0 ? 1.0 : 0.0;
    if (eye.w != 0.0)
        for (const glm::dvec3& corner : c)
            distance = std::max(distance, glm::distance(corner, glm::dvec3(eye)));
    if (!(std::abs(side) > EdgeOn * distance))
        return std::nullopt;
    const glm::dvec4 plane(normal, offset);
    return side < 0.0 ? -plane : plane;
}

bool showsFront(const MirrorShape& shape, const glm::dvec4& plane)
{
    const auto& c = shape.corners;
    return glm::dot(glm::cross(c[1] - c[0], c[3] - c[0]), glm::dvec3(plane)) > 0.0;
}

bool liesIn(const MirrorShape& shape, const glm::dvec4& plane, double tolerance)
{
    return std::all_of(shape.corners.begin(), shape.corners.end(),
                       [&](const glm::dvec3& corner)
                       {
                           return std::abs(glm::dot(plane, glm::dvec4(corner, 1.0))) <=
                                  std::max(tolerance, shape.tolerance);
                       });
}

glm::dmat4 reflectionIn(const glm::dvec4& plane)
{
    const glm::dvec3 n(plane);
    glm::dmat4 result(1.0);
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 3; ++row)
            result[column][row] -= 2.0 * n[row] * plane[column];
    return result;
}

bool isBehind(const MirrorShape& shape, const glm::dmat4& projection)
{
    return std::all_of(shape.corners.begin(), shape.corners.end(),
                       [&](const glm::dvec3& corner)
                       { return glm::dot(rowOf(projection, 3), glm::dvec4(corner, 1.0)) <= 0.0; });
}

double shareOfView(const MirrorShape& shape, const glm::dmat4& projection)
{
    std::vector<glm::dvec4> polygon;
    for (const glm::dvec3& corner : shape.corners)
        polygon.push_back(projection * glm::dvec4(corner, 1.0));
    for (int axis = 0; axis < 2; ++axis)
        for (const double sign : {-1.0, 1.0})
            polygon = clipped(polygon, [&](const glm::dvec4& p) { return p.w + sign * p[axis]; });
    double area = 0.0;
    for (std::size_t i = 0; i < polygon.size(); ++i)
    {
        const glm::dvec4 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        if (a.w > 0.0 && b.w > 0.0)
            area += (a.x / a.w) * (b.y / b.w) - (b.x / b.w) * (a.y / a.w);
    }
    return std::min(1.0, std::abs(area) / 8.0); // the picture is 2 wide and 2 high
}

} // namespace osgShadowVolume
