// SPDX-License-Identifier: MIT
#include <osgLabels/FitMesh.h>

#include <algorithm>
#include <cmath>

namespace osgLabels
{

namespace
{

/// Cosine below which directions are perpendicular.
constexpr double Perpendicular = 3e-3;

/// The rectangle of least area around points along an edge of one of the facets, in the plane that
/// z is perpendicular to.
glm::dmat3 leastRectangle(const FitMesh& mesh, const glm::dvec3& z)
{
    glm::dmat3 best = frameAround(z);
    const auto areaOf = [&](const glm::dmat3& frame)
    {
        const glm::dvec3 half = Extent(mesh.points, frame).half();
        return half.x * half.y;
    };
    // The coordinates' own axes win unless an edge's rectangle is clearly smaller.
    double least = 0.999 * areaOf(best);
    const std::size_t step = std::max<std::size_t>(1, mesh.facets.size() / 16);
    for (std::size_t i = 0; i < mesh.facets.size(); i += step)
        for (int k = 0; k != 3; ++k)
        {
            const FitMesh::Facet& facet = mesh.facets[i];
            glm::dvec3 x = mesh.points[facet.corners[(k + 1) % 3]] - mesh.points[facet.corners[k]];
            x -= glm::dot(x, z) * z;
            const double length = glm::length(x);
            if (length < 100.0 * mesh.noise + 1e-9)
                continue;
            x /= length;
            const glm::dmat3 frame(x, glm::cross(z, x), z);
            const double area = areaOf(frame);
            if (area < 0.999 * least)
            {
                least = area;
                best = frame;
            }
        }
    return best;
}

/// Turned by quarters about z, so that x is nearest to the x (or y) of the coordinates.
FittedShape makeFlat(const FitMesh& mesh, glm::dmat3 frame)
{
    const Extent extent(mesh.points, frame);
    return makeShape(mesh, Shape::Quad, frame, frame * extent.center(), extent.half());
}

/// Whether every corner of the facet lies at the same end of an axis.
bool liesAtEnd(const FitMesh& mesh, const FitMesh::Facet& facet, const glm::dvec3& axis, double low,
               double high, double tolerance)
{
    bool atLow = true, atHigh = true;
    for (const std::uint32_t corner : facet.corners)
    {
        const double at = glm::dot(mesh.points[corner], axis);
        atLow = atLow && at - low <= tolerance;
        atHigh = atHigh && high - at <= tolerance;
    }
    return atLow || atHigh;
}

double toleranceOf(const FitMesh& mesh, double half)
{
    return 4.0 * mesh.noise + 1e-2 * half;
}

/// Whether the facets are the sides and ends of something that is extruded along z.
bool isExtruded(const FitMesh& mesh, const glm::dmat3& frame)
{
    const glm::dvec3& z = frame[2];
    double sides = 0.0;
    for (const FitMesh::Facet& facet : mesh.facets)
    {
        const double cosine = std::abs(glm::dot(facet.normal, z));
        if (cosine < Perpendicular)
            sides += facet.area;
        else if (cosine < 0.999)
            return false;
    }
    const Extent extent(mesh.points, frame);
    const double tolerance = toleranceOf(mesh, extent.half().z);
    for (const FitMesh::Facet& facet : mesh.facets)
        if (std::abs(glm::dot(facet.normal, z)) >= Perpendicular &&
            !liesAtEnd(mesh, facet, z, extent.low.z, extent.high.z, tolerance))
            return false;
    return sides > 1e-6 * mesh.area;
}

/// z as the axis, x along the largest of the sides.
glm::dmat3 extrusionFrame(const FitMesh& mesh, const glm::dvec3& z)
{
    for (const FitMesh::Direction& direction : mesh.directions)
        if (std::abs(glm::dot(direction.normal, z)) < Perpendicular)
        {
            const glm::dvec3 x =
                glm::normalize(direction.normal - glm::dot(direction.normal, z) * z);
            return {x, glm::cross(z, x), z};
        }
    return frameAround(z);
}

double volumeOf(const FitMesh& mesh, const glm::dmat3& frame)
{
    const glm::dvec3 half = Extent(mesh.points, frame).half();
    return half.x * half.y * half.z;
}

/// The two largest perpendicular directions of facets.
std::optional<glm::dmat3> dominatingFrame(const FitMesh& mesh)
{
    if (mesh.directions.empty() || mesh.directions[0].area < 0.1 * mesh.area)
        return std::nullopt;
    const glm::dvec3 z = mesh.directions[0].normal;
    for (const FitMesh::Direction& direction : mesh.directions)
        if (std::abs(glm::dot(direction.normal, z)) < 0.1 && direction.area > 0.02 * mesh.area)
            return extrusionFrame(mesh, z);
    return leastRectangle(mesh, z);
}

/// Distinct points, as long as there are at most five.
std::vector<glm::dvec3> fewPoints(const FitMesh& mesh)
{
    std::vector<glm::dvec3> distinct;
    const double tolerance = 4.0 * mesh.noise + 1e-6;
    for (const glm::dvec3& point : mesh.points)
    {
        const auto isSame = [&](const glm::dvec3& p)
        { return glm::distance(p, point) < tolerance; };
        if (std::any_of(distinct.begin(), distinct.end(), isSame))
            continue;
        if (distinct.size() == 5)
            return {};
        distinct.push_back(point);
    }
    return distinct;
}

/// A pyramid with the first of the points as its apex.
std::optional<FittedShape> pyramidFrom(const FitMesh& mesh, const std::vector<glm::dvec3>& p)
{
    const glm::dvec3 base = 0.25 * (p[1] + p[2] + p[3] + p[4]);
    // The corner farthest from the first is its opposite.
    int opposite = 2;
    for (int i = 3; i != 5; ++i)
        if (glm::distance(p[1], p[i]) > glm::distance(p[1], p[opposite]))
            opposite = i;
    const int left = opposite == 2 ? 3 : 2;
    const int right = 9 - opposite - left;
    const double tolerance = 4.0 * mesh.noise + 2e-3 * glm::distance(p[1], base);
    if (glm::distance(p[1] + p[opposite], p[left] + p[right]) > tolerance ||
        std::abs(glm::distance(p[1], p[opposite]) - glm::distance(p[left], p[right])) > tolerance)
        return std::nullopt;
    const glm::dvec3 a = p[left] - p[1], b = p[right] - p[1], up = p[0] - base;
    const double width = glm::length(a), depth = glm::length(b), height = glm::length(up);
    if (std::min({width, depth, height}) <= 10.0 * mesh.noise ||
        std::abs(glm::dot(a, up)) > tolerance * width + 3e-3 * width * height ||
        std::abs(glm::dot(b, up)) > tolerance * depth + 3e-3 * depth * height)
        return std::nullopt;
    const glm::dvec3 z = up / height;
    glm::dvec3 x = glm::normalize(a - glm::dot(a, z) * z);
    glm::dmat3 frame(x, glm::cross(z, x), z);
    return makeShape(mesh, Shape::Pyramid, frame, base + 0.5 * up,
                     {0.5 * width, 0.5 * depth, 0.5 * height});
}

} // namespace

std::optional<FittedShape> fitQuad(const FitMesh& mesh)
{
    if (mesh.directions.empty())
        return std::nullopt;
    const glm::dvec3 z = mesh.directions[0].normal;
    const double at = glm::dot(mesh.points[mesh.facets[0].corners[0]], z);
    for (const glm::dvec3& point : mesh.points)
        if (std::abs(glm::dot(point, z) - at) > 4.0 * mesh.noise + 1e-5)
            return std::nullopt;
    // Thin boxes have sides: only where no facet shows another way is it flat.
    if (mesh.directions.size() > 1)
        return std::nullopt;
    FittedShape quad = makeFlat(mesh, leastRectangle(mesh, z));
    const double area = 4.0 * quad.size.x * quad.size.y / (mesh.scale * mesh.scale);
    quad.projected = mesh.area < 0.98 * area;
    quad.size.z = 0.0;
    return quad;
}

std::optional<FittedShape> fitBox(const FitMesh& mesh)
{
    const auto& directions = mesh.directions;
    if (mesh.curved || directions.empty() || directions.size() > 3)
        return std::nullopt;
    glm::dmat3 frame(0.0);
    if (directions.size() == 1)
        frame = leastRectangle(mesh, directions[0].normal);
    else
    {
        frame[2] = directions[0].normal;
        if (std::abs(glm::dot(frame[2], directions[1].normal)) > Perpendicular)
            return std::nullopt;
        frame = extrusionFrame(mesh, frame[2]);
        for (std::size_t i = 1; i != directions.size(); ++i)
            if (std::abs(glm::dot(directions[i].normal, frame[0])) > Perpendicular &&
                std::abs(glm::dot(directions[i].normal, frame[1])) > Perpendicular)
                return std::nullopt;
    }
    frame = nearestFrame(frame);
    const Extent extent(mesh.points, frame);
    for (const FitMesh::Facet& facet : mesh.facets)
    {
        const glm::dvec3 n = glm::abs(facet.normal * frame);
        const int axis = n.x >= n.y && n.x >= n.z ? 0 : n.y >= n.z ? 1 : 2;
        if (!liesAtEnd(mesh, facet, frame[axis], extent.low[axis], extent.high[axis],
                       toleranceOf(mesh, extent.half()[axis])))
            return std::nullopt;
    }
    return makeShape(mesh, Shape::Box, frame, frame * extent.center(), extent.half());
}

std::optional<FittedShape> fitPyramid(const FitMesh& mesh)
{
    std::vector<glm::dvec3> points = fewPoints(mesh);
    if (points.size() != 5)
        return std::nullopt;
    for (std::size_t apex = 0; apex != 5; ++apex)
    {
        std::swap(points[0], points[apex]);
        if (const auto pyramid = pyramidFrom(mesh, points))
            return pyramid;
        std::swap(points[0], points[apex]);
    }
    return std::nullopt;
}

std::optional<FittedShape> fitExtrusion(const FitMesh& mesh)
{
    std::vector<glm::dvec3> axes;
    for (const FitMesh::Direction& direction : mesh.directions)
        axes.push_back(direction.normal);
    for (int i = 0; i != 3; ++i)
        axes.push_back(mesh.axes[i]);
    for (glm::dvec3 z : axes)
    {
        const int most = std::abs(z.x) >= std::max(std::abs(z.y), std::abs(z.z)) - 1e-9 ? 0
                         : std::abs(z.y) >= std::abs(z.z) - 1e-9                        ? 1
                                                                                        : 2;
        const glm::dmat3 frame = extrusionFrame(mesh, z[most] < 0.0 ? -z : z);
        if (!isExtruded(mesh, frame))
            continue;
        const Extent extent(mesh.points, frame);
        return makeShape(mesh, Shape::Extrusion, frame, frame * extent.center(), extent.half());
    }
    return std::nullopt;
}

FittedShape projectBox(const FitMesh& mesh)
{
    glm::dmat3 best(1.0);
    // A frame has to be worth being askew.
    double least = volumeOf(mesh, best) * 0.95;
    if (const auto dominating = dominatingFrame(mesh))
        if (const double volume = volumeOf(mesh, *dominating); volume < least)
        {
            best = *dominating;
            least = 0.9 * volume;
        }
    if (volumeOf(mesh, mesh.axes) < least)
        best = mesh.axes;
    best = nearestFrame(best);
    const Extent extent(mesh.points, best);
    FittedShape box = makeShape(mesh, Shape::Box, best, best * extent.center(), extent.half());
    box.projected = true;
    return box;
}

} // namespace osgLabels
