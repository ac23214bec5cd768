// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/Export.h>
#include <osgPagedTexture/PhotoSurface.h>

#include <array>
#include <cstddef>
#include <vector>

namespace osgPagedTexture
{

/// An edge of the model's triangles at which two photographs adjoin.
struct PhotoSeam
{
    struct Side
    {
        std::size_t photo = 0;   ///< Number in the list of photographs.
        std::size_t surface = 0; ///< Of the photograph.
        glm::vec2 from;          ///< Coordinates of the edge's ends, not wrapped.
        glm::vec2 to;
    };
    std::array<Side, 2> sides; ///< The lower photograph first.
    glm::dvec3 from;           ///< Of the model.
    glm::dvec3 to;
    double length = 0.0; ///< In the model's units.
};

/// Edges that triangles of two photographs share. Corners whose distance is at most `tolerance`
/// (model units; negative: 1e-7 of the model's size) are one. The photographs need places. n log n
/// for n triangles.
OSGPAGEDTEXTURE_EXPORT std::vector<PhotoSeam> findSeams(const std::vector<Photo>& photos,
                                                        double tolerance = -1.0);

/// A photograph that adjoins another one.
struct PhotoNeighbour
{
    std::size_t photo = 0;
    double length = 0.0; ///< Of the shared seam, in the model's units.
    double pixels = 0.0; ///< The same in pixels of the photograph whose neighbour it is.
    std::size_t edges = 0;
};

/// The neighbours of each photograph, the longest seam first.
OSGPAGEDTEXTURE_EXPORT std::vector<std::vector<PhotoNeighbour>>
findNeighbours(const std::vector<Photo>& photos, const std::vector<PhotoSeam>& seams);

} // namespace osgPagedTexture
