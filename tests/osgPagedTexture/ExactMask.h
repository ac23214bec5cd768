// SPDX-License-Identifier: MIT
#pragma once

#include <osgPagedTexture/PhotoSurface.h>
#include <osgPagedTexture/Pixels.h>

#include <cstddef>
#include <cstdint>
#include <vector>

/// What a mask has to be, from the definition: a pixel is used where its middle lies in a triangle,
/// or in a repeat of one. A plain loop over triangles, without OpenGL.
class ExactMask
{
public:
    /// Distances from edges, in pixels, within which OpenGL may decide otherwise: it moves vertices
    /// to a grid of 1/256 of a pixel.
    static constexpr double EdgeReach = 1.0 / 256.0;

    explicit ExactMask(const osgPagedTexture::Photo& photo);

    struct Difference
    {
        std::size_t atEdges =
            0;                 ///< Pixels that differ, whose middle is within EdgeReach of an edge.
        std::size_t wrong = 0; ///< Other pixels that differ.
        std::size_t edges = 0; ///< Pixels whose middle is within EdgeReach of an edge.
        std::size_t used = 0;
    };
    osgPagedTexture::Pixels getMask() const;
    Difference compare(const osgPagedTexture::Pixels& mask) const;

private:
    void add(const osgPagedTexture::PhotoSurface& surface, std::size_t index);
    void addRepeat(const double (&x)[3], const double (&y)[3]);
    void addClamped(const osgPagedTexture::PhotoSurface& surface, std::size_t index);
    void mark(std::int64_t x, std::int64_t y, bool inside, bool atEdge);

    const int _width, _height;
    std::vector<std::uint8_t> _used, _edge;
};
