// SPDX-License-Identifier: MIT
#pragma once

#include <osgShadowVolume/Export.h>

#include <glm/glm.hpp>

#include <osg/BufferObject>
#include <osg/Drawable>

#include <functional>
#include <vector>

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

/// Something that the triangles of a Drawable are read from, as it was. Held, so that no other
/// array comes to lie at the same address.
struct TriangleContent
{
    osg::ref_ptr<const osg::BufferData> data;
    unsigned int modifiedCount;
    std::size_t size;

    bool operator==(const TriangleContent& other) const
    {
        return data == other.data && modifiedCount == other.modifiedCount && size == other.size;
    }
};

/// Appends what readTriangles() would read: it differs where an array or indices have been
/// exchanged or made dirty(). Nothing of a Drawable that is no Geometry, which has no counts.
void appendContents(const osg::Drawable& drawable, std::vector<TriangleContent>& contents);

} // namespace osgShadowVolume
