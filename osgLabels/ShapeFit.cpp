// SPDX-License-Identifier: MIT
#include <osgLabels/ShapeFit.h>

#include <osgLabels/FaceRooms.h>
#include <osgLabels/FitMesh.h>

#include <algorithm>
#include <cmath>

namespace osgLabels
{

namespace
{

double distanceToBox(const glm::dvec3& p, const glm::dvec3& size)
{
    const glm::dvec3 d = glm::abs(p) - size;
    const double inside = std::max({d.x, d.y, d.z});
    return inside < 0.0 ? -inside : glm::length(glm::max(d, glm::dvec3(0.0)));
}

double distanceToSegment(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b)
{
    const glm::dvec2 along = b - a;
    const double squared = glm::dot(along, along);
    const double t = squared > 0.0 ? glm::clamp(glm::dot(p - a, along) / squared, 0.0, 1.0) : 0.0;
    return glm::distance(p, a + t * along);
}

/// Of what turns around z: its generator, and the discs at its ends.
double distanceToFrustum(const glm::dvec3& p, double low, double high, double half)
{
    const glm::dvec2 at(std::sqrt(p.x * p.x + p.y * p.y), p.z);
    return std::min({distanceToSegment(at, {low, -half}, {high, half}),
                     distanceToSegment(at, {0.0, -half}, {low, -half}),
                     distanceToSegment(at, {0.0, half}, {high, half})});
}

double distanceToDish(const glm::dvec3& p, const glm::dvec3& size)
{
    const double rho = std::hypot(p.x, p.y);
    const double out = std::hypot(rho / size.x, p.z / size.z);
    const double shell = p.z < 0.0 || out == 0.0 ? std::hypot(rho - size.x, p.z)
                                                 : std::abs(1.0 - 1.0 / out) * glm::length(p);
    return std::min(shell, distanceToSegment({rho, p.z}, {0.0, 0.0}, {size.x, 0.0}));
}

/// Of the planes, which is that of the surface for points near to it.
double distanceToPyramid(const glm::dvec3& p, const glm::dvec3& size)
{
    double nearest = std::abs(p.z + size.z);
    for (int i = 0; i != 2; ++i)
    {
        const glm::dvec2 normal = glm::normalize(glm::dvec2(2.0 * size.z, size[i]));
        nearest =
            std::min(nearest, std::abs(normal.x * std::abs(p[i]) + normal.y * (p.z - size.z)));
    }
    return nearest;
}

double distanceToTorus(const glm::dvec3& p, const glm::dvec3& size)
{
    const double across = std::hypot(std::hypot(p.x, p.y) - size.x, p.z);
    const double tube = std::abs(across - size.y);
    if (across > size.y || size.z > 6.28)
        return tube;
    const double half = 0.5 * size.z;
    const double turned = std::atan2(std::cos(half) * p.y - std::sin(half) * p.x,
                                     std::cos(half) * p.x + std::sin(half) * p.y);
    return std::min(tube, std::hypot(p.x, p.y) * std::abs(std::abs(turned) - half));
}

/// Of a point in the shape's frame.
double distanceInFrame(const FittedShape& shape, const glm::dvec3& p)
{
    switch (shape.shape)
    {
    case Shape::Box:
        return distanceToBox(p, shape.size);
    case Shape::Quad:
        return glm::length(glm::max(glm::abs(p) - shape.size, glm::dvec3(0.0)));
    case Shape::Cylinder:
        return distanceToFrustum(p, shape.size.x, shape.size.x, shape.size.z);
    case Shape::Frustum:
        return distanceToFrustum(p, shape.size.x, shape.size.y, shape.size.z);
    case Shape::Sphere:
        return std::abs(glm::length(p) - shape.size.x);
    case Shape::Dish:
        return distanceToDish(p, shape.size);
    case Shape::Pyramid:
        return distanceToPyramid(p, shape.size);
    case Shape::Torus:
        return distanceToTorus(p, shape.size);
    default:
        return 0.0;
    }
}

FittedShape fitAny(const FitMesh& mesh)
{
    for (const auto fit : {fitQuad, fitBox, fitPyramid, fitRound, fitElbow, fitExtrusion})
        if (auto shape = fit(mesh))
            return *shape;
    return projectBox(mesh);
}

void measure(const FitMesh& mesh, FittedShape& shape)
{
    if (shape.projected)
        return;
    const glm::dmat3 frame = glm::mat3_cast(shape.rotation);
    const glm::dvec3 moved = frame * (mesh.center - shape.origin);
    const auto distance = [&](const glm::dvec3& point)
    { return distanceInFrame(shape, frame * (mesh.scale * point) + moved); };
    for (const glm::dvec3& point : mesh.points)
        shape.residual = std::max(shape.residual, distance(point));
    double sum = 0.0;
    for (const FitMesh::Facet& facet : mesh.facets)
    {
        const double off = distance(facet.middle);
        sum += facet.area / mesh.area * off * off;
    }
    shape.residual /= mesh.scale;
    shape.coarseness = std::sqrt(sum) / mesh.scale;
}

/// Whether the faces of its box are not all surface.
bool mayBeCut(const FitMesh& mesh, const FittedShape& shape)
{
    if (shape.shape == Shape::Extrusion)
        return true;
    if (shape.shape == Shape::Quad)
        return shape.projected;
    const glm::dvec3 size = shape.size / mesh.scale;
    return shape.shape == Shape::Box &&
           (shape.projected ||
            mesh.area < 7.9 * (size.x * size.y + size.y * size.z + size.z * size.x));
}

} // namespace

double distanceTo(const FittedShape& shape, const glm::dvec3& point)
{
    return distanceInFrame(shape, shape.rotation * (point - shape.origin));
}

FittedShape fitShape(const std::vector<glm::vec3>& vertices,
                     const std::vector<std::uint32_t>& indices)
{
    const FitMesh mesh(vertices, indices);
    if (!(mesh.area > 0.0))
        return {};
    FittedShape shape = fitAny(mesh);
    measure(mesh, shape);
    if (mayBeCut(mesh, shape))
        shape.rooms = faceRooms(mesh, shape);
    return shape;
}

ObjectRecord FittedShape::record(std::uint32_t identifier) const
{
    ObjectRecord made;
    made.rotation = glm::quat(rotation);
    made.origin = glm::vec3(origin);
    made.shape = std::uint32_t(shape) | (projected ? std::uint32_t(Projected) : 0u);
    for (int i = 0; i < 3; ++i)
        made.shape |= (FullRoom - rooms[i]) << (RoomShift + RoomBits * unsigned(i));
    made.shape |= bent ? std::uint32_t(Bent) : 0u;
    made.size = glm::vec3(size);
    made.identifier = identifier;
    return made;
}

} // namespace osgLabels
