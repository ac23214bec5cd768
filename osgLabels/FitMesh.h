// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/ShapeFit.h>

#include <optional>

namespace osgLabels
{

/// A mesh made ready for fitting: moved to its middle and scaled to about 1, in double.
struct FitMesh
{
    FitMesh(const std::vector<glm::vec3>& vertices, const std::vector<std::uint32_t>& indices);

    struct Facet
    {
        glm::dvec3 normal; ///< Unit.
        glm::dvec3 middle;
        double area;
        std::uint32_t corners[3]; ///< In points.
    };

    /// Facets that are parallel, whichever side they show.
    struct Direction
    {
        glm::dvec3 normal; ///< Unit.
        double area;
    };

    glm::dvec3 center{0.0};         ///< Of the box, in local coordinates.
    double scale = 1.0;             ///< Half the box's diagonal, in local units.
    double noise = 0.0;             ///< What a coordinate may be off by, being a float.
    glm::dvec3 noises{0.0};         ///< The same for each axis.
    std::vector<glm::dvec3> points; ///< Those of facets; may repeat.
    std::vector<Facet> facets;
    double area = 0.0;
    glm::dvec3 centroid{0.0};          ///< Of the surface.
    std::vector<Direction> directions; ///< By area, largest first; at most MaxDirections.
    bool curved = false;               ///< There are more directions than that.
    glm::dmat3 spread{0.0}; ///< Of the facets' normals: sum of area times outer products.
    glm::dmat3 axes{1.0};   ///< Principal axes of the facets' normals.

    static constexpr std::size_t MaxDirections = 12;

private:
    void addFacets(const std::vector<glm::vec3>& vertices,
                   const std::vector<std::uint32_t>& indices);
    void addDirection(const Facet& facet, double lean);
    void findAxes();
};

/// Extent along three axes.
struct Extent
{
    Extent(const std::vector<glm::dvec3>& points, const glm::dmat3& axes);

    glm::dvec3 center() const { return 0.5 * (low + high); } ///< In the axes' coordinates.
    glm::dvec3 half() const { return 0.5 * (high - low); }

    glm::dvec3 low, high;
};

/// A right-handed frame of three perpendicular axes, in the order and with the signs that bring it
/// closest to the coordinates' own.
glm::dmat3 nearestFrame(const glm::dmat3& axes);

/// A right-handed frame whose z axis is the given one; x is as near as can be to an axis of the
/// coordinates.
glm::dmat3 frameAround(const glm::dvec3& z);

/// Makes a shape in the mesh's scaled coordinates one of local coordinates. Columns of the frame
/// are its axes.
FittedShape makeShape(const FitMesh& mesh, Shape shape, const glm::dmat3& frame,
                      const glm::dvec3& origin, const glm::dvec3& size);

std::optional<FittedShape> fitQuad(const FitMesh& mesh);
std::optional<FittedShape> fitBox(const FitMesh& mesh);
std::optional<FittedShape> fitPyramid(const FitMesh& mesh);
std::optional<FittedShape> fitExtrusion(const FitMesh& mesh);
/// Never fails.
FittedShape projectBox(const FitMesh& mesh);

/// Sphere, or what turns around an axis: Cylinder, Frustum, Dish, whole Torus.
std::optional<FittedShape> fitRound(const FitMesh& mesh);
/// A part of a torus.
std::optional<FittedShape> fitElbow(const FitMesh& mesh);

} // namespace osgLabels
