// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/AtlasPlaces.h>
#include <osgPagedTexture/PhotoSurface.h>

#include <osg/Geometry>

#include <cstdint>

namespace osgPagedTexture
{

/// How a geometry shows a photograph.
struct GeometryPhoto
{
    const std::vector<std::size_t>* pieces = nullptr; ///< In the layout.
    PhotoWrap wrapS = PhotoWrap::Clamp;
    PhotoWrap wrapT = PhotoWrap::Clamp;
    osg::Matrixd toTexture; ///< Of the texture's coordinates.
};

struct GeometryCounts
{
    std::size_t triangles = 0;    ///< Before.
    std::size_t split = 0;        ///< That were cut.
    std::size_t written = 0;      ///< After.
    std::size_t notFinite = 0;    ///< Triangles with a coordinate that is not finite.
    double largestRounding = 0.0; ///< Of a coordinate's float, in pixels of the atlas.
};

/// Writes coordinates of an atlas into texture unit 0 of a geometry; triangles that reach several
/// repeats of the photograph are cut. Returns why that can't be, and then leaves it as it was;
/// empty where it is done. Strips, fans and quads become triangles; lines and points stay whole.
std::string moveGeometry(osg::Geometry& geometry, const GeometryPhoto& photo,
                         const AtlasPlaces& places, const AtlasLayout& layout,
                         std::int64_t mostRepeats, GeometryCounts& counts);

} // namespace osgPagedTexture
