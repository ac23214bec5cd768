// SPDX-License-Identifier: MIT
#pragma once

#include <osgShadowVolume/EdgeMesh.h>

namespace osgShadowVolume
{

/// The light in a mesh's local frame, as all who judge its triangles take it: homogeneous, divided
/// by a power of two that takes it and the mesh's coordinates to about 1 so that no product
/// overflows. A w that vanishes in single precision is a light at infinity.
struct MeshLight
{
    glm::vec4 light{0.0f};
    /// What single precision leaves of the position: far from the origin a light is placed more
    /// finely than vertices are.
    glm::vec3 rest{0.0f};
    /// w of extrusions, v + (v * l.w - l.xyz) / end: 0 puts them at infinity.
    float end = 0.0f;

    /// Whether all extrusions are one point.
    bool endsInAPoint() const { return light.w == 0.0f && end == 0.0f; }
};
OSGSHADOWVOLUME_EXPORT MeshLight toMeshLight(const EdgeMesh& mesh, const glm::dvec4& light);

/// Which side of the triangle the light is on: 1 where (a, b, c) is counterclockwise as the light
/// sees it, -1 where it is clockwise, 0 where the light is in its plane or rounding can't tell.
///
/// The corners must come in ascending order of their indices in the mesh. The shaders evaluate the
/// same expression in the same order without contraction, so the sign is the same wherever
/// intermediate results are normal floats.
OSGSHADOWVOLUME_EXPORT int facing(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c,
                                  const MeshLight& light, float scale);

/// How many volumes the edge of this record (two ends, then opposite vertices) bounds, with the
/// sign of the side that they are on. The sum at each vertex of a mesh, over all records, counted
/// negative at the upper end, is 0.
OSGSHADOWVOLUME_EXPORT int multiplicity(const EdgeMesh& mesh, const std::uint32_t* record,
                                        std::uint32_t opposites, const MeshLight& light);

/// The surface of a mesh's shadow volume, as triangles of indices. Index i is vertex i of the mesh,
/// i + vertices.size() is its extrusion away from the light, to infinity unless the light says
/// where volumes end. Seen from outside of the volume all are counterclockwise.
struct Silhouette
{
    /// Sides that count so many times.
    struct Sides
    {
        std::uint32_t weight = 1;
        std::vector<std::uint32_t> indices;
    };

    std::vector<Sides> sides;            ///< Ascending by weight. One triangle an edge for a
                                         ///< light whose volumes end in a point, else two.
    std::vector<std::uint32_t> nearCaps; ///< What faces the light, weight 1.
    std::vector<std::uint32_t> farCaps; ///< The same at the other end; empty where that is a point.
};

/// Finds it, in `threads` threads at most where that pays; 0 stands for those that the machine
/// has. The result does not depend on their number.
OSGSHADOWVOLUME_EXPORT Silhouette silhouetteOf(const EdgeMesh& mesh, const MeshLight& light,
                                               unsigned int threads);

} // namespace osgShadowVolume
