// SPDX-License-Identifier: MIT
#include <osgLabels/FitMesh.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace osgLabels
{

namespace
{

constexpr std::uint32_t Unused = 0xffffffffu;

bool isFinite(const glm::vec3& v)
{
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Whether the triangle's indices and coordinates can be used.
bool isUsable(const std::vector<glm::vec3>& vertices, const std::uint32_t* corner)
{
    for (int i = 0; i != 3; ++i)
        if (corner[i] >= vertices.size() || !isFinite(vertices[corner[i]]))
            return false;
    return true;
}

/// Turns a symmetric matrix about one pair of axes so that their element is 0 (Jacobi).
void turn(glm::dmat3& m, glm::dmat3& axes, int p, int q)
{
    if (m[p][q] == 0.0)
        return;
    const double theta = (m[q][q] - m[p][p]) / (2.0 * m[p][q]);
    const double t = std::copysign(1.0, theta) / (std::abs(theta) + std::hypot(theta, 1.0));
    const double c = 1.0 / std::hypot(t, 1.0);
    glm::dmat3 j(1.0);
    j[p][p] = j[q][q] = c;
    j[q][p] = t * c;
    j[p][q] = -t * c;
    m = glm::transpose(j) * m * j;
    axes = axes * j;
}

} // namespace

FitMesh::FitMesh(const std::vector<glm::vec3>& vertices, const std::vector<std::uint32_t>& indices)
{
    constexpr float Huge = std::numeric_limits<float>::max();
    glm::vec3 low(Huge), high(-Huge);
    bool any = false;
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3)
        if (isUsable(vertices, &indices[i]))
            for (int k = 0; k != 3; ++k, any = true)
            {
                low = glm::min(low, vertices[indices[i + k]]);
                high = glm::max(high, vertices[indices[i + k]]);
            }
    if (!any)
        return;
    center = 0.5 * (glm::dvec3(low) + glm::dvec3(high));
    scale = 0.5 * glm::length(glm::dvec3(high) - glm::dvec3(low));
    if (!(scale > 0.0))
        return;
    const glm::dvec3 reach = glm::max(glm::abs(glm::dvec3(low)), glm::abs(glm::dvec3(high)));
    noises = reach / scale * double(std::numeric_limits<float>::epsilon());
    noise = std::max({noises.x, noises.y, noises.z});
    addFacets(vertices, indices);
    if (area > 0.0)
        findAxes();
}

void FitMesh::addFacets(const std::vector<glm::vec3>& vertices,
                        const std::vector<std::uint32_t>& indices)
{
    std::vector<std::uint32_t> pointOf(vertices.size(), Unused);
    points.reserve(std::min(vertices.size(), indices.size()));
    facets.reserve(indices.size() / 3);
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3)
    {
        if (!isUsable(vertices, &indices[i]))
            continue;
        glm::dvec3 p[3];
        for (int k = 0; k != 3; ++k)
            p[k] = (glm::dvec3(vertices[indices[i + k]]) - center) / scale;
        const glm::dvec3 ab = p[1] - p[0], ac = p[2] - p[0];
        const glm::dvec3 normal = glm::cross(ab, ac);
        const double length = glm::length(normal);
        // By what the normal may lean, its corners being floats.
        const glm::dvec3 reach = glm::abs(ab) + glm::abs(ac);
        const glm::dvec3 off(reach.y * noises.z + reach.z * noises.y,
                             reach.z * noises.x + reach.x * noises.z,
                             reach.x * noises.y + reach.y * noises.x);
        if (!(length > 2.0 * glm::length(off)) || !(length > 1e-16))
            continue;
        Facet facet;
        facet.normal = normal / length;
        facet.area = 0.5 * length;
        facet.middle = (p[0] + p[1] + p[2]) / 3.0;
        for (int k = 0; k != 3; ++k)
        {
            std::uint32_t& point = pointOf[indices[i + k]];
            if (point == Unused)
            {
                point = std::uint32_t(points.size());
                points.push_back(p[k]);
            }
            facet.corners[k] = point;
        }
        area += facet.area;
        centroid += facet.area * facet.middle;
        facets.push_back(facet);
        addDirection(facet, glm::length(off) / length);
    }
    if (area > 0.0)
        centroid /= area;
    std::sort(directions.begin(), directions.end(),
              [](const Direction& a, const Direction& b) { return a.area > b.area; });
}

void FitMesh::addDirection(const Facet& facet, double lean)
{
    // The angle within which normals are the same.
    const double angle = 2e-3 + 2.0 * lean;
    if (angle > 0.05)
        return;
    for (Direction& direction : directions)
    {
        const double along = glm::dot(direction.normal, facet.normal);
        if (1.0 - std::abs(along) > 0.5 * angle * angle)
            continue;
        // Direction of the largest facets, not of the first: the largest are the most exact.
        const double share = facet.area / (direction.area + facet.area);
        direction.normal = glm::normalize((1.0 - share) * direction.normal +
                                          std::copysign(share, along) * facet.normal);
        direction.area += facet.area;
        return;
    }
    if (directions.size() < MaxDirections)
        directions.push_back({facet.normal, facet.area});
    else
        curved = true;
}

void FitMesh::findAxes()
{
    for (const Facet& facet : facets)
        spread += facet.area * glm::outerProduct(facet.normal, facet.normal);
    glm::dmat3 m = spread;
    for (int sweep = 0; sweep != 12; ++sweep)
    {
        const double off = m[0][1] * m[0][1] + m[0][2] * m[0][2] + m[1][2] * m[1][2];
        if (off < 1e-34 * area * area)
            break;
        turn(m, axes, 0, 1);
        turn(m, axes, 0, 2);
        turn(m, axes, 1, 2);
    }
}

Extent::Extent(const std::vector<glm::dvec3>& points, const glm::dmat3& axes)
    : low(std::numeric_limits<double>::max()), high(-std::numeric_limits<double>::max())
{
    for (const glm::dvec3& point : points)
    {
        const glm::dvec3 p = point * axes;
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
}

glm::dmat3 nearestFrame(const glm::dmat3& axes)
{
    glm::dmat3 frame(0.0);
    bool taken[3] = {false, false, false};
    bool filled[3] = {false, false, false};
    for (int round = 0; round != 3; ++round)
    {
        int from = 0, to = 0;
        double best = -1.0;
        for (int i = 0; i != 3; ++i)
            for (int k = 0; k != 3; ++k)
                // Ties go to the first, whatever rounding says.
                if (!taken[i] && !filled[k] && std::abs(axes[i][k]) > best + 1e-9)
                {
                    best = std::abs(axes[i][k]);
                    from = i;
                    to = k;
                }
        taken[from] = filled[to] = true;
        frame[to] = axes[from][to] < 0.0 ? -axes[from] : axes[from];
    }
    if (glm::determinant(frame) < 0.0)
        frame[2] = -frame[2];
    return frame;
}

glm::dmat3 frameAround(const glm::dvec3& z)
{
    const glm::dvec3 size = glm::abs(z);
    const int least = size.x <= size.y + 1e-9 && size.x <= size.z + 1e-9 ? 0
                      : size.y <= size.z + 1e-9                          ? 1
                                                                         : 2;
    glm::dvec3 x(0.0);
    x[least] = 1.0;
    x = glm::normalize(x - glm::dot(x, z) * z);
    return {x, glm::cross(z, x), z};
}

FittedShape makeShape(const FitMesh& mesh, Shape shape, const glm::dmat3& frame,
                      const glm::dvec3& origin, const glm::dvec3& size)
{
    FittedShape made;
    made.shape = shape;
    made.rotation = glm::normalize(glm::quat_cast(glm::transpose(frame)));
    made.origin = mesh.center + mesh.scale * origin;
    made.size = mesh.scale * size;
    if (shape == Shape::Torus)
        made.size.z = size.z;
    return made;
}

} // namespace osgLabels
