// SPDX-License-Identifier: MIT
#pragma once

#include <osgLabels/ShapeFit.h>

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include <string>
#include <vector>

/// A tessellated shape, and what it was made from.
struct ShapeMesh
{
    std::vector<glm::dvec3> points;
    std::vector<std::uint32_t> indices;
    osgLabels::FittedShape truth; ///< In the mesh's own frame until it is moved.

    std::vector<glm::vec3> vertices() const;

    /// Rotates, then moves; the truth too.
    void move(const glm::dquat& rotation, const glm::dvec3& to);
};

namespace shapemesh
{

enum Ends
{
    Open,
    Capped,   ///< Without a vertex in the middle.
    FanCapped ///< With one.
};

ShapeMesh box(const glm::dvec3& half, bool sharedVertices);
ShapeMesh quad(double x, double y, int cells);
/// A cylinder where the radii are equal, a cone where one is 0.
ShapeMesh frustum(double low, double high, double half, int around, int along, Ends ends);
ShapeMesh sphere(double radius, int around, int along);
ShapeMesh dish(double radius, double height, int around, int along, Ends base);
ShapeMesh pyramid(const glm::dvec3& half, bool base);
/// `angle` in radians; a whole ring closes.
ShapeMesh torus(double ring, double tube, double angle, int along, int around, Ends ends);
/// Extruded along z; the profile is closed, counterclockwise, and ends are fans from its first
/// corner.
ShapeMesh extrusion(const std::vector<glm::dvec2>& profile, double half);

} // namespace shapemesh
