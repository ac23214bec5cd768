// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/Export.h>
#include <osgLabels/ObjectRecord.h>

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include <cstdint>
#include <vector>

namespace osgLabels
{

/// The shape that a mesh is, or the box that it is labelled as.
struct FittedShape
{
    Shape shape = Shape::None;
    bool projected = false;                  ///< Not that shape: it stands in for the mesh.
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0}; ///< From local coordinates to the shape's frame.
    glm::dvec3 origin{0.0};                  ///< Of the frame, in local coordinates.
    glm::dvec3 size{0.0};                    ///< See Shape.
    /// Of boxes, quads and extrusions: how much of the faces across x, y and z text may use, from
    /// their middles, in FullRoom-ths.
    glm::uvec3 rooms{FullRoom};
    static constexpr unsigned int FullRoom = 15;
    bool bent = false; ///< Of texture coordinates: see fitTexCoords().
    /// Farthest vertex from the shape, as a share of half the diagonal of the mesh's box; 0 for
    /// what is projected and for extrusions, whose profile may be any.
    double residual = 0.0;
    /// Root mean square distance of the triangles' middles from the shape, as the same share: how
    /// coarse the mesh is.
    double coarseness = 0.0;

    /// With a label's identifier, as the shader reads it.
    OSGLABELS_EXPORT ObjectRecord record(std::uint32_t identifier) const;
};

/// Finds the shape of a mesh, three indices a triangle: Box, Cylinder, Sphere, Dish, Frustum,
/// Pyramid, Torus, Quad or Extrusion, open or closed, from five segments around (a cylinder, cone
/// or torus of four is a Box, Pyramid or projected). All others get a projected Box along their
/// dominating normals, flat ones a projected Quad. A pipe with a wall is its outer Cylinder.
/// Oblique cones, truncated pyramids and parts of spheres that are not halves are projected.
///
/// Triangles that are no triangles (indices beyond the vertices, coordinates that are not finite,
/// no area) count as absent; None without any other. Callable from any thread.
OSGLABELS_EXPORT FittedShape fitShape(const std::vector<glm::vec3>& vertices,
                                      const std::vector<std::uint32_t>& indices);

/// Distance of a point, in local coordinates, from the shape's surface, its flat ends included. 0
/// for None, Extrusion and TexCoord. Of dishes it is that along the ray from the origin.
OSGLABELS_EXPORT double distanceTo(const FittedShape& shape, const glm::dvec3& point);

} // namespace osgLabels
