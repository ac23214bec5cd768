// SPDX-License-Identifier: MIT
#pragma once

#include <osgShadowVolume/Export.h>

#include <glm/glm.hpp>

#include <osg/Drawable>

#include <functional>

namespace osgShadowVolume
{

using UseTriangle = std::function<void(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c)>;

/// Whether readTriangles() can read a Drawable. Looks at its class and its primitive types, not at
/// vertices.
OSGSHADOWVOLUME_EXPORT bool hasTriangles(const osg::Drawable& drawable);

/// Hands over all triangles of a Drawable, in its local coordinates. Returns how many of them were
/// left out because they have an index beyond the vertices.
///
/// All primitive types of OSG are read, indexed or not, from vertices of any type; four
/// coordinates are divided by the last. A quad that is not planar is two triangles. GL leaves open
/// along which diagonal.
OSGSHADOWVOLUME_EXPORT std::size_t readTriangles(const osg::Drawable& drawable,
                                                 const UseTriangle& use);

} // namespace osgShadowVolume
