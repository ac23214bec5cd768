// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/Export.h>
#include <osgPagedTexture/PhotoSeams.h>
#include <osgPagedTexture/PhotoSurface.h>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <vector>

namespace osgPagedTexture
{

/// A place of the model and the pixel, from the bottom left, at which a photograph shows it.
struct PhotoPoint
{
    glm::dvec3 place;
    glm::dvec2 pixel;
};

/// Where a photograph would show any place of the model.
struct PhotoCamera
{
    enum class Kind
    {
        Perspective, ///< Three rows of a projection, found from places in space.
        Plane,       ///< Of places in a plane; others count as their feet on it.
        Affine       ///< No camera explains the coordinates: what fits best.
    };
    Kind kind = Kind::Affine;
    /// Rows: x, y and w; a pixel is (x / w, y / w). w is above 0 before the camera, and grows with
    /// the distance.
    std::array<glm::dvec4, 3> rows{};
    double error = 0.0; ///< Root mean square over the points, in pixels.

    OSGPAGEDTEXTURE_EXPORT glm::dvec3 project(const glm::dvec3& place) const;
};

/// Finds the camera from points that a photograph shows. `largestError`, in pixels: above it, what
/// a photograph shows is no view of the model, and the kind is Affine.
OSGPAGEDTEXTURE_EXPORT PhotoCamera fitCamera(const std::vector<PhotoPoint>& points,
                                             double largestError = 4.0);

/// Up to `most` points of a photograph's triangles, spread evenly over them.
OSGPAGEDTEXTURE_EXPORT std::vector<PhotoPoint> pointsOf(const Photo& photo,
                                                        std::size_t most = 5000);

/// Points of one photograph on its seams with another one.
OSGPAGEDTEXTURE_EXPORT std::vector<PhotoPoint> seamPointsOf(const std::vector<Photo>& photos,
                                                            const std::vector<PhotoSeam>& seams,
                                                            std::size_t photo,
                                                            std::size_t neighbour);

} // namespace osgPagedTexture
