// SPDX-License-Identifier: MIT
#pragma once

#include <osgShadowVolume/EdgeMesh.h>

namespace osgShadowVolume
{

/// Makes an EdgeMesh out of a heap of triangles.
///
/// Takes about 0.2 µs a triangle, in two threads where there are many. Use from one thread.
class OSGSHADOWVOLUME_EXPORT EdgeMeshBuilder
{
public:
    /// Makes room for this many triangles in all.
    void reserve(std::size_t triangles) { _corners.reserve(3 * triangles); }

    /// Adds a triangle; any winding. One with two equal corners, or a corner that is not finite, is
    /// left out and counted.
    void addTriangle(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);

    /// Makes the mesh and forgets the triangles. Needs fewer than 2^32 / 3 of them. The same
    /// triangles in the same order give the same mesh.
    EdgeMesh build();

private:
    std::vector<glm::vec3> _corners; ///< Three a triangle, without negative zeros.
    std::size_t _degenerate = 0;
    std::size_t _notFinite = 0;
};

} // namespace osgShadowVolume
