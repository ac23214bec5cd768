// SPDX-License-Identifier: MIT
#pragma once

#include <osg/Geometry>

#include <glm/vec3.hpp>

#include <array>
#include <vector>

namespace osgPagedTexture
{

/// A vertex between three others.
struct MixedVertex
{
    std::array<unsigned int, 3> indices{};
    glm::dvec3 weights{1.0, 0.0, 0.0};
};

/// Replaces all arrays of a geometry that have a value for each vertex by values of these vertices.
/// Floating point numbers and colours are mixed by weight and normals have their length of 1 again;
/// integers are those of the heaviest vertex. Indices beyond an array's end mean its last value.
void replaceVertices(osg::Geometry& geometry, const std::vector<MixedVertex>& vertices);

} // namespace osgPagedTexture
