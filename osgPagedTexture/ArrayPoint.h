// SPDX-License-Identifier: MIT
#pragma once

#include <osg/Array>

#include <glm/vec3.hpp>

namespace osgPagedTexture
{

/// Whether pointOf() knows the array: two or three numbers each, three for places.
bool isReadable(const osg::Array* array, bool isPlace);

/// An element as a point; 0 in what it lacks. `index` has to be one of the array's.
glm::dvec3 pointOf(const osg::Array& array, unsigned int index);

} // namespace osgPagedTexture
