// SPDX-License-Identifier: MIT
#pragma once

#include <osgShadowVolume/Export.h>

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace osgShadowVolume
{

/// The edges of a heap of triangles with all triangles that meet at each, for silhouettes.
///
/// Positions are welded where they are equal, bit for bit but for the sign of zero; any number of
/// triangles may meet at an edge. Vertices ascend lexicographically, so the order of indices is the
/// order of positions: the same triangle is judged in the same order from each of its edges.
struct EdgeMesh
{
    /// Most opposite vertices of one record: what a patch of 32 vertices holds.
    static constexpr std::uint32_t MaxOpposites = 30;

    /// Records of edges with the same number of opposite vertices, 2 + opposites indices each: the
    /// ends of the edge, ascending, then the opposite vertices.
    struct Group
    {
        std::uint32_t opposites = 0;
        std::vector<std::uint32_t> indices;
    };

    std::vector<glm::vec3> vertices;   ///< Distinct, ascending.
    std::vector<glm::uvec3> triangles; ///< Ascending indices; duplicates are kept.
    /// By number of opposites, ascending. Edges with one have a second that is the edge's first
    /// end and judges to 0, so the first group is that of two.
    std::vector<Group> groups;
    /// A power of two that takes the extent of the vertices to about 1, so that products of
    /// differences neither overflow nor underflow.
    float scale = 1.0f;
    float reach = 0.0f;         ///< The largest absolute coordinate.
    std::size_t degenerate = 0; ///< Triangles left out because two of their corners are equal.
    std::size_t notFinite = 0;  ///< Left out because a coordinate is infinite or not a number.
};

} // namespace osgShadowVolume
